#include "tsuya/sdk/yarn.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <tbb/parallel_for.h>

#include "models/facets.h"
#include "tables/disk.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr int kQuarterNodes = 113; // along a half axis: 0.2 degrees of tilt at the pole
constexpr float kFocus = 0.6f;     // of the nodes, which are denser where the lobes are narrow
constexpr int kAlbedoSamples = 512;
constexpr int kAlbedoColumns = 16; // of a quarter: at grazing the albedo changes fast with azimuth

// A component of the half vector to a place along an axis of the table, 0 to 1, and back.
float place_of(float component) { return component * (1 + kFocus) / (component + kFocus); }
float component_of(float place) { return place * kFocus / (1 + kFocus - place); }

// The diffuse part of weft and warp in 1/sr: each has as much as it has of the filaments.
glm::vec2 even_of_systems(const YarnLobes &lobes) {
    const auto filaments = [&](std::size_t axis) {
        return std::accumulate(lobes.surface[axis].begin(), lobes.surface[axis].end(), 0.0);
    };
    const double weft = filaments(0), both = weft + filaments(1);
    const auto share = static_cast<float>(both > 0 ? weft / both : 0.5);
    return static_cast<float>(lobes.even) / kPiF * glm::vec2(share, 1 - share);
}

// The lobes of one system: yarn_lobe with what does not depend on the half vector made once.
struct Cylinders {
    double cosine, sine, surface; // of the slope
};
std::vector<Cylinders> cylinders(const YarnLobes &lobes, std::size_t axis) {
    std::vector<Cylinders> made;
    for (int k = 0; k < kYarnSlopes; ++k)
        if (const double s = lobes.surface[axis][static_cast<std::size_t>(k)]; s > 0)
            made.push_back({std::cos(yarn_slope(k)), std::sin(yarn_slope(k)), s});
    return made;
}
double facets_of(const std::vector<Cylinders> &system, double roughness, double along, double up) {
    constexpr double kFarthest = 8; // in standard deviations: beyond, a lobe has 1e-14 of its peak
    const double farthest = std::sin(std::min(kFarthest * roughness, 0.5 * std::numbers::pi));
    double sum = 0;
    for (const Cylinders &c : system) {
        const double sine = along * c.cosine + up * c.sine;
        if (std::abs(sine) <= farthest)
            sum += c.surface * yarn_lobe(sine, roughness);
    }
    return sum;
}

} // namespace

YarnCore::YarnCore(const YarnLobes &lobes, Symmetry symmetry, const Progress &progress)
    : lobes_(lobes), optics_(checked_f0(lobes.f0)), pit_{static_cast<float>(lobes.pit[0]),
                                                         static_cast<float>(lobes.pit[1])},
      even_per_sr_(even_of_systems(lobes)), mirrored_(symmetry != Symmetry::none) {
    tabulate_facets(progress);
    tabulate_draws(progress);
    // Cylinders are mirrored across their axis, and slopes along it where the cloth is
    tabulate_albedos(mirrored_ ? Symmetry::orthotropic : Symmetry::none, progress);
}

YarnCore::YarnCore(const Bard &bard, double f0, const Progress &progress)
    : YarnCore(fit_yarn_lobes(bard, f0, progress), bard.symmetry(), progress) {}

void YarnCore::tabulate_facets(const Progress &progress) {
    nodes_ = mirrored_ ? kQuarterNodes : 2 * kQuarterNodes - 1;
    facets_.resize(static_cast<std::size_t>(nodes_ * nodes_));
    const auto component = [&](int i) {
        const int k = mirrored_ ? i : std::abs(i - kQuarterNodes + 1);
        const float c = component_of(static_cast<float>(k) / (kQuarterNodes - 1));
        return !mirrored_ && i < kQuarterNodes - 1 ? -c : c;
    };
    const std::array<std::vector<Cylinders>, 2> systems = {cylinders(lobes_, 0),
                                                           cylinders(lobes_, 1)};
    tbb::parallel_for(0, nodes_, [&](int j) {
        stop_if_asked(progress);
        for (int i = 0; i < nodes_; ++i) {
            glm::dvec2 p(component(i), component(j));
            // Nodes beyond the horizon take the value of the horizon below them
            if (const double r = glm::length(p); r > 1)
                p /= r;
            const glm::dvec3 half(p, std::sqrt(std::max(0.0, 1 - glm::dot(p, p))));
            facets_[static_cast<std::size_t>(j * nodes_ + i)] =
                glm::vec2(facets_of(systems[0], lobes_.roughness, half.x, half.z),
                          facets_of(systems[1], lobes_.roughness, half.y, half.z));
        }
    });
}

glm::vec2 YarnCore::facets(const glm::vec3 &half) const {
    const auto place = [&](float component) {
        const float p = place_of(std::min(std::abs(component), 1.0f)) * (kQuarterNodes - 1);
        return mirrored_ ? p : kQuarterNodes - 1 + (component < 0 ? -p : p);
    };
    const float x = place(half.x), y = place(half.y);
    const int i = std::min(static_cast<int>(x), nodes_ - 2);
    const int j = std::min(static_cast<int>(y), nodes_ - 2);
    const float s = x - static_cast<float>(i), t = y - static_cast<float>(j);
    const glm::vec2 *const row = &facets_[static_cast<std::size_t>(j * nodes_ + i)];
    const glm::vec2 *const next = row + nodes_;
    return (1 - t) * ((1 - s) * row[0] + s * row[1]) + t * ((1 - s) * next[0] + s * next[1]);
}

void YarnCore::tabulate_draws(const Progress &progress) {
    draws_ = HalfVectorSampler(
        mirrored_,
        [&](const glm::vec3 &half) {
            const glm::vec2 d = facets(half);
            return d.x + d.y;
        },
        [&](const glm::vec3 &fixed, const glm::vec3 &drawn) {
            stop_if_asked(progress);
            return std::max(f_cos(drawn, fixed) - (even_per_sr_.x + even_per_sr_.y) * drawn.z,
                            0.0f);
        },
        static_cast<float>(lobes_.even));
}

void YarnCore::tabulate_albedos(Symmetry symmetry, const Progress &progress) {
    albedo_.tabulate(
        symmetry,
        [&](const glm::vec3 &to_viewer) {
            return mean_weight_of_lights(*this, to_viewer, progress, kAlbedoSamples);
        },
        kAlbedoColumns);
}

// rho of weft and warp times the light's cosine.
glm::vec2 YarnCore::times_light_cosine(const YarnHalf &half, const glm::vec3 &l,
                                       const glm::vec3 &v) const {
    const glm::vec2 d = facets(half.half);
    const float open = 1 / v.z, ratio = l.z * open;
    const glm::vec2 reach(optics_.reach<0>(pit_[0], half, l, v).times_cosine(open, ratio),
                          optics_.reach<1>(pit_[1], half, l, v).times_cosine(open, ratio));
    // The smaller of the two limits bounds the albedo of both directions and stays reciprocal
    return (even_per_sr_ * l.z + d * reach) * std::min(albedo_.limit(l), albedo_.limit(v));
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

template class Model<YarnCore>;

} // namespace tsuya
