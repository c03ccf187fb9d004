#pragma once
/// \file
/// The lamps and dyes under which a packed picture is judged.

#include <vector>

#include <glm/vec3.hpp>

#include "tsuya/sdk/spectral_image.h"

namespace tsuya {

/// What a lamp and a dye make of the channels.
struct JudgedLook {
    glm::dvec3 white{};                 ///< XYZ of a perfect white under the lamp
    std::vector<glm::dvec3> channels{}; ///< XYZ that each channel adds, see lamp_matrix
};

/// Five lamps of different kinds, each with every dye that can be shown in the place of an open
/// one: the named ones and a white of the highest reflectance. Where two are open, all pairs of a
/// first and another dye that lie a fixed number of names apart.
std::vector<JudgedLook> judged_looks(const SpectralImage &image);

/// The pixels of a garment (AOV `coverage` at least 0.5), or where there is no such AOV all that
/// are lit; at most `most` of them, evenly chosen. All are finite.
std::vector<std::size_t> judged_pixels(const SpectralImage &image, std::size_t most);

} // namespace tsuya
