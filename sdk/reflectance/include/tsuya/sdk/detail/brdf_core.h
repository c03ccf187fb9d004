#pragma once
/// \file
/// From the three operations that tell one reflectance model from another to the whole contract of
/// brdf.h.
///
/// A core says:
///
/// | operation | meaning |
/// |---|---|
/// | `weigh(to_light, to_viewer)` | f times the light's cosine, and the density of that light |
/// | `draw(fixed, u)` | samples a light for a view; if reciprocal, also a view for a light |
/// | `albedo(direction)` | share of the light from there that is reflected |
///
/// and one that is not reciprocal, for the way from the light to the view:
///
/// | operation | meaning |
/// |---|---|
/// | `weigh_view(to_light, to_viewer)` | f times the viewer's cosine, and the density of the view |
/// | `draw_view(to_light, u)` | samples a view for a light |
/// | `albedo_of_view(to_viewer)` | radiance seen from there under a uniform environment |
///
/// The directions that a core is given are unit with z > 0. Those that it samples are unit, or have
/// z <= 0, which makes a null sample. Where the value alone takes less time than
/// `weigh`, or is needed to make the tables of `draw`, a core also has `f_cos(to_light,
/// to_viewer)`, and it may have that for spans.

#include <algorithm>
#include <concepts>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/sampled_direction.h"

namespace tsuya {

// clang-format off
template <class Core>
concept TellsBothWays = requires(const Core &core, glm::vec3 a, glm::vec3 b) {
    { core.weigh_view(a, b) } -> std::same_as<WeighedLight>;
    { core.draw_view(a, b) } -> std::same_as<glm::vec3>;
    { core.albedo_of_view(a) } -> std::same_as<float>;
};

template <class Core>
concept BrdfCore = requires(const Core &core, glm::vec3 a, glm::vec3 b) {
    { core.weigh(a, b) } -> std::same_as<WeighedLight>;
    { core.draw(a, b) } -> std::same_as<glm::vec3>;
    { core.albedo(a) } -> std::same_as<float>;
    { Core::kReciprocal } -> std::convertible_to<bool>;
    { Core::kEnergyLimited } -> std::convertible_to<bool>;
} && (Core::kReciprocal || TellsBothWays<Core>);

template <class Core>
concept HasValueAlone = requires(const Core &core, glm::vec3 a) {
    { core.f_cos(a, a) } -> std::same_as<float>;
};

template <class Core>
concept HasBatches = requires(const Core &core, std::span<const glm::vec3> a, std::span<float> f) {
    core.f_cos(a, a, f);
};
// clang-format on

namespace detail {

/// A sampled direction with what the core weighs it to. Empty where its density is 0.
inline std::optional<SampledDirection> weighed_sample(const glm::vec3 &direction,
                                                      const WeighedLight &weighed) {
    if (!(weighed.pdf_per_sr > 0))
        return std::nullopt;
    // Made in place: a copy would be read in other pieces than it was written in, which defeats
    // store forwarding
    std::optional<SampledDirection> made(std::in_place);
    const float over = 1 / weighed.pdf_per_sr;
    made->direction = direction;
    made->weight = weighed.f_cos * over;
    made->pdf_per_sr = weighed.pdf_per_sr;
    made->weft = weighed.weft * over;
    return made;
}

/// Samples a light for a view with z > 0.
template <class Core>
std::optional<SampledDirection> sample_light(const Core &core, const glm::vec3 &to_viewer,
                                             const glm::vec3 &u) {
    const glm::vec3 to_light = core.draw(to_viewer, u);
    if (!(to_light.z > 0))
        return std::nullopt;
    return weighed_sample(to_light, core.weigh(to_light, to_viewer));
}

/// Samples a view for a light with z > 0.
template <class Core>
std::optional<SampledDirection> sample_view(const Core &core, const glm::vec3 &to_light,
                                            const glm::vec3 &u) {
    if constexpr (Core::kReciprocal) {
        return sample_light(core, to_light, u);
    } else {
        const glm::vec3 to_viewer = core.draw_view(to_light, u);
        if (!(to_viewer.z > 0))
            return std::nullopt;
        return weighed_sample(to_viewer, core.weigh_view(to_light, to_viewer));
    }
}

} // namespace detail

/// The contract of brdf.h from what a core says. Whatever else the core offers stays callable.
/// A model is an alias, `using GgxBrdf = Model<GgxCore>`, whose header declares `extern template
/// class Model<GgxCore>` and whose source instantiates it: there the core's functions are inlined.
template <class Core> class Model : public Core {
  public:
    using Core::Core;

    float evaluate(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
        return evaluate_cos(to_light, to_viewer) / std::max(to_light.z, kLeastCosine);
    }
    float evaluate_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
        if (!is_above(to_light, to_viewer))
            return 0;
        if constexpr (HasValueAlone<Core>)
            return Core::f_cos(to_light, to_viewer);
        else
            return Core::weigh(to_light, to_viewer).f_cos;
    }
    /// The same for many pairs at once, several times as fast where the processor has wide vectors:
    /// equal to the calls one by one but for rounding. The spans are of one length.
    void evaluate_cos(std::span<const glm::vec3> to_light, std::span<const glm::vec3> to_viewer,
                      std::span<float> f_cos) const requires HasBatches<Core> {
        if constexpr (HasBatches<Core>) // clang 14 makes all members of an explicit instantiation
            Core::f_cos(to_light, to_viewer, f_cos);
    }
    [[gnu::flatten]] std::optional<SampledDirection> sample(const glm::vec3 &to_viewer,
                                                            const glm::vec3 &u) const {
        if (!(to_viewer.z > 0))
            return std::nullopt;
        return detail::sample_light<Core>(*this, to_viewer, u);
    }
    [[gnu::flatten]] std::optional<SampledDirection> sample_adjoint(const glm::vec3 &to_light,
                                                                    const glm::vec3 &u) const {
        if (!(to_light.z > 0))
            return std::nullopt;
        return detail::sample_view<Core>(*this, to_light, u);
    }
    float pdf(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
        return weigh(to_light, to_viewer).pdf_per_sr;
    }
    float pdf_adjoint(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
        if constexpr (Core::kReciprocal)
            return pdf(to_viewer, to_light);
        else
            return is_above(to_light, to_viewer) ? Core::weigh_view(to_light, to_viewer).pdf_per_sr
                                                 : 0.0f;
    }
    WeighedLight weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
        if (!is_above(to_light, to_viewer))
            return {};
        return Core::weigh(to_light, to_viewer);
    }
    float albedo_of_light(const glm::vec3 &to_light) const {
        return to_light.z > 0 ? Core::albedo(to_light) : 0.0f;
    }
    float albedo_of_view(const glm::vec3 &to_viewer) const {
        if constexpr (Core::kReciprocal)
            return albedo_of_light(to_viewer);
        else
            return to_viewer.z > 0 ? Core::albedo_of_view(to_viewer) : 0.0f;
    }

  private:
    static constexpr float kLeastCosine = 1e-20f; ///< by which `evaluate` divides

    static bool is_above(const glm::vec3 &to_light, const glm::vec3 &to_viewer) {
        static_assert(BrdfCore<Core>);
        return to_light.z > 0 && to_viewer.z > 0;
    }
};

} // namespace tsuya
