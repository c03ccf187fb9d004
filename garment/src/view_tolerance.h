#pragma once
/// \file
/// How exact a face must be for a camera and its lights.

#include <array>

#include "tsuya/garment/subdivide.h"

namespace tsuya::garment {

/// Tolerances of spheres about faces.
class ViewNeed {
  public:
    explicit ViewNeed(const ViewTolerance &view);

    /// Metres; infinite where neither the camera nor a light can need more than the control face.
    double tolerance(const glm::dvec3 &centre, double radius) const;

  private:
    double footprint(double distance) const { return pixel_ * distance; }
    bool seen(const glm::dvec3 &centre, double radius) const;
    /// The same by what a shadow in the picture needs.
    double shadow_tolerance(const glm::dvec3 &centre, double radius, const glm::dvec3 &light) const;

    ViewTolerance view_;
    double pixel_; ///< tolerance in metres at a distance of one metre
    std::array<glm::dvec3, 5>
        plane_; ///< normals of the planes of the view, inward, through the eye
};

} // namespace tsuya::garment
