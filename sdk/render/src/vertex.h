#pragma once
// A vertex of a path: cloth at a point, seen from the path's previous vertex.

#include <optional>

#include "traced_scene.h"

namespace tsuya {

// The cloth is shaded in the frame of its shading normal, which differs from the triangle's normal.
// Directions that lie above one and below the other are mirrored at the plane of the triangle. So
// no light leaks through the triangle, and none is lost: of each direction on the proper side, the
// vertex's value and density are the sums of the cloth's own there and at its mirror image.
//
// Where the smooth surface bulges over the triangle, light that arrives above its shading normal's
// horizon and below the triangle passes over the triangle's edge: it is not mirrored, but goes from
// and to the smooth surface [Hanika], unless something lies between that and the triangle. So the
// light ends where the smooth surface turns away from it.
class Vertex {
  public:
    // \param direction of the ray that hit the point
    // \param wide light was scattered diffusely on the path before
    // \param near where yarns are told apart; else null
    Vertex(const TracedScene &scene, const SurfacePoint &point, const glm::vec3 &direction,
           bool wide, const NearPlace *near = nullptr)
        : scene_(scene), point_(point), shading_(scene.shading_of(point.cloth, wide)),
          to_viewer_(point.frame.to_local(-direction)), view_(shading_.view_terms(to_viewer_)),
          bulges_(glm::dot(point.bulge, point.geometric_normal) > point.error) {
        view_.near = near;
    }

    const glm::vec3 &position() const { return point_.position; }
    Receiver receiver() const {
        return {point_.position, bulges_ ? point_.frame.normal : point_.geometric_normal,
                shading_.transmits()};
    }
    // Light from this direction can arrive at the viewer.
    bool accepts(const glm::vec3 &to_light) const {
        return shading_.transmits() || is_above(to_light) || passes_over(to_light);
    }
    // f cos, and the density that `sample` has for this direction.
    Weighed weigh(const glm::vec3 &to_light) const;
    // A direction to light, in the world. Its density is above 0.
    // \param part which part of the cloth scatters, and from which side
    // \param direction within that part
    std::optional<LightSample> sample(glm::vec2 part, glm::vec2 direction) const;
    // Where a ray of this direction starts: off the triangle, on the side to which it goes, or on
    // the smooth surface.
    glm::vec3 ray_origin(const glm::vec3 &direction) const;

  private:
    bool is_above(const glm::vec3 &d) const { return glm::dot(d, point_.geometric_normal) > 0; }
    // Above the smooth surface, and not above the triangle.
    bool passes_over(const glm::vec3 &d) const {
        return bulges_ && glm::dot(d, point_.frame.normal) > 0 && !is_above(d);
    }
    glm::vec3 mirrored(const glm::vec3 &d) const {
        return d - 2 * glm::dot(d, point_.geometric_normal) * point_.geometric_normal;
    }

    const TracedScene &scene_;
    const SurfacePoint &point_;
    const Shading &shading_;
    glm::vec3 to_viewer_; // local
    ViewTerms view_;
    bool bulges_; // the smooth surface does, over the triangle
};

} // namespace tsuya
