#pragma once
// Lights as the path tracer samples and meets them.

#include <limits>
#include <optional>
#include <vector>

#include "light_rectangle.h"
#include "light_tree.h"
#include "tsuya/sdk/detail/distribution.h"
#include "tsuya/sdk/plan.h"
#include "tsuya/sdk/scene.h"

namespace tsuya {

// A light that a ray meets. The densities are those with which `sample` and `choose` find it.
struct LightMet {
    float radiance;
    std::uint32_t group;
    std::size_t light;
    float pdf; // 1/sr
};

class Lights {
  public:
    Lights(const Scene &scene, const Plan &plan, const glm::dvec3 &centre, double scene_radius);

    // Lights that are sampled from a point: rectangles, and an environment with a picture. An even
    // environment is left to the surface's own sampling, which is exact for it on a diffuser.
    std::size_t count() const { return rectangles_.size() + (picture_ ? 1 : 0); }
    // One light, by what it may give to the receiver. None where none gives anything.
    std::optional<ChosenLight> choose(const Receiver &receiver, float u) const;
    // Probability that `choose` gives this light.
    float choice_probability(const Receiver &receiver, std::size_t light) const;
    std::optional<LightRay> sample(std::size_t light, const glm::vec3 &from, glm::vec2 u) const;

    // Calls `meet(LightMet)` for every rectangle that the ray crosses nearer than `farthest`.
    template <class F>
    void meet_rectangles(const glm::vec3 &from, const glm::vec3 &direction, float farthest,
                         F &&meet) const {
        tree_.cross(from, direction, [&](std::size_t i) {
            const LightRectangle &r = rectangles_[i];
            const std::optional<float> distance = r.crossing(from, direction);
            if (distance && *distance < farthest)
                meet(LightMet{r.radiance(), r.group(), i, r.pdf(from, direction, *distance)});
            return false;
        });
    }
    // The ray crosses a rectangle from its front, were nothing in its way.
    bool crosses_rectangle(const glm::vec3 &from, const glm::vec3 &direction) const {
        return tree_.cross(from, direction, [&](std::size_t i) {
            return rectangles_[i].crossing(from, direction).has_value();
        });
    }
    bool has_environment() const { return environment_; }
    bool environment_visible() const { return environment_visible_; }
    // The environment in a direction; `pdf` is 0 where it is not sampled.
    LightMet meet_environment(const glm::vec3 &direction) const;

  private:
    std::size_t environment_light() const { return rectangles_.size(); }
    float environment_radiance(const glm::vec3 &direction) const;
    float environment_pdf(const glm::vec3 &direction) const;
    glm::vec2 square_of(const glm::vec3 &direction) const;

    std::vector<LightRectangle> rectangles_;
    LightTree tree_;
    float environment_choice_ = 0; // probability; the tree has the rest
    bool environment_ = false, environment_visible_ = true;
    std::uint32_t environment_group_ = 0;
    float environment_scale_ = 0;
    const Image *picture_ = nullptr;
    Distribution2D environment_density_;
};

} // namespace tsuya
