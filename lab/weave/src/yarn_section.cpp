#include "yarn_section.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya::lab::detail {
namespace {

constexpr double kLoose = 0.97; ///< of the radius at which neighbours would touch

/// Length of half a circle of filament centres, counted so that equal steps of it have chords of
/// equal length: an arc whose chord is 2 r counts 2 r.
double half_circle(double ring_radius, double r) {
    return kPi * r / std::asin(std::min(1.0, r / ring_radius));
}

double perimeter(const RaceTrack &section, double ring_radius, double r) {
    return 4 * section.half_flat + 2 * half_circle(ring_radius, r);
}

/// Rings from the outside in, for filaments of radius r, until `count` are placed.
std::vector<FilamentRing> rings_of(const RaceTrack &section, double r, int count) {
    std::vector<FilamentRing> rings;
    double ring = section.radius - r;
    for (; ring >= r && count > 0; ring -= 2 * r) {
        const int room = static_cast<int>(perimeter(section, ring, r) / (2 * r));
        rings.push_back({ring, std::min(room, count)});
        count -= rings.back().count;
    }
    if (ring >= 0 && count > 0) {
        const int room = 1 + static_cast<int>(section.half_flat / r);
        rings.push_back({0, std::min(room, count)});
        count -= rings.back().count;
    }
    return count > 0 ? std::vector<FilamentRing>{} : rings;
}

} // namespace

double RaceTrack::area() const { return 4 * half_flat * radius + kPi * radius * radius; }

FilamentPacking pack_filaments(const RaceTrack &section, int count) {
    constexpr double kShrink = 0.998;
    double r = section.radius;
    std::vector<FilamentRing> rings = rings_of(section, r, count);
    while (rings.empty()) {
        r *= kShrink;
        rings = rings_of(section, r, count);
    }
    return {kLoose * r, (1 - kLoose) * r, std::move(rings)};
}

glm::dvec2 ring_place(const RaceTrack &section, const FilamentRing &ring, double filament_radius,
                      double phase) {
    phase -= std::floor(phase);
    const double flat = 2 * section.half_flat;
    const double r = filament_radius / kLoose;
    if (ring.radius == 0) // in the middles of equal parts of the segment, if these are long enough
        return {(phase - 0.5) * std::max(flat, 2 * r * ring.count), 0};
    const double cap = half_circle(ring.radius, r);
    double s = phase * 2 * (flat + cap);
    const double side = s < flat + cap ? 1 : -1; // the lower half is the upper one turned by pi
    if (side < 0)
        s -= flat + cap;
    if (s < flat)
        return side * glm::dvec2(section.half_flat - s, ring.radius);
    const double turn = kPi * (s - flat) / cap;
    return side * glm::dvec2(-section.half_flat - ring.radius * std::sin(turn),
                             ring.radius * std::cos(turn));
}

} // namespace tsuya::lab::detail
