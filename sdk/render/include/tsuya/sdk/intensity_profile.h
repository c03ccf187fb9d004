#pragma once
/// \file
/// How strongly a luminaire shines to which side, as laboratories measure it.

#include <filesystem>
#include <string_view>
#include <vector>

namespace tsuya {

/// Luminous intensities by direction: `vertical` is the angle from the axis, `horizontal` the angle
/// about it. What is between is interpolated in both angles; beyond the vertical angles it is dark.
struct IntensityProfile {
    std::vector<double> vertical{}; ///< radians, rising, within 0 and pi; two or more
    /// Radians, rising, from 0. The last says what is known: 0 (one angle) the same all around,
    /// pi / 2 mirrored at two planes, pi mirrored at one plane, 2 pi no symmetry.
    std::vector<double> horizontal{};
    std::vector<double> candela{}; ///< [horizontal][vertical], not below 0

    /// Intensity to a side, in candela.
    double at(double vertical_angle, double horizontal_angle) const;
    /// The highest one.
    double highest() const;
    /// The angle from the axis beyond which it is dark.
    double last_angle() const;
};

/// Reads a file of luminous intensities, [LM63] of 1986 to 2019: types C, and A and B, which get
/// angles about their axis H = V = 0 from V = 90 on. Tilt factors of a lamp are not applied.
/// Candelas are times the multiplier, the ballast factor and the ballast-lamp factor of the file.
/// Symmetry is what the last horizontal angle says; files that begin at 90 degrees are turned.
/// Throws Error at file:line for what is no such file, tilt factors in another file,
/// numbers that are missing, angles that do not rise or do not fit the type, and intensities below
/// 0 or none above.
IntensityProfile read_ies(const std::filesystem::path &file);

/// The same from text. \param name of the file, for errors
IntensityProfile parse_ies(std::string_view text, const std::string &name);

} // namespace tsuya
