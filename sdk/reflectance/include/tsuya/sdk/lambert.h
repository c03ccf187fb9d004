#pragma once
/// \file
/// The ideal diffuse reflector.
///
///     f = albedo / pi
///
/// | parameter | range | meaning |
/// |---|---|---|
/// | albedo | 0 to 1, default 1 | share of the light that is reflected, from every direction |
///
/// Reciprocal, energy-limited, sampled by the cosine. No woven cloth is one: it stands for plain
/// bodies and backdrops, and for what is left of a cloth where its yarns are not told apart.

#include <optional>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/brdf_core.h"
#include "tsuya/sdk/detail/table_parts.h"

namespace tsuya {

class LambertCore {
  public:
    static constexpr bool kReciprocal = true;
    static constexpr bool kEnergyLimited = true;

    explicit constexpr LambertCore(float albedo = 1) : albedo_(albedo) {}
    /// From a file of tables, see detail/table_parts.h.
    explicit LambertCore(detail::TableReader &from);

    WeighedLight weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    glm::vec3 draw(const glm::vec3 &fixed, const glm::vec3 &u) const;
    float albedo(const glm::vec3 &) const { return albedo_; }

  private:
    template <class F, detail::MaybeConst<LambertCore> T> friend void each_part(F &&f, T &t) {
        auto &[of_all] = t;
        f(of_all);
    }

    float albedo_;
};

extern template class Model<LambertCore>;
/// The model, with the functions of Brdf.
using LambertBrdf = Model<LambertCore>;

} // namespace tsuya
