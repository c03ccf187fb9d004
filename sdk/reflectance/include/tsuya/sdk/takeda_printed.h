#pragma once
/// \file
/// The model of [Takeda] with Eqs. 16-17 as they are printed: for reproducing the paper, and
/// nothing else.
///
/// The formula of takeda.h with V0 = printed_basic(L, V), and the parameters of takeda.h. Not
/// reciprocal, not limited in energy; it jumps where the view passes through the normal.

#include <optional>

#include <glm/glm.hpp>

#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/detail/albedo_table.h"
#include "tsuya/sdk/detail/brdf_core.h"
#include "tsuya/sdk/detail/direction_sampler.h"
#include "tsuya/sdk/detail/disk_table.h"
#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/progress.h"

namespace tsuya {

/// V0 by [Takeda] Eqs. 15-17: theta0 = a - (beta0/beta)(a - theta_r), phi0 = (beta0/beta) phi_r
/// with a = pi/2. We read phi_r as counted from R, the horizontal direction away from the light.
/// Not continuous at V = N. Both unit with z >= 0; light from straight above gives the identity.
glm::vec3 printed_basic(const glm::vec3 &to_light, const glm::vec3 &to_viewer);

struct FacetTerms;

class TakedaPrintedCore {
  public:
    static constexpr bool kReciprocal = false;
    static constexpr bool kEnergyLimited = false;

    /// \param f0 reflectance of the facets at normal incidence, in (0, 1]; else throws Error
    TakedaPrintedCore(const Bard &bard, double f0, const Progress &progress = {});
    /// From a file of tables, see detail/table_parts.h.
    explicit TakedaPrintedCore(detail::TableReader &from);

    float f_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    WeighedLight weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    glm::vec3 draw(const glm::vec3 &to_viewer, const glm::vec3 &u) const;
    float albedo(const glm::vec3 &to_light) const;
    WeighedLight weigh_view(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    glm::vec3 draw_view(const glm::vec3 &to_light, const glm::vec3 &u) const;
    float albedo_of_view(const glm::vec3 &to_viewer) const;

  private:
    template <class F, detail::MaybeConst<TakedaPrintedCore> T> friend void each_part(F &&f, T &t) {
        auto &[f0, scaled, lights, views, light_albedo, view_albedo] = t;
        f(f0, scaled, lights, views, light_albedo, view_albedo);
    }

    FacetTerms terms(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;

    float f0_ = 0.05f;
    DiskTable scaled_{}; ///< rho0(V0) max(cos theta0, 1/2) / F(cos(theta0/2))
    DirectionSampler lights_{}, views_{};
    AlbedoTable light_albedo_{}, view_albedo_{};
};

extern template class Model<TakedaPrintedCore>;
/// The model, with the functions of Brdf.
using TakedaPrintedBrdf = Model<TakedaPrintedCore>;

} // namespace tsuya
