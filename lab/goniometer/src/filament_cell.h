#pragma once
// The rectangle of cloth that photons are traced in, as shapes of which nothing is missing inside.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/lab/filaments.h"

namespace tsuya::lab {

// Chains of cones.
struct Cones {
    std::vector<glm::vec4> vertex{};    // position and radius
    std::vector<glm::vec3> tangent{};   // of the smooth axis, per vertex
    std::vector<std::uint32_t> first{}; // vertex of each cone; the next vertex is its end
    std::vector<std::uint8_t> system{}; // per cone
};

// Tubes of rings of `ring_size` points.
struct Tubes {
    std::uint32_t ring_size = 0;
    std::vector<glm::vec3> position{}, normal{};
    std::vector<std::uint32_t> ring{};  // first vertex of the first ring of each tube segment
    std::vector<std::uint8_t> system{}; // per tube segment
    std::vector<glm::uvec3> triangle{}; // 2 ring_size per tube segment
};

// A point of a section's outline.
struct OutlinePoint {
    glm::dvec2 position, normal; // of a section within the unit circle
};

// The outline of a section, counter-clockwise. \param points at least 12
std::vector<OutlinePoint> outline(FilamentSection section, double corner_rounding, int points);

// Whole repeats of the cloth in units of the mean radius of the filaments: x in [0, size.x], y in
// [0, size.y]. Filaments that reach in from outside are there as well.
struct FilamentCell {
    // \param turn_per_segment radians
    FilamentCell(const FilamentRepeat &repeat, double turn_per_segment, int section_points);

    glm::vec2 size{};
    float bottom = 0, top = 0; // z of all filaments
    Cones cones{};
    Tubes tubes{};
};

} // namespace tsuya::lab
