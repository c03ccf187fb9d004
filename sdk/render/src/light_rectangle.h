#pragma once
// A rectangle that shines, in the scene's centred space.

#include <optional>

#include <glm/glm.hpp>

#include "light_bounds.h"
#include "light_ray.h"
#include "tsuya/sdk/light.h"

namespace tsuya {

// Sampled evenly over its solid angle where that is large and its sides are at right angles, else
// evenly over its area.
class LightRectangle {
  public:
    // \param centre the origin of the centred space
    LightRectangle(const RectangleLight &light, const glm::dvec3 &centre);

    float radiance() const { return radiance_; }
    double highest_intensity() const {
        return static_cast<double>(radiance_) * static_cast<double>(area_);
    }
    // \param power see LightBounds
    LightBounds bounds(float power) const;

    std::optional<LightRay> sample(const glm::vec3 &from, glm::vec2 u) const;
    // Distance at which a ray crosses the rectangle from its front.
    std::optional<float> crossing(const glm::vec3 &from, const glm::vec3 &direction) const {
        const float facing = -glm::dot(direction, normal_);
        if (!(facing > 0))
            return std::nullopt;
        const glm::vec3 offset = corner_ - from;
        const float t = -glm::dot(offset, normal_) / facing;
        if (!(t > 0))
            return std::nullopt;
        const glm::vec3 p = t * direction - offset;
        const float a = glm::dot(p, dual_u_), b = glm::dot(p, dual_v_);
        if (a >= 0 && a <= 1 && b >= 0 && b <= 1)
            return t;
        return std::nullopt;
    }
    // Distance at which a ray crosses it from either side.
    std::optional<float> obstacle(const glm::vec3 &from, const glm::vec3 &direction) const {
        const float facing = -glm::dot(direction, normal_);
        const glm::vec3 offset = corner_ - from;
        const float t = -glm::dot(offset, normal_) / facing;
        if (!(t > 0))
            return std::nullopt;
        const glm::vec3 p = t * direction - offset;
        const float a = glm::dot(p, dual_u_), b = glm::dot(p, dual_v_);
        return a >= 0 && a <= 1 && b >= 0 && b <= 1 ? std::optional(t) : std::nullopt;
    }
    // What `sample` has, 1/sr, for a direction that crosses the rectangle at a distance.
    float pdf(const glm::vec3 &from, const glm::vec3 &direction, float distance) const;

  private:
    // The rectangle from a point, in a frame of its sides: from (x0, y0) to (x1, y1), `height`
    // below the point.
    struct Seen {
        float x0, x1, y0, y1, height;
    };
    Seen seen(const glm::vec3 &from) const;
    // Steradians; 0 where the area is sampled.
    float sampled_angle(const Seen &s) const;
    static glm::vec2 sample_angle(const Seen &s, float solid_angle, glm::vec2 u);

    glm::vec3 corner_, edge_u_, edge_v_, normal_;
    glm::vec3 dual_u_, dual_v_; // of the edges, in the rectangle's plane
    glm::vec3 side_x_, side_y_; // unit vectors along the edges
    float width_, height_, area_, radiance_;
    bool right_angled_;
};

} // namespace tsuya
