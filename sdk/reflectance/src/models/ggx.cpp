#include "tsuya/sdk/ggx.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "models/facets.h"
#include "tables/disk.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr double kLeastAlpha = 1e-4;
constexpr float kSmallest = 1e-30f;

// Unpolarised, for light from the air
float dielectric_fresnel(float index, float cosine) {
    const float g = std::sqrt(index * index - 1 + cosine * cosine);
    const float a = (g - cosine) / (g + cosine);
    const float b = (cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1);
    return 0.5f * a * a * (1 + b * b);
}

} // namespace

void check_ggx(const GgxFacets &facets, const std::string &where) {
    Problems problems;
    const auto need = [&](bool good, double value, const char *key, const char *accepted) {
        problems.need(good, std::string(key) + " is " + std::to_string(value), where + "." + key,
                      accepted);
    };
    const auto is_alpha = [](double alpha) { return alpha >= kLeastAlpha && alpha <= 1; };
    need(is_alpha(facets.alpha_weft), facets.alpha_weft, "alpha_weft", "expected 0.0001 to 1");
    need(is_alpha(facets.alpha_warp), facets.alpha_warp, "alpha_warp", "expected 0.0001 to 1");
    if (const auto &index = facets.refractive_index)
        need(*index > 1 && *index <= 10, *index, "refractive_index",
             "expected an index above 1 and not above 10");
    else
        need(facets.f0 > 0 && facets.f0 <= 1, facets.f0, "f0",
             "expected a reflectance above 0 and not above 1");
    problems.throw_if_any();
}

GgxCore::GgxCore(const GgxFacets &facets, const Progress &progress)
    : alpha_weft_(static_cast<float>(facets.alpha_weft)),
      alpha_warp_(static_cast<float>(facets.alpha_warp)), f0_(static_cast<float>(facets.f0)),
      index_(static_cast<float>(facets.refractive_index.value_or(0))) {
    check_ggx(facets, "ggx");
    albedo_ = AlbedoTable(Symmetry::orthotropic, [&](const glm::vec3 &to_viewer) {
        return mean_weight_of_lights(*this, to_viewer, progress);
    });
}

float GgxCore::fresnel_of(float cosine) const {
    return index_ > 0 ? dielectric_fresnel(index_, cosine) : fresnel(f0_, cosine);
}

// D(H), with H not normalised
float GgxCore::facets(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const glm::vec3 h = to_light + to_viewer;
    const float x = h.x / alpha_weft_, y = h.y / alpha_warp_;
    const float t = glm::dot(h, h) / std::max(x * x + y * y + h.z * h.z, kSmallest);
    return t * t / (kPiF * alpha_weft_ * alpha_warp_);
}

// cos (1 + 2 Lambda) of Smith's masking, [Heitz] Eq. 72
float GgxCore::stretched(const glm::vec3 &d) const {
    const float x = alpha_weft_ * d.x, y = alpha_warp_ * d.y;
    return std::sqrt(x * x + y * y + d.z * d.z);
}

// G / (4 cos_i cos_r) = 1/2 / (cos_i S(V) + cos_r S(L)), S as above: [Heitz] Eq. 99 in a form that
// stays regular at grazing. The density is [Heitz2018] Eq. 17, with G1(V)/cos_r = 2 / (cos_r +
// S(V)).
WeighedLight GgxCore::weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const float ci = to_light.z, cr = to_viewer.z;
    const float d = facets(to_light, to_viewer), seen = stretched(to_viewer);
    const float cosine =
        std::sqrt(glm::clamp(0.5f * (1 + glm::dot(to_light, to_viewer)), 0.0f, 1.0f));
    return {0.5f * d * fresnel_of(cosine) * ci / (ci * seen + cr * stretched(to_light)),
            0.5f * d / (cr + seen)};
}

// [Heitz2018] listing 1.
glm::vec3 GgxCore::draw(const glm::vec3 &fixed, const glm::vec3 &u) const {
    const glm::vec3 alpha(alpha_weft_, alpha_warp_, 1);
    const glm::vec3 seen = glm::normalize(alpha * fixed);
    const float across = glm::length(glm::vec2(seen));
    const glm::vec3 side = across > 0 ? glm::vec3(-seen.y, seen.x, 0) / across : glm::vec3(1, 0, 0);
    // A point of the disk, pressed together where the hemisphere of facets turns away
    glm::vec2 p = disk_of_square({u.x, u.y});
    const float share = 0.5f * (1 + seen.z);
    p.y = (1 - share) * std::sqrt(std::max(0.0f, 1 - p.x * p.x)) + share * p.y;
    const glm::vec3 facet = p.x * side + p.y * glm::cross(seen, side) +
                            std::sqrt(std::max(0.0f, 1 - glm::dot(p, p))) * seen;
    const glm::vec3 half =
        glm::normalize(alpha * glm::vec3(facet.x, facet.y, std::max(0.0f, facet.z)));
    return glm::normalize(2 * glm::dot(fixed, half) * half - fixed);
}

