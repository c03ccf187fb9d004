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
    /// Tolerance of what a pixel sees at a distance or beyond, metres.
    double footprint(double distance) const;
    bool seen(const glm::dvec3 &centre, double radius) const;
    /// The same by what a shadow in the picture needs.
    double shadow_tolerance(const glm::dvec3 &centre, double radius, const ViewLight &light) const;

    ViewTolerance view_;
    double pixel_; ///< tolerance in metres at a distance of one metre
    /// Normals of the planes of the view, inward, through the eye.
    std::array<glm::dvec3, 5> plane_;
};

} // namespace tsuya::garment
