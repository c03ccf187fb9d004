#pragma once
/// \file
/// From what Assimp has read to a mesh.

#include <string>
#include <vector>

#include "tsuya/garment/mesh_file.h"

struct aiScene;

namespace tsuya::garment {

/// Assimp's message without its own marks, on one line.
std::string cause_of(const std::string &message);

/// The mesh of a scene, with findings about what was left aside. \param remarks of Assimp
MeshFile mesh_of(const aiScene &scene, const std::string &extension,
                 std::vector<std::string> remarks);

} // namespace tsuya::garment