float GgxCore::albedo(const glm::vec3 &direction) const {
    return std::min(1.0f, albedo_.at(direction));
}

std::optional<GgxFacets> GgxCore::widened() const {
    constexpr float kWideAlpha = 0.3f;
    if (std::min(alpha_weft_, alpha_warp_) >= kWideAlpha)
        return std::nullopt;
    GgxFacets wide{.alpha_weft = std::max(alpha_weft_, kWideAlpha),
                   .alpha_warp = std::max(alpha_warp_, kWideAlpha),
                   .f0 = f0_};
    if (index_ > 0)
        wide.refractive_index = index_;
    return wide;
}

GgxCore::GgxCore(detail::TableReader &from) { each_part(from, *this); }

template class Model<GgxCore>;

namespace {

// rho0 cos theta of the BARD and what the formula needs, at even cells of the hemisphere.
struct FitNode {
    double x, y, z; // of H
    double view_z, measured;
};

std::vector<FitNode> fit_nodes(const Bard &bard, const Progress &progress) {
    constexpr int kCells = 40;
    std::vector<FitNode> nodes;
    for (int j = 0; j < kCells; ++j)
        for (int i = 0; i < kCells; ++i) {
            stop_if_asked(progress);
            const glm::vec2 u = (glm::vec2(i, j) + 0.5f) / static_cast<float>(kCells);
            const glm::dvec3 view = direction_of_disk(disk_of_square(u));
            const glm::dvec3 half = glm::normalize(view + glm::dvec3(0, 0, 1));
            nodes.push_back({half.x, half.y, half.z, view.z, bard.at(view) * view.z});
        }
    return nodes;
}

// The model is linear in f0: the best one, and the squared error it leaves.
double best_f0(const std::vector<FitNode> &nodes, double alpha_weft, double alpha_warp,
               double &f0) {
    double aa = 0, ab = 0, bb = 0;
    for (const FitNode &n : nodes) {
        const double x = n.x / alpha_weft, y = n.y / alpha_warp, q = x * x + y * y + n.z * n.z;
        const double d = 1 / (std::numbers::pi * alpha_weft * alpha_warp * q * q);
        const double vx = 2 * n.x * n.z * alpha_weft, vy = 2 * n.y * n.z * alpha_warp;
        const double g = 0.5 / (n.view_z + std::sqrt(vx * vx + vy * vy + n.view_z * n.view_z));
        const double m = std::pow(1 - n.z, 5);
        const double value = d * g * n.view_z;
        aa += value * (1 - m) * value * (1 - m);
        ab += value * (1 - m) * (n.measured - value * m);
        bb += (n.measured - value * m) * (n.measured - value * m);
    }
    f0 = std::clamp(aa > 0 ? ab / aa : 1.0, 1e-4, 1.0);
    return bb - 2 * f0 * ab + f0 * f0 * aa;
}

} // namespace

GgxFacets fit_ggx(const Bard &bard, const Progress &progress) {
    const std::vector<FitNode> nodes = fit_nodes(bard, progress);
    GgxFacets best;
    double least = std::numeric_limits<double>::infinity();
    const auto attempt = [&](double weft, double warp) {
        stop_if_asked(progress);
        GgxFacets facets{.alpha_weft = std::clamp(weft, 0.01, 1.0),
                         .alpha_warp = std::clamp(warp, 0.01, 1.0)};
        const double error = best_f0(nodes, facets.alpha_weft, facets.alpha_warp, facets.f0);
        if (error < least) {
            least = error;
            best = facets;
        }
    };
    for (const double weft : {0.05, 0.1, 0.2, 0.4, 0.8})
        for (const double warp : {0.05, 0.1, 0.2, 0.4, 0.8})
            attempt(weft, warp);
    // A compass about the best, ever smaller
    for (double step = 1.5; step > 1.005; step = std::sqrt(step)) {
        double before = 0;
        do {
            before = least;
            const GgxFacets at = best;
            for (const double factor : {step, 1 / step}) {
                attempt(at.alpha_weft * factor, at.alpha_warp);
                attempt(at.alpha_weft, at.alpha_warp * factor);
            }
        } while (least < 0.999 * before);
    }
    return best;
}

} // namespace tsuya
