#pragma once
/// \file
/// What a file that Assimp has read states about its unit and axes.

#include <string>

#include <glm/glm.hpp>

struct aiScene;

namespace tsuya::garment {

struct FileUnits {
    glm::dmat4 to_metres{1.0}; ///< from Assimp's coordinates to metres with y up
    std::string stated{};      ///< what the file states; empty: metres with y up
    std::string action{};      ///< what was done about it
};

/// \param extension of the file, `.fbx`, `.dae` or `.stl`
FileUnits units_of(const aiScene &scene, const std::string &extension);

} // namespace tsuya::garment
