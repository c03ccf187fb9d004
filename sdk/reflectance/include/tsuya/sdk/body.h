#pragma once
/// \file
/// The coloured part of a cloth of dyed filaments: light that was inside them, before its colour.
///
/// Light enters a filament, is coloured on its way, and leaves it on the cone about the filament's
/// axis: so the coloured part follows the yarns as the highlight does.
///
///     f = s(l) s(v) sum over warp and weft of D(H) g(delta) / (cos l + cos v),  s = (1 - E) q
///
/// E is the albedo of the surface, D the distribution of the filaments' normals that the surface
/// shows, more widely blurred, and delta the angle between light and viewer about the yarn. g is
/// what refraction makes of it, found by tracing clear filaments, see
/// sdk/docs/REFLECTANCE_STUDY.md. q is found by iteration so that surface and body together reflect
/// all light of a cloth without dye. What forgets its direction is the Lambertian part, see
/// delustre_of; that is not in here.
///
/// Reciprocal and energy-limited.

#include <functional>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/albedo_table.h"
#include "tsuya/sdk/detail/brdf_core.h"
#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/detail/yarn_cones.h"
#include "tsuya/sdk/detail/yarn_facets.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/yarn.h"

namespace tsuya {

class BodyCore {
  public:
    static constexpr bool kReciprocal = true;
    static constexpr bool kEnergyLimited = true;

    /// The body below a surface.
    /// \param lobes with a surface above 0 at some slope
    /// \param surface_albedo of unit directions with z > 0, in 0..1; called from several threads
    BodyCore(const YarnLobes &lobes, const std::function<float(const glm::vec3 &)> &surface_albedo,
             const Progress &progress = {});
    /// The body below the yarns' own surface.
    explicit BodyCore(const YarnBrdf &surface, const Progress &progress = {});
    /// From a file of tables, see detail/table_parts.h.
    explicit BodyCore(detail::TableReader &from);

    float f_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    WeighedLight weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    glm::vec3 draw(const glm::vec3 &fixed, const glm::vec3 &u) const;
    float albedo(const glm::vec3 &direction) const { return albedo_.at(direction); }

    std::size_t bytes() const {
        return facets_.bytes() + cones_.bytes() + scale_.bytes() + albedo_.bytes();
    }

  private:
    template <class F, detail::MaybeConst<BodyCore> T> friend void each_part(F &&f, T &t) {
        auto &[by_cosine, by_cones, facets, cones, scale, of_albedo] = t;
        f(by_cosine, by_cones, facets, cones, scale, of_albedo);
    }

    void close_energy(const std::function<float(const glm::vec3 &)> &surface_albedo,
                      const Progress &progress);

    // Shares of the samples: these fill the tables, in half the time; the constructor ends with
    // those of body.cpp
    float by_cosine_ = 0.2f, by_cones_ = 0;
    YarnFacets facets_{};
    YarnCones cones_{};
    AlbedoTable scale_{};  ///< (1 - E) q
    AlbedoTable albedo_{}; ///< 1 - E but for what the iteration leaves
};

/// Standard deviation of the slopes that light shows which was inside filaments of these lobes: it
/// is more widely spread than the highlight.
double body_roughness(const YarnLobes &lobes);

extern template class Model<BodyCore>;
/// BodyCore as a model, see brdf_core.h.
using BodyBrdf = Model<BodyCore>;

} // namespace tsuya
