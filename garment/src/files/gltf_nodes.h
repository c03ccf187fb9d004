#pragma once
/// \file
/// The tree of a glTF document: where each node stands.

#include "files/gltf_document.h"

namespace tsuya::garment {

/// Places of all nodes, and which of them the scene shows.
struct GltfNodes {
    std::vector<glm::dmat4> world;  ///< per node: its coordinates to those of the file
    std::vector<std::size_t> shown; ///< nodes of the scene, parents first
};

/// Throws Error naming the node if one does not exist or has two parents.
GltfNodes place_nodes(const tinygltf::Model &model, const std::string &name);

} // namespace tsuya::garment
