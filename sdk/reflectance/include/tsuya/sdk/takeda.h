#pragma once
/// \file
/// The model of [Takeda] in the great-circle form: the BARD moved and scaled to every direction of
/// light.
///
///     f(L, V) cos_i cos_r / (F(L.H) G(L, V)) = rho0(V0) cos(theta0) / (F(cos(theta0/2)) G(N, V0))
///
/// [Takeda] Eq. 14, evaluated in a form that stays regular at grazing; V0 is the image of the view
/// under light from straight above by Eqs. 7-15, see great_circle.h.
///
/// | parameter | range | meaning |
/// |---|---|---|
/// | bard | see bard.h | the measured views with light from straight above |
/// | f0 | above 0, to 1 | reflectance of the facets at normal incidence |
///
/// Not reciprocal. Energy-limited: where the share of light from one direction that is reflected
/// would exceed 1 (near grazing), the model is scaled to 1. It keeps the shape of the highlight
/// under all lights: sdk/docs/ACCURACY.md has how far that carries.

#include <cstddef>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/detail/albedo_table.h"
#include "tsuya/sdk/detail/brdf_core.h"
#include "tsuya/sdk/detail/disk_table.h"
#include "tsuya/sdk/detail/distribution.h"
#include "tsuya/sdk/detail/great_circle.h"
#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/progress.h"

namespace tsuya {

class TakedaCore {
  public:
    static constexpr bool kReciprocal = false;
    static constexpr bool kEnergyLimited = true;

    /// \param f0 reflectance of the facets at normal incidence, in (0, 1]; else throws Error
    TakedaCore(const Bard &bard, double f0, const Progress &progress = {});
    /// From a file of tables, see detail/table_parts.h.
    explicit TakedaCore(detail::TableReader &from);

    float f_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    /// Of many pairs at once, 0 where a direction is not above the horizon.
    void f_cos(std::span<const glm::vec3> to_light, std::span<const glm::vec3> to_viewer,
               std::span<float> f_cos) const;
    WeighedLight weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    glm::vec3 draw(const glm::vec3 &to_viewer, const glm::vec3 &u) const;
    float albedo(const glm::vec3 &to_light) const;
    WeighedLight weigh_view(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    glm::vec3 draw_view(const glm::vec3 &to_light, const glm::vec3 &u) const;
    float albedo_of_view(const glm::vec3 &to_viewer) const;

    /// Largest albedo_of_light before it was limited.
    float unlimited_albedo() const { return unlimited_albedo_; }

  private:
    template <class F, detail::MaybeConst<TakedaCore> T> friend void each_part(F &&f, T &t) {
        auto &[f0, half_turn, scaled, basics, halves, light_albedo, view_albedo, unlimited,
               limited_below] = t;
        f(f0, half_turn, scaled, basics, halves, light_albedo, view_albedo, unlimited,
          limited_below);
    }

    float limit(const glm::vec3 &to_light) const {
        return to_light.z < limited_below_ ? limit_at(to_light) : 1.0f;
    }
    float limit_at(const glm::vec3 &to_light) const;
    void tabulate_densities(const Progress &progress);
    void tabulate_albedos(Symmetry symmetry, const Progress &progress);

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

extern template class Model<TakedaCore>;
/// The model, with the functions of Brdf.
using TakedaBrdf = Model<TakedaCore>;

} // namespace tsuya
