#include "tsuya/sdk/takeda_printed.h"

#include <algorithm>
#include <cmath>

#include "models/facets.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr int kTableNodes = 161;     // quadrant; 0.5 degrees at the pole
constexpr int kFullTableNodes = 241; // whole square
constexpr int kAlbedoSamples = 4096;

} // namespace

glm::vec3 printed_basic(const glm::vec3 &to_light, const glm::vec3 &to_viewer) {
    const float horizontal = glm::length(glm::vec2(to_light));
    if (!(horizontal > 0))
        return to_viewer;
    const glm::vec2 away = -glm::vec2(to_light) / horizontal, side(-away.y, away.x);
    const float along = glm::dot(away, glm::vec2(to_viewer));
    const float across = glm::dot(side, glm::vec2(to_viewer));
    const float tilt = std::min(std::atan2(horizontal, to_light.z), kHalfPiF);
    const float beta = std::atan2(std::hypot(across, to_viewer.z), along);
    // [Takeda] Eq. 15, divided by beta
    float ratio = kHalfPiF / std::max(kHalfPiF - tilt, 1e-7f);
    if (beta > kHalfPiF - tilt)
        ratio = (kHalfPiF + kPiF * tilt / beta) / (kHalfPiF + tilt);
    const float theta_r = std::atan2(glm::length(glm::vec2(to_viewer)), to_viewer.z);
    const float phi_r = std::atan2(across, along);
    const float theta = kHalfPiF - ratio * (kHalfPiF - theta_r); // [Takeda] Eq. 16
    const float phi = ratio * phi_r;                             // [Takeda] Eq. 17
    const glm::vec2 level = std::sin(theta) * (std::cos(phi) * away + std::sin(phi) * side);
    return {level, std::max(std::cos(theta), 0.0f)};
}

TakedaPrintedCore::TakedaPrintedCore(const Bard &bard, double f0, const Progress &progress)
    : f0_(checked_f0(f0)) {
    const bool orthotropic = bard.symmetry() == Symmetry::orthotropic;
    scaled_ = scaled_bard(bard, f0_, orthotropic ? kTableNodes : kFullTableNodes, progress);
    views_ = DirectionSampler([&](const glm::vec3 &to_light, const glm::vec3 &to_viewer) {
        stop_if_asked(progress);
        return terms(to_light, to_viewer).cos(to_viewer.z, to_light.z);
    });
    lights_ = DirectionSampler([&](const glm::vec3 &to_viewer, const glm::vec3 &to_light) {
        stop_if_asked(progress);
        return f_cos(to_light, to_viewer);
    });
    light_albedo_ = AlbedoTable(bard.symmetry(), [&](const glm::vec3 &to_light) {
        return mean_weight_of_views(*this, to_light, progress, kAlbedoSamples);
    });
    view_albedo_ = AlbedoTable(bard.symmetry(), [&](const glm::vec3 &to_viewer) {
        return mean_weight_of_lights(*this, to_viewer, progress, kAlbedoSamples);
    });
}

// The regular form of [Takeda] Eq. 14 holds for any V0.
FacetTerms TakedaPrintedCore::terms(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const glm::vec3 basic = printed_basic(to_light, to_viewer);
    return FacetTerms::scaled(scaled_.at(basic), f0_, to_light, to_viewer);
}

float TakedaPrintedCore::f_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return terms(to_light, to_viewer).cos(to_light.z, to_viewer.z);
}

WeighedLight TakedaPrintedCore::weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const float density = lights_.pdf(to_viewer, to_light);
    return {f_cos(to_light, to_viewer), density};
}

WeighedLight TakedaPrintedCore::weigh_view(const glm::vec3 &to_light,
                                           const glm::vec3 &to_viewer) const {
    const float density = views_.pdf(to_light, to_viewer);
    return {terms(to_light, to_viewer).cos(to_viewer.z, to_light.z), density};
}

glm::vec3 TakedaPrintedCore::draw(const glm::vec3 &to_viewer, const glm::vec3 &u) const {
    return lights_.sample(to_viewer, u);
}

glm::vec3 TakedaPrintedCore::draw_view(const glm::vec3 &to_light, const glm::vec3 &u) const {
    return views_.sample(to_light, u);
}

float TakedaPrintedCore::albedo(const glm::vec3 &to_light) const {
    return light_albedo_.at(to_light);
}

float TakedaPrintedCore::albedo_of_view(const glm::vec3 &to_viewer) const {
    return view_albedo_.at(to_viewer);
}

TakedaPrintedCore::TakedaPrintedCore(detail::TableReader &from) { each_part(from, *this); }

template class Model<TakedaPrintedCore>;

} // namespace tsuya
