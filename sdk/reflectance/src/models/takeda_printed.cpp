#include "tsuya/sdk/takeda_printed.h"

#include <algorithm>
#include <cmath>

#include "models/facets.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr float kHalfPi = 0.5f * kPiF; // `a` of [Takeda] Eq. 15
constexpr int kTableNodes = 161;       // quadrant; 0.5 degrees at the pole
constexpr int kFullTableNodes = 241;   // whole square
constexpr int kAlbedoSamples = 4096;

} // namespace

glm::vec3 printed_basic(const glm::vec3 &to_light, const glm::vec3 &to_viewer) {
    const float horizontal = glm::length(glm::vec2(to_light));
    if (!(horizontal > 0))
        return to_viewer;
    const glm::vec2 away = -glm::vec2(to_light) / horizontal, side(-away.y, away.x);
    const float along = glm::dot(away, glm::vec2(to_viewer));
    const float across = glm::dot(side, glm::vec2(to_viewer));
    const float tilt = std::min(std::atan2(horizontal, to_light.z), kHalfPi);
    const float beta = std::atan2(std::hypot(across, to_viewer.z), along);
    // [Takeda] Eq. 15, divided by beta
    float ratio = kHalfPi / std::max(kHalfPi - tilt, 1e-7f);
    if (beta > kHalfPi - tilt)
        ratio = (kHalfPi + kPiF * tilt / beta) / (kHalfPi + tilt);
    const float theta_r = std::atan2(glm::length(glm::vec2(to_viewer)), to_viewer.z);
    const float phi_r = std::atan2(across, along);
    const float theta = kHalfPi - ratio * (kHalfPi - theta_r); // [Takeda] Eq. 16
    const float phi = ratio * phi_r;                           // [Takeda] Eq. 17
    const glm::vec2 level = std::sin(theta) * (std::cos(phi) * away + std::sin(phi) * side);
    return {level, std::max(std::cos(theta), 0.0f)};
}

struct TakedaPrintedBrdf::Terms : FacetTerms {};

TakedaPrintedBrdf::TakedaPrintedBrdf(const Bard &bard, double f0) : f0_(checked_f0(f0)) {
    const bool orthotropic = bard.symmetry() == Symmetry::orthotropic;
    scaled_ = scaled_bard(bard, f0_, orthotropic ? kTableNodes : kFullTableNodes);
    views_ = DirectionSampler([&](const glm::vec3 &to_light, const glm::vec3 &to_viewer) {
        return terms(to_light, to_viewer).cos(to_viewer.z, to_light.z);
    });
    lights_ = DirectionSampler([&](const glm::vec3 &to_viewer, const glm::vec3 &to_light) {
        return terms(to_light, to_viewer).cos(to_light.z, to_viewer.z);
    });
    light_albedo_ = AlbedoTable(bard.symmetry(), [&](const glm::vec3 &to_light) {
        return mean_weight([&](const glm::vec3 &u) { return sample_adjoint(to_light, u); },
                           kAlbedoSamples);
    });
    view_albedo_ = AlbedoTable(bard.symmetry(), [&](const glm::vec3 &to_viewer) {
        return mean_weight([&](const glm::vec3 &u) { return sample(to_viewer, u); },
                           kAlbedoSamples);
    });
}

// The regular form of [Takeda] Eq. 14 holds for any V0.
TakedaPrintedBrdf::Terms TakedaPrintedBrdf::terms(const glm::vec3 &to_light,
                                                  const glm::vec3 &to_viewer) const {
    const glm::vec3 basic = printed_basic(to_light, to_viewer);
    return {FacetTerms::scaled(scaled_.at(basic), f0_, to_light, to_viewer)};
}

float TakedaPrintedBrdf::evaluate(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const float ci = to_light.z, cr = to_viewer.z;
    return ci > 0 && cr > 0 ? terms(to_light, to_viewer).per_sr(ci, cr) : 0.0f;
}

float TakedaPrintedBrdf::evaluate_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const float ci = to_light.z, cr = to_viewer.z;
    return ci > 0 && cr > 0 ? terms(to_light, to_viewer).cos(ci, cr) : 0.0f;
}

float TakedaPrintedBrdf::pdf(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return to_light.z > 0 && to_viewer.z > 0 ? lights_.pdf(to_viewer, to_light) : 0.0f;
}

float TakedaPrintedBrdf::pdf_adjoint(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return to_light.z > 0 && to_viewer.z > 0 ? views_.pdf(to_light, to_viewer) : 0.0f;
}

WeighedLight TakedaPrintedBrdf::weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return {evaluate_cos(to_light, to_viewer), pdf(to_light, to_viewer)};
}

std::optional<SampledDirection> TakedaPrintedBrdf::sample(const glm::vec3 &to_viewer,
                                                          const glm::vec3 &u) const {
    if (!(to_viewer.z > 0))
        return std::nullopt;
    const auto to_light = lights_.sample(to_viewer, u);
    if (!to_light)
        return std::nullopt;
    const float density = lights_.pdf(to_viewer, *to_light);
    return SampledDirection{*to_light, evaluate_cos(*to_light, to_viewer) / density, density};
}

std::optional<SampledDirection> TakedaPrintedBrdf::sample_adjoint(const glm::vec3 &to_light,
                                                                  const glm::vec3 &u) const {
    if (!(to_light.z > 0))
        return std::nullopt;
    const auto to_viewer = views_.sample(to_light, u);
    if (!to_viewer)
        return std::nullopt;
    const float density = views_.pdf(to_light, *to_viewer);
    const Terms t = terms(to_light, *to_viewer);
    return SampledDirection{*to_viewer, t.cos(to_viewer->z, to_light.z) / density, density};
}

float TakedaPrintedBrdf::albedo_of_light(const glm::vec3 &to_light) const {
    return to_light.z > 0 ? light_albedo_.at(to_light) : 0.0f;
}

float TakedaPrintedBrdf::albedo_of_view(const glm::vec3 &to_viewer) const {
    return to_viewer.z > 0 ? view_albedo_.at(to_viewer) : 0.0f;
}

} // namespace tsuya
