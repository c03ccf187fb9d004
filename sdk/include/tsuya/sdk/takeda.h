#pragma once
/// \file
/// The model of [Takeda] in the great-circle form: the BARD moved and scaled to every direction of
/// light.

#include <optional>

#include <glm/glm.hpp>

#include "tsuya/sdk/albedo_table.h"
#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/disk_table.h"
#include "tsuya/sdk/distribution.h"
#include "tsuya/sdk/great_circle.h"
#include "tsuya/sdk/sampled_direction.h"

namespace tsuya {

/// rho_s(V, L) of [Takeda] Eq. 14 in its regular form. Not reciprocal. Energy-limited: where the
/// share of light from one direction that is reflected would exceed 1 (near grazing), the model is
/// scaled to 1. See brdf.h for the contract.
class TakedaBrdf {
  public:
    static constexpr bool kReciprocal = false;
    static constexpr bool kEnergyLimited = true;

    /// \param f0 reflectance of the facets at normal incidence, in (0, 1]
    TakedaBrdf(const Bard &bard, double f0);

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

    /// Largest albedo_of_light before it was limited.
    float unlimited_albedo() const { return unlimited_albedo_; }

  private:
    struct Terms;
    Terms terms(const glm::vec3 &to_light, const glm::vec3 &to_viewer,
                const glm::vec3 &basic) const;
    float limit(const glm::vec3 &to_light) const;
    void tabulate_albedos(Symmetry symmetry);
    std::optional<glm::vec3> draw_view(const glm::vec3 &to_light, const glm::vec3 &u) const;
    float density_of_basic(const glm::vec3 &basic) const;
    float density_of_view(const GreatCircle &circle) const;
    float density_of_light(const GreatCircle &circle, const glm::vec3 &to_light,
                           const glm::vec3 &to_viewer) const;

    float f0_ = 0.05f;
    bool half_turn_ = true;      ///< rho0 repeats after half a turn: the even proposal can be used
    DiskTable scaled_{};         ///< rho0(V0) max(cos theta0, 1/2) / F(cos(theta0/2))
    Distribution2D density_{};   ///< proportional to rho0 cos theta0, on the square of the disk
    AlbedoTable light_albedo_{}; ///< before the limit
    AlbedoTable view_albedo_{};
    float unlimited_albedo_ = 0;
    float limited_below_ = 0; ///< cosine of the light from which on nothing is limited
};

} // namespace tsuya
