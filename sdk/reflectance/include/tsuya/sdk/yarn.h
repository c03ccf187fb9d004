#pragma once
/// \file
/// The reflectance of a cloth from what its two systems of yarns do: cylinders in yarns of many
/// slopes, fitted to the views with light from straight above.

#include <array>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/detail/half_vector_sampler.h"
#include "tsuya/sdk/detail/limited_albedo.h"
#include "tsuya/sdk/detail/sampled_direction.h"
#include "tsuya/sdk/yarn_lobes.h"
#include "tsuya/sdk/detail/yarn_optics.h"

namespace tsuya {

/// The sum over warp and weft of D(H) (F M + second reflections) G / (4 cos theta_i cos theta_r),
/// and an even part. D is that of rough cylinders at the slopes of YarnLobes, known at every tilt;
/// F is the Fresnel term of a dielectric; M the masking of filaments and yarns side by side, G that
/// of V-grooves along the yarn ([Takeda] Eq. 4 in the plane along the yarn). Reciprocal.
/// Energy-limited: where the share of light from one direction that is reflected would exceed 1,
/// the model is scaled by what is needed there, at both ends alike. See brdf.h for the contract and
/// sdk/docs/REFLECTANCE_STUDY.md for where the parts come from and how far they carry.
class YarnBrdf {
  public:
    static constexpr bool kReciprocal = true;
    static constexpr bool kEnergyLimited = true;

    /// \param symmetry of the cloth; `none` keeps slopes that differ from their opposites
    explicit YarnBrdf(const YarnLobes &lobes, Symmetry symmetry = Symmetry::orthotropic);
    /// Fits the lobes, see fit_yarn_lobes.
    /// \param f0 reflectance of the fibre at normal incidence, in (0, 1]; else throws Error
    YarnBrdf(const Bard &bard, double f0);

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

    const YarnLobes &lobes() const { return lobes_; }
    /// Largest albedo before it was limited.
    float unlimited_albedo() const { return albedo_.unlimited_maximum(); }

  private:
    glm::vec2 facets(const glm::vec3 &half) const;
    glm::vec2 times_light_cosine(const YarnHalf &half, const glm::vec3 &to_light,
                                 const glm::vec3 &to_viewer) const;
    void tabulate_facets();
    void tabulate_draws();
    void tabulate_albedos(Symmetry symmetry);

    YarnLobes lobes_{};
    YarnOptics optics_{};
    std::array<float, 2> pit_{};
    glm::vec2 even_per_sr_{0}; ///< even part of weft and warp
    bool mirrored_ = true;
    int nodes_ = 0;
    std::vector<glm::vec2> facets_{}; ///< D of weft and warp over the horizontal part of H
    HalfVectorSampler draws_{};
    LimitedAlbedo albedo_{};
};

} // namespace tsuya
