#pragma once
/// \file
/// The section of a yarn, and where its filaments lie in it.

#include <vector>

#include <glm/glm.hpp>

namespace tsuya::lab::detail {

/// A race-track, all within `radius` of a segment of `2 half_flat`: two half circles and what is
/// between them.
struct YarnSection {
    double half_flat = 0; ///< metres, >= 0
    double radius = 0;    ///< metres, > 0

    static YarnSection of(double width, double thickness) {
        return {(width - thickness) / 2, thickness / 2};
    }
    double half_width() const { return half_flat + radius; }
    double area() const;
    double perimeter() const;
    /// Half the thickness at a distance from the axis; below 0 outside the section.
    double half_thickness(double across) const;
};

/// A ring of filaments, evenly filled: the centres are those of an outline.
struct FilamentRing {
    YarnSection outline{}; ///< of radius 0: a row on the segment, which never turns
    double half_chord = 0; ///< half the least distance of neighbours in the section, metres
    int count = 0;
};

struct FilamentPacking {
    double filament_radius = 0; ///< metres
    double slack = 0;           ///< a centre may move by this much and keep the others' distance
    std::vector<FilamentRing> rings{};
};

/// `count` filaments as thick as they can be in rings a filament apart, less 4 % to move in. Each
/// two are apart by 2.5 % of the sum of their radii or more, and within the section by 1 %. Twist
/// inclines the filaments of a ring, which need more room in it then.
FilamentPacking pack_filaments(const YarnSection &section, int count, double twist_per_m = 0);

/// The section of a yarn that has room for a `width`. One that is wider than that is pressed: that
/// wide, and as thick as the same filaments need then.
YarnSection press(const YarnSection &section, double width, int filaments, double twist_per_m);

/// The place in a ring at `phase` (one round is 1, any value): across the yarn and along its
/// normal. Places a phase of 1 / count apart are at least two half chords apart.
glm::dvec2 ring_place(const FilamentRing &ring, double phase);

} // namespace tsuya::lab::detail
