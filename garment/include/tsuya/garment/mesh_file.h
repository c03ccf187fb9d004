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

/// What a file's material says about where there is no cloth.
struct FileOpacity {
    std::string material{};            ///< its name, or number
    std::vector<std::string> panels{}; ///< that have it
    /// A PNG as the file has it, whose alpha counts; it lies on the square from 0 to 1 of the UVs,
    /// and again on those beside it. Empty: the factor alone.
    std::string picture{};
    std::string picture_name{};   ///< names it in errors
    bool mirrored_repeat = false; ///< every other of these squares has its mirror image
    double factor = 1;            ///< times alpha, 0 to 1
    /// There is all of the cloth where alpha times the factor is as much, and none elsewhere;
    /// without it, alpha times the factor is the share of cloth.
    std::optional<double> cutoff{};
};

/// A mesh as its file has it.
struct MeshFile {
    PolygonMesh mesh{};
    std::vector<FabricHint> hints{};      ///< of panels whose material states anisotropy or sheen
    std::vector<FileOpacity> opacities{}; ///< no panel has two
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
