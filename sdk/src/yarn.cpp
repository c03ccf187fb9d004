#include "tsuya/sdk/yarn.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

#include "disk.h"
#include "facets.h"

namespace tsuya {
namespace {

constexpr float kPi = 3.14159265f;
constexpr int kQuarterNodes = 113; // along a half axis: 0.2 degrees of tilt at the pole
constexpr float kFocus = 0.6f;     // of the nodes, which are denser where the lobes are narrow
constexpr int kDensityCells = 96;
constexpr int kAlbedoSamples = 8192;
constexpr int kAlbedoColumns = 16; // of a quarter: at grazing the albedo changes fast with azimuth
constexpr float kSmallest = 1e-20f;
// Of the density, spread evenly over half vectors, and of the draws, over the hemisphere
constexpr float kEvenShare = 0.02f, kLeastEvenDraws = 0.05f;

// A component of the half vector to a place along an axis of the table, 0 to 1, and back.
float place_of(float component) { return component * (1 + kFocus) / (component + kFocus); }
float component_of(float place) { return place * kFocus / (1 + kFocus - place); }

// The even part of weft and warp in 1/sr: each has as much as it has of the filaments.
glm::vec2 even_of_systems(const YarnLobes &lobes) {
    const auto filaments = [&](std::size_t axis) {
        return std::accumulate(lobes.surface[axis].begin(), lobes.surface[axis].end(), 0.0);
    };
    const double weft = filaments(0), both = weft + filaments(1);
    const auto share = static_cast<float>(both > 0 ? weft / both : 0.5);
    return static_cast<float>(lobes.even) / kPi * glm::vec2(share, 1 - share);
}

} // namespace

YarnBrdf::YarnBrdf(const YarnLobes &lobes, Symmetry symmetry)
    : lobes_(lobes), optics_(checked_f0(lobes.f0)), pit_{static_cast<float>(lobes.pit[0]),
                                                         static_cast<float>(lobes.pit[1])},
      even_per_sr_(even_of_systems(lobes)), mirrored_(symmetry != Symmetry::none) {
    tabulate_facets();
    tabulate_density();
    // Cylinders are mirrored across their axis, and slopes along it where the cloth is
    tabulate_albedos(mirrored_ ? Symmetry::orthotropic : Symmetry::none);
}

YarnBrdf::YarnBrdf(const Bard &bard, double f0)
    : YarnBrdf(fit_yarn_lobes(bard, f0), bard.symmetry()) {}

void YarnBrdf::tabulate_facets() {
    nodes_ = mirrored_ ? kQuarterNodes : 2 * kQuarterNodes - 1;
    facets_.resize(static_cast<std::size_t>(nodes_ * nodes_));
    const auto component = [&](int i) {
        const int k = mirrored_ ? i : std::abs(i - kQuarterNodes + 1);
        const float c = component_of(static_cast<float>(k) / (kQuarterNodes - 1));
        return !mirrored_ && i < kQuarterNodes - 1 ? -c : c;
    };
    tbb::parallel_for(0, nodes_, [&](int j) {
        for (int i = 0; i < nodes_; ++i) {
            glm::dvec2 p(component(i), component(j));
            // Nodes beyond the horizon take the value of the horizon below them
            if (const double r = glm::length(p); r > 1)
                p /= r;
            const glm::dvec3 half(p, std::sqrt(std::max(0.0, 1 - glm::dot(p, p))));
            glm::dvec2 sum(0, 0);
            for (int axis = 0; axis < 2; ++axis)
                for (int k = 0; k < kYarnSlopes; ++k)
                    if (const double s = lobes_.surface[static_cast<std::size_t>(axis)]
                                                       [static_cast<std::size_t>(k)];
                        s > 0)
                        sum[axis] += s * yarn_lobe(axis, yarn_slope(k), lobes_.roughness, half);
            facets_[static_cast<std::size_t>(j * nodes_ + i)] = sum;
        }
    });
}

glm::vec2 YarnBrdf::facets(const glm::vec3 &half) const {
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

// The disk of the horizontal part of H has the area element N.H dH: even cells draw D N.H.
void YarnBrdf::tabulate_density() {
    std::vector<double> mass;
    double total = 0;
    for (int j = 0; j < kDensityCells; ++j)
        for (int i = 0; i < kDensityCells; ++i) {
            const glm::vec2 u = (glm::vec2(i, j) + 0.5f) / static_cast<float>(kDensityCells);
            const glm::vec2 d = facets({disk_of_square(u), 0});
            mass.push_back(d.x + d.y);
            total += mass.back();
        }
    for (double &m : mass)
        m += kEvenShare * total / static_cast<double>(mass.size());
    density_ = Distribution2D(mass, kDensityCells, kDensityCells);
    // Draws follow the albedo of the parts, seen from above
    const double facets = total * kPi / static_cast<double>(mass.size()) * lobes_.f0;
    const double even = lobes_.even;
    even_draws_ =
        std::max(static_cast<float>(even / std::max(even + facets, 1e-30)), kLeastEvenDraws);
}

void YarnBrdf::tabulate_albedos(Symmetry symmetry) {
    const auto albedo = [&](const glm::vec3 &to_viewer) {
        return mean_weight([&](const glm::vec3 &u) { return sample(to_viewer, u); },
                           kAlbedoSamples);
    };
    // limited_below_ is 0 still: this is the albedo before the limit
    unlimited_ = AlbedoTable(symmetry, albedo, kAlbedoColumns);
    unlimited_albedo_ = unlimited_.maximum();
    limited_below_ = unlimited_.cosine_above(1);
    albedo_ = limited_below_ > 0 ? AlbedoTable(symmetry, albedo, kAlbedoColumns) : unlimited_;
}

float YarnBrdf::limit(const glm::vec3 &direction) const {
    return direction.z < limited_below_ ? 1 / std::max(1.0f, unlimited_.at(direction)) : 1.0f;
}

// rho of weft and warp times the light's cosine.
glm::vec2 YarnBrdf::times_light_cosine(const YarnHalf &half, const glm::vec3 &l,
                                       const glm::vec3 &v) const {
    const glm::vec2 d = facets(half.half);
    const float open = 1 / v.z, ratio = l.z * open;
    const glm::vec2 reach(optics_.reach<0>(pit_[0], half, l, v).times_cosine(open, ratio),
                          optics_.reach<1>(pit_[1], half, l, v).times_cosine(open, ratio));
    // The smaller of the two limits bounds the albedo of both directions and stays reciprocal
    return (even_per_sr_ * l.z + d * reach) * std::min(limit(l), limit(v));
}

// Of either direction for the other.
float YarnBrdf::density(const YarnHalf &half, float drawn_cosine) const {
    const float of_half =
        density_.density(square_of_disk(glm::vec2(half.half))) / kPi * std::max(half.half.z, 0.0f);
    return (1 - even_draws_) * of_half / (4 * half.cosine) + even_draws_ * drawn_cosine / kPi;
}

float YarnBrdf::evaluate(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return evaluate_cos(to_light, to_viewer) / std::max(to_light.z, kSmallest);
}

float YarnBrdf::evaluate_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    if (!(to_light.z > 0 && to_viewer.z > 0))
        return 0;
    const glm::vec2 systems =
        times_light_cosine(optics_.half(to_light, to_viewer), to_light, to_viewer);
    return systems.x + systems.y;
}

WeighedLight YarnBrdf::weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    if (!(to_light.z > 0 && to_viewer.z > 0))
        return {};
    const YarnHalf half = optics_.half(to_light, to_viewer);
    const glm::vec2 systems = times_light_cosine(half, to_light, to_viewer);
    return {systems.x + systems.y, density(half, to_light.z), systems.x};
}

