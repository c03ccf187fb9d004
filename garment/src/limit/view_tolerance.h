#pragma once
/// \file
/// How exact a face must be for a camera and its lights.

#include <vector>

#include "tsuya/garment/subdivide.h"

namespace tsuya::garment {

/// Tolerances of spheres about faces.
class ViewNeed {
  public:
    explicit ViewNeed(const ViewTolerance &view);

    /// Metres; infinite where neither the camera nor a light can need more than the control face.
    double tolerance(const glm::dvec3 &centre, double radius) const;

  private:
    /// A plane about what the camera sees.
    struct Plane {
        glm::dvec3 normal; ///< inward
        double at_eye;     ///< distance of the eye inside of it, metres
    };
    void bound_perspective(const CameraAxes &axes);
    void bound_parallel(const CameraAxes &axes);
    /// Tolerance of what a pixel sees at a distance or beyond, metres.
    double footprint(double distance) const;
    bool seen(const glm::dvec3 &centre, double radius) const;
    /// The same by what a shadow in the picture needs.
    double shadow_tolerance(const glm::dvec3 &centre, double radius, const ViewLight &light) const;

    ViewTolerance view_;
    double pixel_;        ///< tolerance in metres, of a perspective at a distance of one metre
    double aperture_ = 0; ///< its radius, metres
    std::vector<Plane> plane_{};
};

} // namespace tsuya::garment
