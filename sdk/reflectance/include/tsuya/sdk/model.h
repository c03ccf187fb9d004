#pragma once
/// \file
/// Reflectance models by name: what a fabric's views can be carried to other lights with.

#include <span>
#include <string>
#include <string_view>

#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/fabric.h"

namespace tsuya {

struct ModelName {
    std::string_view name;
    std::string_view description;
};

/// All models, the default of fabrics first.
std::span<const ModelName> model_names();

/// Throws Error naming `where` and the known models.
void check_model_name(const std::string &name, const std::string &where);

/// Whether the fabric has what the model is made of: measured views with a value above 0; of
/// `tabulated` a table; of `ggx` either facets or views, of `yarn` either yarns or views.
bool has_data_of(const std::string &model, const Fabric &fabric);

/// The specular part of a fabric by the named model. `lambert` is the ideal diffuser of the same
/// albedo under light from straight above; `yarn` takes the fabric's yarns where it has them, else
/// fits them to the views, with f0 = 0.05, a fibre's, where the fabric has none. Throws Error
/// naming `where`: an unknown name, with the known ones; a fabric without the data of the model; f0
/// outside (0, 1]; as the models themselves.
Brdf make_brdf(const std::string &name, const Fabric &fabric, const std::string &where);

/// The same as a function, for comparisons.
BrdfFunction make_model(const std::string &name, const Fabric &fabric, const std::string &where);

} // namespace tsuya
