#pragma once
// The rectangle of cloth that photons are traced in, as shapes of which nothing is missing inside.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/lab/filaments.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::lab {

// A filament's way through the cell. Its segments follow each other in its Cones or Tubes.
struct Strand {
    std::uint32_t system, filament; // of the repeat
    float radius;
    int axis;                           // along which it repeats: 0 x, 1 y
    std::uint32_t first_segment, count; // no less than per_cell
    std::uint32_t per_cell;             // segments until the same comes again, a cell farther
};

// The segment after or before another, with what is to be added to points along the strand's axis
// where it is that of the next cell.
struct Neighbour {
    std::uint32_t segment;
    float shift;
};
// \param size of the cell along the strand's axis
Neighbour neighbour(const Strand &strand, std::uint32_t segment, bool next, float size);

// Chains of cones.
struct Cones {
    std::vector<glm::vec4> vertex{};     // position and radius
    std::vector<glm::vec3> tangent{};    // of the smooth axis, per vertex
    std::vector<std::uint32_t> first{};  // vertex of each cone; the next vertex is its end
    std::vector<std::uint8_t> system{};  // per cone
    std::vector<std::uint32_t> strand{}; // per cone: index into FilamentCell::strands
};

// Tubes of rings of `ring_size` points. Their walls are quads of two triangles each: wall k of a
// segment has the corners a = ring + k, b = the next one of the ring, d = a + ring_size and c = b +
// ring_size, and the triangles a, b, d and c, d, b, counter-clockwise as seen from outside.
struct Tubes {
    std::uint32_t ring_size = 0;
    std::vector<glm::vec3> position{}, normal{};
    std::vector<glm::vec3> tangent{};    // per ring: the normal of its plane
    std::vector<std::uint32_t> ring{};   // first vertex of the first ring of each tube segment
    std::vector<std::uint8_t> system{};  // per tube segment
    std::vector<std::uint32_t> strand{}; // per tube segment
    std::vector<glm::uvec4> quad{};      // ring_size per tube segment
};

// A point of a section's outline.
struct OutlinePoint {
    glm::dvec2 position, normal; // of a section within the unit circle
};

// The outline of a section, counter-clockwise. \param points at least 12
std::vector<OutlinePoint> outline(FilamentSection section, double corner_rounding, int points);

// The least gap that filaments have where light goes through them, as a share of the sum of two
// radii: wider than twice the distance by which rays start off a surface.
inline constexpr double kLeastGap = 0.01;
// The largest share of their radii that filaments may lose for it.
inline constexpr double kMostThinning = 0.2;

// Whole repeats of the cloth in units of the mean radius of the filaments: x in [0, size.x], y in
// [0, size.y]. Filaments that reach in from outside are there as well.
struct FilamentCell {
    // Where some filament lets light through, all are made thinner by one factor until they are
    // kLeastGap apart: light in two filaments at once would be in none that there is.
    // \param turn_per_segment radians
    // Throws Error if they overlap by more than kMostThinning, Interrupted where `progress` is
    // stopped.
    FilamentCell(const FilamentRepeat &repeat, double turn_per_segment, int section_points,
                 const Progress &progress = {});

    glm::vec2 size{};
    float bottom = 0, top = 0; // z of all filaments
    double unit = 1;           // metres
    double gap = 1;            // least_gap() of the filaments as they are here; not found if black
    double thinning = 1;       // of their radii
    std::vector<bool> clear{}; // per system: lets light through
    std::vector<Strand> strands{};
    Cones cones{};
    Tubes tubes{};

  private:
    void separate(double found, const std::string &name);
};

} // namespace tsuya::lab
