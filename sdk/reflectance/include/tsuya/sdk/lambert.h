#pragma once
/// \file
/// The ideal diffuse reflector. Reciprocal, energy-limited.

#include <optional>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/sampled_direction.h"

namespace tsuya {

/// f = albedo/pi. Sampled by the cosine. See brdf.h for the contract.
class LambertBrdf {
  public:
    static constexpr bool kReciprocal = true;
    static constexpr bool kEnergyLimited = true;

    /// \param albedo in [0, 1]
    explicit constexpr LambertBrdf(float albedo = 1) : albedo_(albedo) {}

    float evaluate(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    float evaluate_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    std::optional<SampledDirection> sample(const glm::vec3 &to_viewer, const glm::vec3 &u) const;
    std::optional<SampledDirection> sample_adjoint(const glm::vec3 &to_light,
                                                   const glm::vec3 &u) const;
    float pdf(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    WeighedLight weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    float pdf_adjoint(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    float albedo_of_light(const glm::vec3 &to_light) const;
    float albedo_of_view(const glm::vec3 &to_viewer) const;

  private:
    float albedo_;
};

} // namespace tsuya
