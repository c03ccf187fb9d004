#pragma once
/// \file
/// Where the filaments of a yarn lie in its section.

#include <vector>

#include <glm/glm.hpp>

namespace tsuya::lab::detail {

/// All within `radius` of a segment of `2 half_flat`: two half circles and what is between them.
struct RaceTrack {
    double half_flat = 0; ///< metres, >= 0
    double radius = 0;    ///< metres, > 0

    RaceTrack(double width, double thickness)
        : half_flat((width - thickness) / 2), radius(thickness / 2) {}
    double area() const;
};

/// A ring of filaments: a race-track of the same segment, evenly filled.
struct FilamentRing {
    double radius = 0; ///< of the centres about the segment; 0: on the segment, which never turns
    int count = 0;
};

struct FilamentPacking {
    double filament_radius = 0; ///< metres
    double slack = 0;           ///< a centre may move by this much and touch no other filament
    std::vector<FilamentRing> rings{};
};

/// `count` filaments as thick as they can be in rings a filament apart, less 3 % to move in.
FilamentPacking pack_filaments(const RaceTrack &section, int count);

/// The place in a ring at `phase` (one round is 1, any value): across the yarn and along its
/// normal. Places a phase of 1 / count apart are at least two filament radii apart.
glm::dvec2 ring_place(const RaceTrack &section, const FilamentRing &ring, double filament_radius,
                      double phase);

} // namespace tsuya::lab::detail
