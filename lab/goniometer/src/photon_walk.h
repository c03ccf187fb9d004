#pragma once
// Photons of one direction of light and what the views get of them.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "filament_body.h"
#include "filament_scene.h"
#include "tsuya/lab/goniometer.h"
#include "view_tree.h"

namespace tsuya::lab {

// A light and all its views.
struct LightViews {
    glm::vec3 to_light{};
    std::vector<glm::vec3> to_viewer{};
    std::vector<ViewTree> by_half{};   // per system: half vectors about a normal
    std::vector<ViewTree> by_mirror{}; // per system: views about a mirror direction
    std::vector<ViewTree> by_exit{};   // per system: views about a refracted direction

    // \param matter one per system
    LightViews(const glm::vec3 &light, std::vector<glm::vec3> viewers,
               const std::vector<FilamentMatter> &matter);
};

// Sums over photons, and over their squares.
struct Sums {
    std::vector<double> value{}, square{}; // per view, 1/sr
    double reflected = 0, reflected_square = 0;
    double transmitted = 0, transmitted_square = 0;

    explicit Sums(std::size_t views = 0) : value(views), square(views) {}
    void add(const Sums &other);
};

struct WalkRules {
    int max_bounces = 0; // hits after the first; 0: all
    double energy_bound = 0.5;
    LightPart part = LightPart::all;
};

// One batch. \param random the batch's own. Returns the number of rays.
std::uint64_t walk(const FilamentScene &scene, const std::vector<FilamentMatter> &matter,
                   const LightViews &light, const WalkRules &rules, Random random, Sums &sums);

} // namespace tsuya::lab
