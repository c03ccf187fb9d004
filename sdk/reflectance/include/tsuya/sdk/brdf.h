#pragma once
/// \file
/// The contract of every reflectance model, and the closed set of models.
///
/// Directions are unit, in the cloth's frame (x = weft, y = warp, z = normal), and point away from
/// the surface. Values are in 1/sr without the cosine. A model reflects on the side z > 0 only: any
/// direction with z <= 0 gives 0. Models are values: no state, no allocation, no virtual call.
///
/// A model is written as a core of three operations, see detail/brdf_core.h, which derives the rest
/// of the contract. To add one: a header and a source with the core, its entry in Brdf::Models, a
/// row in the contract test.

#include <concepts>
#include <optional>
#include <utility>
#include <variant>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/sampled_direction.h"
#include "tsuya/sdk/ggx.h"
#include "tsuya/sdk/half_vector.h"
#include "tsuya/sdk/lambert.h"
#include "tsuya/sdk/tabulated.h"
#include "tsuya/sdk/takeda.h"
#include "tsuya/sdk/takeda_printed.h"
#include "tsuya/sdk/yarn.h"

namespace tsuya {

// clang-format off
/// What a model has. All take unit directions; `u` has three random numbers in [0, 1).
template <class T>
concept BrdfModel = requires(const T &m, glm::vec3 to_light, glm::vec3 to_viewer, glm::vec3 u) {
    /// f in 1/sr
    { m.evaluate(to_light, to_viewer) } -> std::same_as<float>;
    /// f times the light's cosine, in a form that stays bounded where the cosine vanishes
    { m.evaluate_cos(to_light, to_viewer) } -> std::same_as<float>;
    /// Samples a light for a view; weight = f cos_light / pdf. Empty: a null sample, which counts.
    { m.sample(to_viewer, u) } -> std::same_as<std::optional<SampledDirection>>;
    /// Samples a view for a light; weight = f cos_viewer / pdf.
    { m.sample_adjoint(to_light, u) } -> std::same_as<std::optional<SampledDirection>>;
    /// Density of `sample`, 1/sr of to_light
    { m.pdf(to_light, to_viewer) } -> std::same_as<float>;
    /// `evaluate_cos` and `pdf` at once, which share most of their work
    { m.weigh(to_light, to_viewer) } -> std::same_as<WeighedLight>;
    /// Density of `sample_adjoint`, 1/sr of to_viewer
    { m.pdf_adjoint(to_light, to_viewer) } -> std::same_as<float>;
    /// Share of the light from one direction that is reflected: energy
    { m.albedo_of_light(to_light) } -> std::same_as<float>;
    /// Radiance seen from one direction under a uniform environment of radiance 1
    { m.albedo_of_view(to_viewer) } -> std::same_as<float>;
    /// What the model claims; the contract test holds it to it
    { T::kReciprocal } -> std::convertible_to<bool>;
    { T::kEnergyLimited } -> std::convertible_to<bool>;
};
// clang-format on

/// Any of the models, with the functions of the contract.
class Brdf {
  public:
    /// The closed set.
    using Models = std::variant<LambertBrdf, TakedaBrdf, TakedaPrintedBrdf, HalfVectorBrdf, GgxBrdf,
                                TabulatedBrdf, YarnBrdf>;

    /// Any model is a Brdf.
    template <BrdfModel M>
    requires std::constructible_from<Models, M> Brdf(M model) : models_(std::move(model)) {}

    /// Calls `function` with the model as its own type: once for what then runs many times.
    template <class Function> decltype(auto) visit(Function &&function) const {
        return std::visit(std::forward<Function>(function), models_);
    }
    /// Of the model in Models.
    std::size_t index() const { return models_.index(); }
    /// The model where it is of that type; null elsewhere.
    template <class M> const M *get_if() const { return std::get_if<M>(&models_); }

    /// f, 1/sr.
    float evaluate(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
        return visit([&](const auto &m) { return m.evaluate(to_light, to_viewer); });
    }
    /// f times the light's cosine, 1/sr; stays bounded where the cosine vanishes.
    float evaluate_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
        return visit([&](const auto &m) { return m.evaluate_cos(to_light, to_viewer); });
    }
    /// Samples a light for a view; weight = f cos_light / pdf. Empty: a null sample, which counts.
    std::optional<SampledDirection> sample(const glm::vec3 &to_viewer, const glm::vec3 &u) const {
        return visit([&](const auto &m) { return m.sample(to_viewer, u); });
    }
    /// Samples a view for a light; weight = f cos_viewer / pdf.
    std::optional<SampledDirection> sample_adjoint(const glm::vec3 &to_light,
                                                   const glm::vec3 &u) const {
        return visit([&](const auto &m) { return m.sample_adjoint(to_light, u); });
    }
    /// Density of `sample`, 1/sr of to_light.
    float pdf(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
        return visit([&](const auto &m) { return m.pdf(to_light, to_viewer); });
    }
    /// `evaluate_cos` and `pdf` at once, which share most of their work.
    WeighedLight weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
        return visit([&](const auto &m) { return m.weigh(to_light, to_viewer); });
    }
    /// Density of `sample_adjoint`, 1/sr of to_viewer.
    float pdf_adjoint(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
        return visit([&](const auto &m) { return m.pdf_adjoint(to_light, to_viewer); });
    }
    /// Share of the light from one direction that is reflected.
    float albedo_of_light(const glm::vec3 &to_light) const {
        return visit([&](const auto &m) { return m.albedo_of_light(to_light); });
    }
    /// Radiance seen from one direction under a uniform environment of radiance 1.
    float albedo_of_view(const glm::vec3 &to_viewer) const {
        return visit([&](const auto &m) { return m.albedo_of_view(to_viewer); });
    }

  private:
    Models models_;
};

static_assert(BrdfModel<LambertBrdf>);
static_assert(BrdfModel<TakedaBrdf>);
static_assert(BrdfModel<TakedaPrintedBrdf>);
static_assert(BrdfModel<HalfVectorBrdf>);
static_assert(BrdfModel<GgxBrdf>);
static_assert(BrdfModel<TabulatedBrdf>);
static_assert(BrdfModel<YarnBrdf>);

} // namespace tsuya
