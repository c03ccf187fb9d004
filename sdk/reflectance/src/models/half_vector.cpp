#include "tsuya/sdk/half_vector.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "models/facets.h"
#include "tables/disk.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr float kQuarterTurn = 0.25f * kPiF; // the largest tilt that light from above shows
constexpr float kSlopeSpan = kPiF / 12;      // below it, where the slope of the tail is taken
// Of the tail: it falls to 1/e within these tilts
constexpr float kShortestTail = kPiF / 60, kLongestTail = kPiF / 6;
constexpr int kTableNodes = 241;     // quadrant; 0.24 degrees of tilt at the pole
constexpr int kFullTableNodes = 361; // whole square
constexpr int kDensityCells = 128;
constexpr int kAlbedoSamples = 8192;
constexpr float kSmallest = 1e-20f;
constexpr float kEvenShare = 0.02f; // of the density: keeps it above 0 where D is not

// D at a tilt that light from straight above shows.
float shown_facets(const Bard &bard, float f0, float tilt, const glm::vec2 &azimuth) {
    const float theta = 2 * tilt;
    return scaled_bard(bard, f0, {azimuth * std::sin(theta), std::max(std::cos(theta), 0.0f)});
}

float facets(const Bard &bard, float f0, const glm::vec2 &horizontal) {
    const float sine = glm::length(horizontal);
    const float tilt = std::asin(std::min(sine, 1.0f));
    const glm::vec2 azimuth = sine > 0 ? horizontal / sine : glm::vec2(1, 0);
    if (tilt <= kQuarterTurn)
        return shown_facets(bard, f0, tilt, azimuth);
    const float last = shown_facets(bard, f0, kQuarterTurn, azimuth);
    if (!(last > 0))
        return 0;
    const float before = shown_facets(bard, f0, kQuarterTurn - kSlopeSpan, azimuth);
    const float rate = std::log(before / last) / kSlopeSpan;
    const float held = std::clamp(rate, 1 / kLongestTail, 1 / kShortestTail);
    return last * std::exp(-held * (tilt - kQuarterTurn));
}

// The horizontal part of H, with N.H; and |L + V|, which is twice V.H. From the sum itself: 1 + L.V
// cancels where light and view are opposite at grazing.
struct Half {
    glm::vec2 horizontal;
    float z, length;

    Half(const glm::vec3 &l, const glm::vec3 &v) {
        const glm::vec3 sum = l + v;
        length = std::sqrt(std::max(glm::dot(sum, sum), kSmallest));
        horizontal = glm::vec2(sum) / length;
        z = sum.z / length;
    }
};

} // namespace

HalfVectorCore::HalfVectorCore(const Bard &bard, double f0, const Progress &progress)
    : f0_(checked_f0(f0)) {
    const bool orthotropic = bard.symmetry() == Symmetry::orthotropic;
    // The table's own disk has another radius: its directions only carry the point
    facets_ = DiskTable(orthotropic ? kTableNodes : kFullTableNodes, orthotropic,
                        [&](const glm::vec3 &carrier) {
                            stop_if_asked(progress);
                            return facets(bard, f0_, disk_of_direction(carrier));
                        });
    tabulate_density();
    tabulate_albedos(bard.symmetry(), progress);
}

// The disk of the horizontal part of H has the area element N.H dH: equal cells sample D N.H.
void HalfVectorCore::tabulate_density() {
    std::vector<double> mass;
    double total = 0;
    for (int j = 0; j < kDensityCells; ++j)
        for (int i = 0; i < kDensityCells; ++i) {
            const glm::vec2 u = (glm::vec2(i, j) + 0.5f) / static_cast<float>(kDensityCells);
            mass.push_back(facets_.at(direction_of_disk(disk_of_square(u))));
            total += mass.back();
        }
    for (double &m : mass)
        m += kEvenShare * (total > 0 ? total : 1.0) / static_cast<double>(mass.size());
    density_ = Distribution2D(mass, kDensityCells, kDensityCells);
}

void HalfVectorCore::tabulate_albedos(Symmetry symmetry, const Progress &progress) {
    albedo_.tabulate(symmetry, [&](const glm::vec3 &to_viewer) {
        return mean_weight_of_lights(*this, to_viewer, progress, kAlbedoSamples);
    });
}

WeighedLight HalfVectorCore::weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const Half half(to_light, to_viewer);
    const float v_h = 0.5f * half.length; // V.H = L.H
    const float d = facets_.at(direction_of_disk(half.horizontal));
    // The smaller of the two limits bounds the albedo of both directions and stays reciprocal
    const float limited = std::min(albedo_.limit(to_light), albedo_.limit(to_viewer));
    const FacetTerms terms{d * fresnel(f0_, std::min(v_h, 1.0f)) * limited, 2 * half.z / v_h};
    const float density = density_.density(square_of_disk(half.horizontal)) / kPiF * half.z;
    return {terms.cos(to_light.z, to_viewer.z), density / (4 * v_h)};
}

// Samples H, and mirrors the view in it. A facet that looks away is a null sample.
glm::vec3 HalfVectorCore::draw(const glm::vec3 &fixed, const glm::vec3 &u) const {
    const glm::vec2 p = disk_of_square(density_.sample({u.x, u.y}).point);
    const glm::vec3 half(p, std::sqrt(std::max(1 - glm::dot(p, p), 0.0f)));
    const float facing = glm::dot(fixed, half);
    if (!(facing > 0))
        return glm::vec3(0);
    return 2 * facing * half - fixed;
}

float HalfVectorCore::albedo(const glm::vec3 &direction) const { return albedo_.at(direction); }

bool HalfVectorCore::is_extrapolated(const glm::vec3 &to_light, const glm::vec3 &to_viewer) {
    return Half(to_light, to_viewer).z < std::cos(kQuarterTurn);
}

HalfVectorCore::HalfVectorCore(detail::TableReader &from) { each_part(from, *this); }

template class Model<HalfVectorCore>;

} // namespace tsuya
