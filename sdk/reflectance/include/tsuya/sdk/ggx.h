#pragma once
/// \file
/// Rough facets with the GGX distribution, wider along one axis than along the other: bodies,
/// props, and what a fabric is compared with.
///
///     f = D(H) F(L.H) G(L, V) / (4 cos_i cos_r)
///
/// D is the anisotropic GGX distribution, G Smith's height-correlated masking [Heitz], F Schlick's
/// Fresnel term or that of a dielectric.
///
/// | parameter | range | meaning |
/// |---|---|---|
/// | alpha_weft, alpha_warp | 1e-4 to 1 | root mean square slope of the facets along either axis |
/// | f0 | above 0, to 1 | what a facet reflects at normal incidence, after Schlick |
/// | refractive_index | above 1, to 10 | the exact term of a dielectric, in place of f0 |
///
/// Reciprocal. Energy-limited by its form; what light would do between the facets after the first
/// is lost, up to a half at alpha = 1. Samples the facets that the given direction sees
/// [Heitz2018]. It has one peak about the mirror direction: the two crossing highlights of a woven
/// cloth are beyond it.

#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/detail/albedo_table.h"
#include "tsuya/sdk/detail/brdf_core.h"
#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/progress.h"

namespace tsuya {

/// Authored. Roughness along weft and warp, and what one facet reflects.
struct GgxFacets {
    double alpha_weft = 0.3, alpha_warp = 0.3; ///< width of the slopes, in [1e-4, 1]
    double f0 = 0.05; ///< at normal incidence, in (0, 1]: Fresnel's term after Schlick
    /// Above 1: the exact Fresnel term of a dielectric, and f0 has no part.
    std::optional<double> refractive_index{};

    bool operator==(const GgxFacets &) const = default;
};

/// Throws Error naming `where`: a value out of its range.
void check_ggx(const GgxFacets &facets, const std::string &where);

/// The facets, with Schlick's term, whose reflectance under light from straight above is nearest to
/// the BARD: least squares of rho0 cos theta over the hemisphere.
GgxFacets fit_ggx(const Bard &bard, const Progress &progress = {});

class GgxCore {
  public:
    static constexpr bool kReciprocal = true;
    static constexpr bool kEnergyLimited = true;

    /// Throws Error as check_ggx.
    explicit GgxCore(const GgxFacets &facets, const Progress &progress = {});
    /// From a file of tables, see detail/table_parts.h.
    explicit GgxCore(detail::TableReader &from);

    WeighedLight weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    glm::vec3 draw(const glm::vec3 &fixed, const glm::vec3 &u) const;
    float albedo(const glm::vec3 &direction) const;

    /// The facets with a slope of at least 0.3 along both axes; empty where they have it already.
    std::optional<GgxFacets> widened() const;

  private:
    template <class F, detail::MaybeConst<GgxCore> T> friend void each_part(F &&f, T &t) {
        auto &[alpha_weft, alpha_warp, f0, index, of_albedo] = t;
        f(alpha_weft, alpha_warp, f0, index, of_albedo);
    }

    float fresnel_of(float cosine) const;
    float facets(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    float stretched(const glm::vec3 &direction) const;

    float alpha_weft_, alpha_warp_, f0_;
    float index_ = 0; ///< 0: Schlick
    AlbedoTable albedo_{};
};

extern template class Model<GgxCore>;
/// The model, with the functions of Brdf.
using GgxBrdf = Model<GgxCore>;

} // namespace tsuya
