#pragma once
/// \file
/// One repeat of a weave as explicit filaments: what a weave is turned into, and what the virtual
/// goniometer traces light through.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya::lab {

/// Section of a filament across its axis.
enum class FilamentSection { round, triangular, trilobal };

/// The least radius of the corners of a triangular section, in radii of the circle about it.
inline constexpr double kSharpestCorner = 0.02;
/// The largest depth of the hollows of a trilobal section, in the same.
inline constexpr double kDeepestHollow = 0.45;

/// One filament over one repeat of the weave. The path is periodic: `point.front()` follows
/// `point.back()` after a step of the whole repeat along the yarn (+x for weft, +y for warp).
struct Filament {
    std::vector<glm::vec3> point{}; ///< centre line, metres; x weft, y warp, z normal of the cloth
    std::vector<float> turn{}; ///< of the section about the axis at each point, radians; empty: 0
    float radius = 0;          ///< of the circle about the section, metres, > 0
    std::uint32_t system = 0;  ///< 0 warp, 1 weft: index into FilamentRepeat::optics
    std::uint32_t yarn = 0;    ///< number of the yarn within its system
};

/// How the filaments of one yarn system meet light.
struct FilamentOptics {
    FilamentSection section = FilamentSection::round;
    double corner_rounding = 0.3;    ///< of a section that is not round: 0 sharp, 1 round
    double refractive_index = 1.6;   ///< >= 1
    double surface_roughness = 0.08; ///< standard deviation of the surface's slope, radians
    /// Share of the light that comes through a diameter of the filament (2 Filament::radius, also
    /// of sections that are not round), 0 (black) to 1 (clear): the dye absorbs -ln(transmission) /
    /// diameter per length, by Beer's law. Above 0 the index is 1.05 or more.
    double transmission = 0.0;
    /// Mean way of light within a filament between two particles of delustrant, metres; 0: there is
    /// none. Only where the transmission is above 0.
    double scattering_length = 0;
    /// Mean cosine of the angle by which a particle turns light, -0.99 to 0.99 [Henyey].
    double scattering_anisotropy = 0;
};

/// A rectangle of cloth that tiles the plane.
struct FilamentRepeat {
    glm::dvec2 size{0, 0}; ///< metres along x (weft) and y (warp)
    std::vector<Filament> filaments{};
    std::vector<FilamentOptics> optics{}; ///< warp, weft
    std::string name{};
};

/// Throws Error naming `where` if the repeat breaks its own rules: no filament, sizes or radii not
/// above 0, not finite, fewer than 2 points, a path that strays more than two repeats from its own.
void check_repeat(const FilamentRepeat &repeat, const std::string &where);

} // namespace tsuya::lab
