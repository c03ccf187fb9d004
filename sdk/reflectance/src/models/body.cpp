#include "tsuya/sdk/body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <tbb/parallel_for.h>

#include "models/facets.h"
#include "tables/disk.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

// The coloured light of a rough filament is this much wider than its highlight, and at least so
// wide as the table of facets resolves: found on traced cloth, see sdk/docs/REFLECTANCE_STUDY.md
constexpr double kWidening = 1.5, kLeastRoughness = 0.05;
// Shares of the samples that follow the cosine and the cones of the yarns; the others follow facets
constexpr float kByCosine = 0.1f, kByCones = 0.75f;
constexpr double kConeWidth = 1.3; // in widths of the facets
constexpr int kSamples = 1024;     // of the light for a view, in the tables
constexpr int kColumns = 24;       // of a quarter
constexpr int kRounds = 12;
constexpr float kKept = 0.99f; // of the light: the rest is the tables' error
constexpr float kSmallest = 1e-20f;

// What light does about the yarn, by the cosine of the angle between light and viewer there: it
// goes on through the filament rather than back, and some is thrown back by its far side. A
// polynomial fitted to traced clear filaments, see sdk/docs/REFLECTANCE_STUDY.md.
float about_yarn(float cosine) {
    constexpr std::array<float, 5> kPower = {1.00f, -0.59f, -0.95f, -2.27f, 3.79f};
    float sum = 0;
    for (auto p = kPower.rbegin(); p != kPower.rend(); ++p)
        sum = sum * cosine + *p;
    return std::max(sum, 0.0f);
}

// The half vector of two directions, and what both make of it about the yarns along x and y.
struct BodyHalf {
    glm::vec3 half;
    float facing;     // cosine of either direction with it
    glm::vec2 turned; // cosines of the angle between the two about the axes

    BodyHalf(const glm::vec3 &l, const glm::vec3 &v) {
        const float length = std::sqrt(std::max(2 * (1 + glm::dot(l, v)), kSmallest));
        half = (l + v) * (1 / length);
        facing = std::clamp(0.5f * length, 1e-10f, 1.0f);
        turned = {cosine_about(l.x, v.x, glm::dot(l, v)), cosine_about(l.y, v.y, glm::dot(l, v))};
    }
    // Of the angle between two directions about an axis, from their parts along it
    static float cosine_about(float a, float b, float both) {
        const float lengths = (1 - a * a) * (1 - b * b);
        return std::clamp((both - a * b) / std::sqrt(std::max(lengths, kSmallest)), -1.0f, 1.0f);
    }
};

// Points of the unit cube whose last coordinate, which chooses what to sample, is even. Those of
// another node are others, so that their errors differ.
glm::vec3 table_point(std::size_t node, int i) {
    constexpr double kR2[] = {0.7548776662466927, 0.5698402909980532}; // [Roberts]
    const double n = i + 0.5 + kSamples * static_cast<double>(node);
    const auto fraction = [](double x) { return static_cast<float>(x - std::floor(x)); };
    return {fraction(n * kR2[0]), fraction(n * kR2[1]), static_cast<float>((i + 0.5) / kSamples)};
}

// A sampled light with its share of the integral over the hemisphere, before the scale.
struct Part {
    glm::vec3 to_light{0, 0, 1};
    float weight = 0;
};

} // namespace

double body_roughness(const YarnLobes &lobes) {
    return std::max(kWidening * lobes.roughness, kLeastRoughness);
}

BodyCore::BodyCore(const YarnLobes &lobes,
                   const std::function<float(const glm::vec3 &)> &surface_albedo,
                   const Progress &progress)
    : facets_(lobes, body_roughness(lobes)),
      cones_(lobes, kConeWidth * body_roughness(lobes), about_yarn) {
    close_energy(surface_albedo, progress);
    by_cosine_ = kByCosine;
    by_cones_ = kByCones;
}

