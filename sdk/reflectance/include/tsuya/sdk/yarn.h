#pragma once
/// \file
/// The reflectance of a cloth from what its two systems of yarns do: cylinders in yarns of many
/// slopes, fitted to the views with light from straight above.
///
///     f = sum over warp and weft of D(H) (F M + second reflections) G / (4 cos_i cos_r)
///         + loose F / (2 pi (cos_i + cos_r)) + diffuse part
///
/// D is that of rough cylinders at the slopes of YarnLobes, known at every tilt; F is the Fresnel
/// term of a dielectric; M the masking of filaments and yarns side by side, G that of V-grooves
/// along the yarn ([Takeda] Eq. 4 in the plane along the yarn). D falls by what a yarn that dives
/// between its neighbours loses to them. Loose filaments lie at all slopes: the facets of GGX with
/// a roughness of 1.
///
/// | parameter | range | meaning |
/// |---|---|---|
/// | lobes.f0 | above 0, to 1 | reflectance of the fibre at normal incidence |
/// | lobes.roughness | 0.005 to 1 radians, to 0.6 fitted | of a filament's surface |
/// | lobes.surface | not below 0 | filaments at each slope along their yarn |
/// | lobes.pit | 0 or more | depth of the yarns between crossing ones |
/// | lobes.even | 0 to 1 | albedo of the diffuse part |
/// | lobes.loose | not below 0 | filaments at all slopes |
/// | lobes.dive | 0 or more | depth to which a yarn dives between its neighbours |
///
/// Reciprocal. Energy-limited: where the share of light from one direction that is reflected would
/// exceed 1, the model is scaled by what is needed there, at both ends alike. It knows nothing of
/// yarns that are not nearly straight and parallel: piles, knits, crepe.
/// sdk/docs/REFLECTANCE_STUDY.md has where the parts come from and how far they carry.

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/detail/brdf_core.h"
#include "tsuya/sdk/detail/half_vector_sampler.h"
#include "tsuya/sdk/detail/limited_albedo.h"
#include "tsuya/sdk/detail/slope_table.h"
#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/detail/yarn_depth.h"
#include "tsuya/sdk/detail/yarn_optics.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya {

class YarnCore {
  public:
    static constexpr bool kReciprocal = true;
    static constexpr bool kEnergyLimited = true;

    /// \param symmetry of the cloth; `none` keeps slopes that differ from their opposites
    explicit YarnCore(const YarnLobes &lobes, Symmetry symmetry = Symmetry::orthotropic,
                      const Progress &progress = {});
    /// Fits the lobes, see fit_yarn_lobes.
    /// \param f0 reflectance of the fibre at normal incidence, in (0, 1]; else throws Error
    YarnCore(const Bard &bard, double f0, const Progress &progress = {});
    /// From a file of tables, see detail/table_parts.h.
    explicit YarnCore(detail::TableReader &from);

    float f_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    WeighedLight weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    glm::vec3 draw(const glm::vec3 &fixed, const glm::vec3 &u) const;
    float albedo(const glm::vec3 &direction) const;

    const YarnLobes &lobes() const { return lobes_; }
    /// Largest albedo before it was limited.
    float unlimited_albedo() const { return albedo_.unlimited_maximum(); }

  private:
    template <class F, detail::MaybeConst<YarnCore> T> friend void each_part(F &&f, T &t) {
        [[maybe_unused]] auto &[lobes, optics, even_per_sr, loose_per_sr, mirrored, depth, facets,
                                draws, of_albedo] = t;
        f(lobes, even_per_sr, loose_per_sr, mirrored, depth, facets, draws, of_albedo);
    }

    glm::vec2 loose(const YarnHalf &half, const glm::vec3 &to_light,
                    const glm::vec3 &to_viewer) const;
    glm::vec2 times_light_cosine(const YarnHalf &half, const glm::vec3 &to_light,
                                 const glm::vec3 &to_viewer) const;
    void tabulate_draws(const Progress &progress);
    void tabulate_albedos(Symmetry symmetry, const Progress &progress);

    YarnLobes lobes_{};
    YarnOptics optics_{};
    glm::vec2 even_per_sr_{0};  ///< diffuse part of weft and warp
    glm::vec2 loose_per_sr_{0}; ///< half of D of loose filaments
    bool mirrored_ = true;
    YarnDepth depth_{};
    SlopeTable facets_{};
    HalfVectorSampler draws_{};
    LimitedAlbedo albedo_{};
};

extern template class Model<YarnCore>;
/// The model, with the functions of Brdf.
using YarnBrdf = Model<YarnCore>;

} // namespace tsuya
