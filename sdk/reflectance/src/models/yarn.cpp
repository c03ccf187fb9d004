#include "tsuya/sdk/yarn.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "models/every_processor.h"
#include "models/facets.h"
#include "tables/disk.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr double kLooseAlbedo = 0.6; // over f0, for a surface of 1: that of GGX with alpha = 1
constexpr int kAlbedoSamples = 352;
constexpr int kAlbedoColumns = 24; // of a quarter: at grazing the albedo changes fast with azimuth

// What is of no system is shared by weft and warp: each has as much as it has of the filaments.
glm::vec2 shares_of_systems(const YarnLobes &lobes) {
    const auto share = static_cast<float>(lobes.weft_share());
    return {share, 1 - share};
}

} // namespace

YarnCore::YarnCore(const YarnLobes &lobes, Symmetry symmetry, const Progress &progress)
    : lobes_(lobes), optics_(checked_f0(lobes.f0), lobes.roughness),
      even_per_sr_(static_cast<float>(lobes.even) / kPiF * shares_of_systems(lobes)),
      loose_per_sr_(static_cast<float>(lobes.loose) / (2 * kPiF) * shares_of_systems(lobes)),
      mirrored_(symmetry != Symmetry::none), depth_(lobes), facets_(lobes, mirrored_, progress) {
    tabulate_draws(progress);
    // Cylinders are mirrored across their axis, and slopes along it where the cloth is
    tabulate_albedos(mirrored_ ? Symmetry::orthotropic : Symmetry::none, progress);
}

YarnCore::YarnCore(const Bard &bard, double f0, const Progress &progress)
    : YarnCore(fit_yarn_lobes(bard, f0, progress), bard.symmetry(), progress) {}

void YarnCore::tabulate_draws(const Progress &progress) {
    draws_ = HalfVectorSampler(
        mirrored_,
        [&](const glm::vec3 &half) {
            const glm::vec2 d = facets_.at(half);
            return d.x + d.y;
        },
        [&](const glm::vec3 &fixed, const glm::vec3 &drawn) {
            stop_if_asked(progress);
            const glm::vec2 diffuse =
                even_per_sr_ + loose(optics_.half(drawn, fixed), drawn, fixed);
            return std::max(f_cos(drawn, fixed) - (diffuse.x + diffuse.y) * drawn.z, 0.0f);
        },
        static_cast<float>(lobes_.even + kLooseAlbedo * lobes_.f0 * lobes_.loose));
}

void YarnCore::tabulate_albedos(Symmetry symmetry, const Progress &progress) {
    albedo_.tabulate(
        symmetry,
        [&](const glm::vec3 &to_viewer) {
            return mean_weight_of_lights(*this, to_viewer, progress, kAlbedoSamples);
        },
        kAlbedoColumns);
}

// Loose filaments are facets of GGX with alpha = 1, D = 1 / pi, whose masking by [Heitz] Eq. 99
// makes of G / (4 cos_i cos_r) 1 / (2 (cos_i + cos_r)).
glm::vec2 YarnCore::loose(const YarnHalf &half, const glm::vec3 &l, const glm::vec3 &v) const {
    return loose_per_sr_ * (half.fresnel / (l.z + v.z));
}

// rho of weft and warp times the light's cosine. Never inlined: the value of a sample is of the
// same rounding.
[[gnu::noinline]] TSUYA_FOR_EVERY_PROCESSOR glm::vec2
YarnCore::times_light_cosine(const YarnHalf &half, const glm::vec3 &l, const glm::vec3 &v) const {
    const glm::vec2 d = facets_.at(half.half) * depth_.in_sight(half.half, YarnSpan(l, v));
    // The smaller of the two limits bounds the albedo of both directions and stays reciprocal
    return ((even_per_sr_ + loose(half, l, v)) * l.z + d * optics_.reach(half, l, v)) *
           std::min(albedo_.limit(l), albedo_.limit(v));
}

float YarnCore::f_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const glm::vec2 systems =
        times_light_cosine(optics_.half(to_light, to_viewer), to_light, to_viewer);
    return systems.x + systems.y;
}

WeighedLight YarnCore::weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const YarnHalf half = optics_.half(to_light, to_viewer);
    const glm::vec2 systems = times_light_cosine(half, to_light, to_viewer);
    return {systems.x + systems.y, draws_.pdf(to_viewer, half.half, half.cosine, to_light.z),
            systems.x};
}

// Samples H, and mirrors the view in it, or a light from the diffuse part. A facet that looks away
// is a null sample.
glm::vec3 YarnCore::draw(const glm::vec3 &fixed, const glm::vec3 &u) const {
    return draws_.sample(fixed, u);
}

float YarnCore::albedo(const glm::vec3 &direction) const { return albedo_.at(direction); }

YarnCore::YarnCore(detail::TableReader &from) {
    each_part(from, *this);
    optics_ = YarnOptics(checked_f0(lobes_.f0), lobes_.roughness);
}

template class Model<YarnCore>;

} // namespace tsuya
