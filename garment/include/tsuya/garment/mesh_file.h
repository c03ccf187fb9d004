#pragma once
/// \file
/// A mesh file of any format that is read, and what it says about the cloth.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/garment/report.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::garment {

/// What a file's material says about the cloth of one panel.
struct FabricHint {
    std::string panel{};
    std::string material{};
    double anisotropy_strength = 0; ///< 0 to 1
    /// The direction of the threads: radians counter-clockwise from +u in the UV plane. Highlights
    /// stretch along the anisotropy direction, which lies across the threads, so this is that
    /// direction and a quarter turn. [KhrAnisotropy]
    double thread_angle = 0;
    std::optional<glm::vec3> sheen_colour{}; ///< linear, 0 to 1
    double sheen_roughness = 0;              ///< 0 to 1

    /// The grain (see FrameOptions) that lays the warp along the threads, radians.
    double grain() const;
};

/// A mesh as its file has it.
struct MeshFile {
    PolygonMesh mesh{};
    std::vector<FabricHint> hints{}; ///< of panels whose material states anisotropy or sheen
    /// Further shapes of the same topology, each as long as `mesh.position` and in its units.
    std::vector<std::vector<glm::dvec3>> morph_targets{};
    std::vector<Finding> findings{}; ///< what the file has and the mesh has not
};

/// Extensions that read_mesh takes, lower case, with the dot.
const std::vector<std::string> &mesh_extensions();

/// Reads `.obj`, `.gltf`, `.glb`, `.ply`, `.off`, `.fbx`, `.dae` or `.stl`, by the file's
/// extension. Throws Error naming the file for another extension, and what the format's reader
/// throws; Interrupted where `progress` says stop, as all readers.
MeshFile read_mesh(const std::filesystem::path &path, const Progress &progress = {});

} // namespace tsuya::garment