float YarnBrdf::pdf(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    if (!(to_light.z > 0 && to_viewer.z > 0))
        return 0;
    return density(optics_.half(to_light, to_viewer), to_light.z);
}

float YarnBrdf::pdf_adjoint(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return pdf(to_viewer, to_light);
}

// Draws H, and mirrors the view in it, or a light from the even part. A light below the horizon, or
// a facet that looks away, is a null sample.
std::optional<SampledDirection> YarnBrdf::sample(const glm::vec3 &to_viewer,
                                                 const glm::vec3 &u) const {
    if (!(to_viewer.z > 0))
        return std::nullopt;
    glm::vec3 to_light;
    if (u.z < even_draws_) {
        const glm::vec2 p = disk_of_square({u.x, u.y});
        to_light = {p, std::sqrt(std::max(1 - glm::dot(p, p), 0.0f))};
    } else {
        const glm::vec2 p = disk_of_square(density_.sample({u.x, u.y}).point);
        const glm::vec3 half(p, std::sqrt(std::max(1 - glm::dot(p, p), 0.0f)));
        const float v_h = glm::dot(to_viewer, half);
        to_light = v_h > 0 ? 2 * v_h * half - to_viewer : glm::vec3(0);
    }
    if (!(to_light.z > 0))
        return std::nullopt;
    const WeighedLight light = weigh(to_light, to_viewer);
    if (!(light.pdf_per_sr > 0))
        return std::nullopt;
    return SampledDirection{to_light, light.f_cos / light.pdf_per_sr, light.pdf_per_sr,
                            light.weft / light.pdf_per_sr};
}

std::optional<SampledDirection> YarnBrdf::sample_adjoint(const glm::vec3 &to_light,
                                                         const glm::vec3 &u) const {
    return sample(to_light, u);
}

float YarnBrdf::albedo_of_light(const glm::vec3 &to_light) const {
    return to_light.z > 0 ? std::min(1.0f, albedo_.at(to_light)) : 0.0f;
}

float YarnBrdf::albedo_of_view(const glm::vec3 &to_viewer) const {
    return albedo_of_light(to_viewer);
}

} // namespace tsuya
