#pragma once
// Lights as the path tracer samples and meets them.

#include <optional>
#include <vector>

#include "tsuya/sdk/detail/distribution.h"
#include "tsuya/sdk/plan.h"
#include "tsuya/sdk/scene.h"

namespace tsuya {

struct LightRay {
    glm::vec3 to_light;
    float distance; // infinite for the environment
    float radiance;
    float pdf; // 1/sr
    std::uint32_t group;
};

class Lights {
  public:
    Lights(const Scene &scene, const Plan &plan, const glm::dvec3 &centre, double scene_radius);

    // Lights that are sampled from a point: rectangles, and an environment with a picture. An even
    // environment is left to the surface's own sampling, which is exact for it on a diffuser.
    std::size_t count() const { return choice_.size(); }
    // Probability of choosing one light, in proportion to what it gives to the middle of the scene.
    float choice_probability(std::size_t light) const { return choice_[light]; }
    std::size_t choose(float u) const;
    std::optional<LightRay> sample(std::size_t light, const glm::vec3 &from, glm::vec2 u) const;

    // Calls `meet(radiance, group, pdf, light)` for every rectangle that the ray crosses nearer
    // than `farthest`; pdf is what `sample` of that light has for this direction.
    template <class F>
    void meet_rectangles(const glm::vec3 &from, const glm::vec3 &direction, float farthest,
                         F &&meet) const {
        for (std::size_t i = 0; i < rectangles_.size(); ++i) {
            const Rectangle &r = rectangles_[i];
            const float facing = -glm::dot(direction, r.normal);
            if (!(facing > 0))
                continue;
            const glm::vec3 offset = r.corner - from;
            const float t = -glm::dot(offset, r.normal) / facing;
            if (!(t > 0 && t < farthest))
                continue;
            const glm::vec3 p = t * direction - offset;
            const float a = glm::dot(p, r.dual_u), b = glm::dot(p, r.dual_v);
            if (a >= 0 && a <= 1 && b >= 0 && b <= 1)
                meet(r.radiance, r.group, t * t / (facing * r.area), i);
        }
    }
    // The environment in a direction: radiance, and the density that `sample` has there (0 if not
    // sampled).
    bool has_environment() const { return environment_; }
    float environment_radiance(const glm::vec3 &direction) const;
    float environment_pdf(const glm::vec3 &direction) const;
    std::uint32_t environment_group() const { return environment_group_; }
    bool environment_visible() const { return environment_visible_; }
    std::size_t environment_light() const { return rectangles_.size(); }

  private:
    struct Rectangle {
        glm::vec3 corner, edge_u, edge_v, normal, dual_u, dual_v;
        float area, radiance;
        std::uint32_t group;
    };
    glm::vec2 square_of(const glm::vec3 &direction) const;

    std::vector<Rectangle> rectangles_;
    std::vector<float> choice_;
    bool environment_ = false, environment_visible_ = true;
    std::uint32_t environment_group_ = 0;
    float environment_scale_ = 0;
    const Image *picture_ = nullptr;
    Distribution2D environment_density_;
};

} // namespace tsuya
