#pragma once
/// \file
/// A dressed garment for viewers of glTF.

#include <filesystem>
#include <string>
#include <vector>

#include "tsuya/scene/tryon.h"

namespace tsuya::scene {

/// A fabric as a viewer shades it, and how far that lies from the fabric's own reflectance.
struct ExportedFabric {
    std::string name{};
    double roughness = 0, anisotropy_strength = 0; ///< as KHR_materials_anisotropy has them
    /// Of the specular part, mean over 15 lights, as ErrorMeasures::l2_cos; 0 without one.
    double l2_cos = 0;
};

/// Writes the garment of a try-on as GLB, with the fabrics of its panels: colours under D65, and
/// the specular part as the one lobe of facets that viewers have, fitted to the fabric's views.
/// Prints, opacity and backs have no place there. Only garment, fabrics, first dye and tessellation
/// of the job are looked at. Throws Error as make_try_on_scene, and at the path.
std::vector<ExportedFabric> export_glb(const TryOn &job, const std::filesystem::path &file,
                                       const Progress &progress = {});

} // namespace tsuya::scene
