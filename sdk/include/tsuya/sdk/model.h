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

/// All models, the one that `resolve` takes first.
std::span<const ModelName> model_names();

/// The specular part of a fabric by the named model. `lambert` is the ideal diffuser of the same
/// albedo under light from straight above. Throws Error naming `where`: an unknown name, with the
/// known ones; a fabric without measured views; as resolve.
BrdfFunction make_model(const std::string &name, const Fabric &fabric, const std::string &where);

} // namespace tsuya
