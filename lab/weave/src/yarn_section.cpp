#include "yarn_section.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya::lab::detail {
namespace {

constexpr double kLoose = 0.96;  ///< of the radius at which neighbours would touch
constexpr double kApart = 1.025; ///< least distance of the centres over the sum of the radii
constexpr int kRounds = 4;       ///< of half_chord, which converges at once

/// Length of half a circle of filament centres, counted so that equal steps of it have chords of
/// equal length: an arc whose chord is 2 r counts 2 r.
double half_circle(double ring_radius, double r) {
    return kPi * r / std::asin(std::min(1.0, r / ring_radius));
}

double counted_perimeter(const YarnSection &ring, double r) {
    return 4 * ring.half_flat + 2 * half_circle(ring.radius, r);
}

/// A ring with as many of `count` filaments of radius r as it has room for.
FilamentRing fill_ring(const YarnSection &outline, double r, int count, double twist_per_m) {
    if (outline.radius == 0) {
        const int room = 1 + static_cast<int>(outline.half_flat / r);
        return {outline, r, std::min(room, count)};
    }
    // The section cuts a filament that is inclined to it in an ellipse
    double half_chord = r;
    for (int i = 0; i < kRounds; ++i)
        half_chord = r * std::hypot(1, twist_per_m * counted_perimeter(outline, half_chord));
    const int room = static_cast<int>(counted_perimeter(outline, half_chord) / (2 * half_chord));
    return {outline, half_chord, std::min(room, count)};
}

/// Rings from the outside in, for filaments of radius r, until `count` are placed.
std::vector<FilamentRing> rings_of(const YarnSection &section, double r, int count,
                                   double twist_per_m) {
    std::vector<FilamentRing> rings;
    double ring = section.radius - r;
    for (; ring >= r && count > 0; ring -= 2 * r) {
        rings.push_back(fill_ring({section.half_flat, ring}, r, count, twist_per_m));
        count -= rings.back().count;
    }
    if (ring >= 0 && count > 0) {
        rings.push_back(fill_ring({section.half_flat + ring, 0}, r, count, twist_per_m));
        count -= rings.back().count;
    }
    return count > 0 ? std::vector<FilamentRing>{} : rings;
}

} // namespace

double YarnSection::area() const { return 4 * half_flat * radius + kPi * radius * radius; }

double YarnSection::perimeter() const { return 4 * half_flat + 2 * kPi * radius; }

double YarnSection::half_thickness(double across) const {
    const double beyond = std::max(0.0, std::abs(across) - half_flat);
    return beyond > radius ? -1 : std::sqrt(radius * radius - beyond * beyond);
}

FilamentPacking pack_filaments(const YarnSection &section, int count, double twist_per_m) {
    constexpr double kShrink = 0.998;
    double r = section.radius;
    std::vector<FilamentRing> rings = rings_of(section, r, count, twist_per_m);
    while (rings.empty()) {
        r *= kShrink;
        rings = rings_of(section, r, count, twist_per_m);
    }
    return {kLoose * r, (1 - kLoose * kApart) * r, std::move(rings)};
}

YarnSection press(const YarnSection &section, double width, int filaments, double twist_per_m) {
    if (2 * section.half_width() <= width)
        return section;
    constexpr double kStep = 1.005;
    const double filament = pack_filaments(section, filaments, twist_per_m).filament_radius;
    for (double thickness = 2 * section.radius; thickness < width; thickness *= kStep) {
        const YarnSection pressed = YarnSection::of(width, thickness);
        if (pack_filaments(pressed, filaments, twist_per_m).filament_radius >= filament)
            return pressed;
    }
    return YarnSection::of(width, width); // no room
}

glm::dvec2 ring_place(const FilamentRing &ring, double phase) {
    phase -= std::floor(phase);
    const double flat = 2 * ring.outline.half_flat;
    if (ring.outline.radius == 0) // in the middles of equal parts of the segment, if long enough
        return {(phase - 0.5) * std::max(flat, 2 * ring.half_chord * ring.count), 0};
    const double cap = half_circle(ring.outline.radius, ring.half_chord);
    double s = phase * 2 * (flat + cap);
    const double side = s < flat + cap ? 1 : -1; // the lower half is the upper one turned by pi
    if (side < 0)
        s -= flat + cap;
    if (s < flat)
        return side * glm::dvec2(ring.outline.half_flat - s, ring.outline.radius);
    const double turn = kPi * (s - flat) / cap;
    return side * glm::dvec2(-ring.outline.half_flat - ring.outline.radius * std::sin(turn),
                             ring.outline.radius * std::cos(turn));
}

} // namespace tsuya::lab::detail
