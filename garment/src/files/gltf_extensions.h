#pragma once
/// \file
/// What extensions of glTF a file may demand.

#include "files/gltf_document.h"

namespace tsuya::garment {

/// Throws Error with every required extension that the reader does not know.
void check_required_extensions(const tinygltf::Model &model, const std::string &name);

} // namespace tsuya::garment
