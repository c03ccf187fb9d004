#pragma once
/// \file
/// Skins of glTF: vertices that follow joints.

#include "files/gltf_nodes.h"

namespace tsuya::garment {

/// Per vertex, what takes its rest position into the coordinates of the file: the mean of its
/// joints' matrices by its weights, which are made to sum to 1. The place of the mesh's own node
/// does not count. [Gltf] 3.7.3
/// Throws Error naming `where` if the skin, a joint or an attribute is not there, or all weights of
/// a vertex are 0.
std::vector<glm::dmat4> skin_matrices(const tinygltf::Model &model, const GltfNodes &nodes,
                                      int skin, const tinygltf::Primitive &primitive,
                                      std::size_t vertices, const std::string &where);

} // namespace tsuya::garment
