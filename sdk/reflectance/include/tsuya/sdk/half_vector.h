#pragma once
/// \file
/// The microfacet model of [Takeda] Eqs. 3-5 with the facets' distribution read off the BARD: the
/// value is looked up at the half vector, not carried along great circles.
///
///     f = D(H) F(L.H) G(L, V) / (cos_i cos_r)
///
/// | parameter | range | meaning |
/// |---|---|---|
/// | bard | see bard.h | the measured views with light from straight above; it is met exactly |
/// | f0 | above 0, to 1 | reflectance of the facets at normal incidence |
///
/// Reciprocal. Energy-limited: where the share of light from one direction that is reflected would
/// exceed 1, the model is scaled by what is needed there, at both ends alike. Light from straight
/// above shows facets tilted up to 45 degrees. What lies beyond is extrapolated, see
/// `is_extrapolated`: D falls off exponentially with the tilt, at each azimuth from its value at 45
/// degrees at the rate of its last 15 degrees, held between bounds. Views near grazing rest on it.

#include <optional>

#include <glm/glm.hpp>

#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/detail/brdf_core.h"
#include "tsuya/sdk/detail/disk_table.h"
#include "tsuya/sdk/detail/distribution.h"
#include "tsuya/sdk/detail/limited_albedo.h"
#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/progress.h"

namespace tsuya {

class HalfVectorCore {
  public:
    static constexpr bool kReciprocal = true;
    static constexpr bool kEnergyLimited = true;

    /// \param f0 reflectance of the facets at normal incidence, in (0, 1]; else throws Error
    HalfVectorCore(const Bard &bard, double f0, const Progress &progress = {});
    /// From a file of tables, see detail/table_parts.h.
    explicit HalfVectorCore(detail::TableReader &from);

    WeighedLight weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    glm::vec3 draw(const glm::vec3 &fixed, const glm::vec3 &u) const;
    float albedo(const glm::vec3 &direction) const;

    /// The value rests on facets that light from straight above does not show.
    static bool is_extrapolated(const glm::vec3 &to_light, const glm::vec3 &to_viewer);
    /// Largest albedo before it was limited.
    float unlimited_albedo() const { return albedo_.unlimited_maximum(); }

  private:
    template <class F, detail::MaybeConst<HalfVectorCore> T> friend void each_part(F &&f, T &t) {
        auto &[f0, facets, density, of_albedo] = t;
        f(f0, facets, density, of_albedo);
    }

    void tabulate_density();
    void tabulate_albedos(Symmetry symmetry, const Progress &progress);

    float f0_ = 0.05f;
    DiskTable facets_{};       ///< D over the horizontal part of H
    Distribution2D density_{}; ///< proportional to D N.H, on the square of that disk
    LimitedAlbedo albedo_{};
};

extern template class Model<HalfVectorCore>;
/// The model, with the functions of Brdf.
using HalfVectorBrdf = Model<HalfVectorCore>;

} // namespace tsuya