BodyCore::BodyCore(const YarnBrdf &surface, const Progress &progress)
    : BodyCore(
          surface.lobes(), [&](const glm::vec3 &d) { return surface.albedo_of_light(d); },
          progress) {}

// f s^2 = K: the scale s of a direction is q (1 - E), with q <- sqrt(q (1 - E) / integral K).
void BodyCore::close_energy(const std::function<float(const glm::vec3 &)> &surface_albedo,
                            const Progress &progress) {
    const Symmetry symmetry = facets_.mirrored() ? Symmetry::orthotropic : Symmetry::none;
    const std::vector<glm::vec3> nodes = AlbedoTable::nodes(symmetry, kColumns);
    std::vector<float> scale(nodes.size(), 1.0f), reflected(nodes.size()), target(nodes.size());
    scale_ = AlbedoTable(symmetry, scale, kColumns);
    std::vector<std::vector<Part>> parts(nodes.size());
    tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t n) {
        stop_if_asked(progress);
        target[n] = kKept * (1 - std::min(surface_albedo(nodes[n]), 1.0f));
        for (int i = 0; i < kSamples; ++i)
            if (const auto s = detail::sample_light(*this, nodes[n], table_point(n, i)))
                parts[n].push_back({s->direction, s->weight / kSamples});
    });
    for (int round = 0; round <= kRounds; ++round) {
        tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t n) {
            float sum = 0;
            for (const Part &part : parts[n])
                sum += part.weight * scale_.at(part.to_light);
            reflected[n] = sum;
        });
        for (std::size_t n = 0; n < nodes.size() && round < kRounds; ++n)
            scale[n] = std::sqrt(scale[n] * target[n] / std::max(reflected[n], kSmallest));
        if (round < kRounds)
            scale_ = AlbedoTable(symmetry, scale, kColumns);
    }
    for (std::size_t n = 0; n < nodes.size(); ++n)
        reflected[n] *= scale[n];
    albedo_ = AlbedoTable(symmetry, reflected, kColumns);
}

WeighedLight BodyCore::weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const BodyHalf half(to_light, to_viewer);
    const glm::vec2 d = facets_.at(half.half);
    const glm::vec2 by_system = d * glm::vec2(about_yarn(half.turned.x), about_yarn(half.turned.y));
    const float scale = scale_.at(to_light) * scale_.at(to_viewer) * to_light.z /
                        std::max(to_light.z + to_viewer.z, kSmallest);
    // dH/dL = 1 / (4 V.H)
    return {(by_system.x + by_system.y) * scale,
            by_cosine_ * to_light.z / kPiF +
                (by_cones_ > 0 ? by_cones_ * cones_.density(to_light, to_viewer, half.turned) : 0) +
                (1 - by_cosine_ - by_cones_) * (d.x + d.y) / (4 * half.facing),
            by_system.x * scale};
}

float BodyCore::f_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return weigh(to_light, to_viewer).f_cos;
}

// Samples a direction by its cosine, by the cones of the yarns, or H, in which the fixed direction
// is mirrored.
glm::vec3 BodyCore::draw(const glm::vec3 &fixed, const glm::vec3 &u) const {
    const auto rest = [&](float from, float share) {
        return std::min((u.z - from) / share, 0x1.fffffep-1f);
    };
    if (u.z < by_cosine_) {
        const glm::vec2 p = disk_of_square({u.x, u.y});
        return {p, std::sqrt(std::max(1 - glm::dot(p, p), 0.0f))};
    }
    const float before = by_cosine_ + by_cones_;
    if (u.z < before)
        return cones_.sample(fixed, {u.x, rest(by_cosine_, by_cones_), u.y});
    const glm::vec3 half = facets_.sample({u.x, u.y, rest(before, 1 - before)});
    const float facing = glm::dot(fixed, half);
    return facing > 0 ? 2 * facing * half - fixed : glm::vec3(0);
}

BodyCore::BodyCore(detail::TableReader &from) { each_part(from, *this); }

template class Model<BodyCore>;

} // namespace tsuya
