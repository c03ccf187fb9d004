#pragma once
// The angles by which a luminaire's profile is read.

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/light.h"

namespace tsuya {

struct ProfileFrame {
    glm::dvec3 axis, zero, quarter; // of the horizontal angles 0 and a right angle

    explicit ProfileFrame(const PointLight &light)
        : axis(glm::normalize(light.direction)),
          zero(light.zero_plane - glm::dot(light.zero_plane, axis) * axis) {
        if (!(glm::length(zero) > 1e-9 * glm::length(light.zero_plane))) // along the axis: any
            zero = glm::cross(axis,
                              std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
        zero = glm::normalize(zero);
        quarter = glm::cross(zero, axis);
    }
    // \param away unit vector from the light
    double candela(const IntensityProfile &profile, const glm::dvec3 &away) const {
        return profile.at(std::acos(std::clamp(glm::dot(away, axis), -1.0, 1.0)),
                          std::atan2(glm::dot(away, quarter), glm::dot(away, zero)));
    }
};

} // namespace tsuya
