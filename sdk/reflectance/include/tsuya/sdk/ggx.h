#pragma once
/// \file
/// Rough facets with the GGX distribution, wider along one axis than along the other: bodies,
/// props, and what a fabric is compared with.

#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/albedo_table.h"
#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/detail/sampled_direction.h"

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
GgxFacets fit_ggx(const Bard &bard);

/// D F G / (4 cos_i cos_r) with the anisotropic GGX distribution and Smith's height-correlated
/// masking [Heitz]. Reciprocal. Energy-limited by its form; what light would do between the facets
/// after the first is lost. Draws the facets that the given direction sees [Heitz2018]. See brdf.h
/// for the contract.
class GgxBrdf {
  public:
    static constexpr bool kReciprocal = true;
    static constexpr bool kEnergyLimited = true;

    /// Throws Error as check_ggx.
    explicit GgxBrdf(const GgxFacets &facets);

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
    float fresnel_of(float cosine) const;
    float facets(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    float stretched(const glm::vec3 &direction) const;

    float alpha_weft_, alpha_warp_, f0_;
    float index_ = 0; ///< 0: Schlick
    AlbedoTable albedo_{};
};

} // namespace tsuya
