#pragma once
/// \file
/// Reflectance models by name: which of them a fabric can be made by, and the making.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/fabric.h"

namespace tsuya {

/// A model as files and the program name it.
struct ModelName {
    std::string_view name;
    std::string_view description;
};

/// All models, the default of fabrics first.
std::span<const ModelName> model_names();

/// Throws Error naming `where` and the known models.
void check_model_name(const std::string &name, const std::string &where);

/// The models that views are carried by, in the order of model_names.
std::span<const ViewModel> view_models();

/// The model's name.
std::string_view name_of(ViewModel model);

/// The name of the model that the fabric's specular part is; kDefaultModel where it has none.
std::string_view model_of(const Fabric &fabric);

/// The models whose data the fabric has, as specular part or spare, in the order of model_names:
/// measured views with a value above 0, of `tabulated` a table, of `ggx` also facets, of `yarn`
/// also yarns.
std::vector<std::string> models_of(const Fabric &fabric);

/// The same cloth by the named model: what the model is made of becomes the specular part, facets
/// and yarns where the fabric has them, else what is carried from its views; what was the specular
/// part becomes spare. Throws Error naming `where`: an unknown name, with the known ones; a fabric
/// without the data of the model.
Fabric with_model(Fabric fabric, const std::string &name, const std::string &where);

/// The specular part of a fabric. Empty where it has none, or views that are all 0. Throws Error
/// naming `where`: f0 outside (0, 1]; as the models themselves; Interrupted within a fraction of a
/// second where progress asks to stop.
std::optional<Brdf> make_brdf(const Fabric &fabric, const std::string &where,
                              const Progress &progress = {});

/// The same by the named model as a function, for comparisons. Throws Error also as with_model, and
/// for views that are all 0.
BrdfFunction make_model(const std::string &name, const Fabric &fabric, const std::string &where,
                        const Progress &progress = {});

} // namespace tsuya
