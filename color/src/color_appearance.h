#pragma once
/// \file
/// CIECAM02 and its uniform colour space, in the viewing conditions of [CIE224].

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace tsuya {

/// An eye that is fully adapted to a white of 100 cd/m2 before a grey of Y = 20.
class AppearanceModel {
  public:
    /// \param white_xyz of the lamp, with Y = 100
    explicit AppearanceModel(const glm::dvec3 &white_xyz);

    /// J', a', b' of CAM02-UCS.
    glm::dvec3 uniform(const glm::dvec3 &xyz) const;

  private:
    /// Signals of the cones after compression.
    glm::dvec3 responses(const glm::dvec3 &xyz) const;

    glm::dmat3 to_cones_{1.0};
    double white_response_ = 1;
};

} // namespace tsuya
