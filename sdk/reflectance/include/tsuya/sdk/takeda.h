#pragma once
/// \file
/// The model of [Takeda] in the great-circle form: the BARD moved and scaled to every direction of
/// light.

#include <cstddef>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/albedo_table.h"
#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/detail/disk_table.h"
#include "tsuya/sdk/detail/distribution.h"
#include "tsuya/sdk/detail/great_circle.h"
#include "tsuya/sdk/detail/sampled_direction.h"

namespace tsuya {

/// rho_s(V, L) of [Takeda] Eq. 14 in its regular form. Not reciprocal. Energy-limited: where the
/// share of light from one direction that is reflected would exceed 1 (near grazing), the model is
/// scaled to 1. See brdf.h for the contract.
class TakedaBrdf {
  public:
    static constexpr bool kReciprocal = false;
    static constexpr bool kEnergyLimited = true;

    /// \param f0 reflectance of the facets at normal incidence, in (0, 1]; else throws Error
    TakedaBrdf(const Bard &bard, double f0);

    float evaluate(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    float evaluate_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    /// The same for many pairs at once, several times as fast where the processor has wide vectors:
    /// equal to the calls one by one but for rounding. The spans are of one length.
    void evaluate_cos(std::span<const glm::vec3> to_light, std::span<const glm::vec3> to_viewer,
                      std::span<float> f_cos) const;
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
    /// Memory of the tables.
    std::size_t table_bytes() const;

  private:
    float limit(const glm::vec3 &to_light) const {
        return to_light.z < limited_below_ ? limit_at(to_light) : 1.0f;
    }
    float limit_at(const glm::vec3 &to_light) const;
    void tabulate_densities();
    void tabulate_albedos(Symmetry symmetry);
    std::optional<glm::vec3> draw_view(const glm::vec3 &to_light, const glm::vec3 &u) const;
    float density_of_view(const GreatCircle &circle) const;

    float f0_ = 0.05f;
    bool half_turn_ = true; ///< rho0 repeats after half a turn: the even proposal can be used
    DiskTable scaled_{};    ///< rho0(V0) max(cos theta0, 1/2) / F(cos(theta0/2))
    Distribution2D
        basics_{}; ///< of V0, proportional to rho0 cos theta0, on the square about its disk
    Distribution2D halves_{};    ///< of H, on the square about the disk of its horizontal part
    AlbedoTable light_albedo_{}; ///< before the limit
    AlbedoTable view_albedo_{};
    float unlimited_albedo_ = 0;
    float limited_below_ = 0; ///< cosine of the light from which on nothing is limited
};

} // namespace tsuya
