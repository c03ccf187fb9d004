#pragma once
/// \file
/// A whole table of light and view as a model: the truth that the others are held to.
///
/// | parameter | range | meaning |
/// |---|---|---|
/// | table | light from 4 directions, 6 views of each | measured or simulated rows |
///
/// Meets every row of the table, averaged over the mirror images that its symmetry makes equal.
/// Between the rows it is linear along V0 of [Takeda]: highlights move with the light and do not
/// fade over. Beyond the outermost ring of lights or views the outermost is carried on. Neither
/// reciprocal nor limited in energy: it is what was measured, its noise among it.

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/albedo_table.h"
#include "tsuya/sdk/detail/brdf_core.h"
#include "tsuya/sdk/detail/direction_sampler.h"
#include "tsuya/sdk/detail/ring_grid.h"
#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya {

struct FacetTerms;

class TabulatedCore {
  public:
    static constexpr bool kReciprocal = false;
    static constexpr bool kEnergyLimited = false;

    /// Throws Error naming `where`: light from fewer than 4 directions, or less than 6 views of
    /// one; as check_table.
    TabulatedCore(const ReflectanceTable &table, const std::string &where,
                  const Progress &progress = {});
    /// From a file of tables, see detail/table_parts.h.
    explicit TabulatedCore(detail::TableReader &from);

    float f_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    WeighedLight weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    glm::vec3 draw(const glm::vec3 &to_viewer, const glm::vec3 &u) const;
    float albedo(const glm::vec3 &to_light) const;
    WeighedLight weigh_view(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    glm::vec3 draw_view(const glm::vec3 &to_light, const glm::vec3 &u) const;
    float albedo_of_view(const glm::vec3 &to_viewer) const;

  private:
    template <class F, detail::MaybeConst<TabulatedCore> T> friend void each_part(F &&f, T &t) {
        auto &[lights, grid, light_sampler, view_sampler, light_albedo, view_albedo] = t;
        f(lights, grid, light_sampler, view_sampler, light_albedo, view_albedo);
    }

    struct Light {
        glm::vec3 to_light{0, 0, 1};
        RingGrid views{};
        std::vector<float> value{}; ///< rho cos_i cos_r over the masking of [Takeda] Eq. 4

        template <class F, detail::MaybeConst<Light> T> friend void each_part(F &&f, T &t) {
            auto &[of_light, of_views, of_value] = t;
            f(of_light, of_views, of_value);
        }
    };
    FacetTerms terms(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;

    std::vector<Light> lights_{};
    RingGrid grid_{};
    DirectionSampler light_sampler_{}, view_sampler_{};
    AlbedoTable light_albedo_{}, view_albedo_{};
};

extern template class Model<TabulatedCore>;
/// The model, with the functions of Brdf.
using TabulatedBrdf = Model<TabulatedCore>;

} // namespace tsuya
