#pragma once
/// \file
/// The microfacet model of [Takeda] Eqs. 3-5 with the facets' distribution read off the BARD: the
/// value is looked up at the half vector, not carried along great circles.

#include <optional>

#include <glm/glm.hpp>

#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/detail/disk_table.h"
#include "tsuya/sdk/detail/distribution.h"
#include "tsuya/sdk/detail/limited_albedo.h"
#include "tsuya/sdk/detail/sampled_direction.h"

namespace tsuya {

/// D(H) F(L.H) G(L, V) / (cos theta_i cos theta_r) in its regular form. Equal to the BARD for light
/// from straight above. Reciprocal. Energy-limited: where the share of light from one direction
/// that is reflected would exceed 1, the model is scaled by what is needed there, at both ends
/// alike. See brdf.h for the contract.
///
/// Light from straight above shows facets tilted up to 45 degrees. What lies beyond is
/// extrapolated, see `is_extrapolated`: D falls off exponentially with the tilt, at each azimuth
/// from its value at 45 degrees at the rate of its last 15 degrees, held between bounds.
class HalfVectorBrdf {
  public:
    static constexpr bool kReciprocal = true;
    static constexpr bool kEnergyLimited = true;

    /// \param f0 reflectance of the facets at normal incidence, in (0, 1]; else throws Error
    HalfVectorBrdf(const Bard &bard, double f0);

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

    /// The value rests on facets that light from straight above does not show.
    static bool is_extrapolated(const glm::vec3 &to_light, const glm::vec3 &to_viewer);
    /// Largest albedo before it was limited.
    float unlimited_albedo() const { return albedo_.unlimited_maximum(); }

  private:
    struct Terms;
    Terms terms(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    void tabulate_density();
    void tabulate_albedos(Symmetry symmetry);

    float f0_ = 0.05f;
    DiskTable facets_{};       ///< D over the horizontal part of H
    Distribution2D density_{}; ///< proportional to D N.H, on the square of that disk
    LimitedAlbedo albedo_{};
};

} // namespace tsuya
