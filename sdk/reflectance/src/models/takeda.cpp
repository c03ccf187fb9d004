#include "tsuya/sdk/takeda.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "models/facets.h"
#include "models/takeda_kernel.h"
#include "tables/disk.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr int kTableNodes = 161;     // quadrant; 0.5 degrees at the pole
constexpr int kFullTableNodes = 181; // whole square; 0.9 degrees
constexpr int kDensityCells = 96;
constexpr int kPartsOfCell = 4;          // along it, where its mass is summed
constexpr float kEvenShare = 0.01f;      // of a density: keeps it above 0 where rho0 is not
constexpr float kHalfShare = 0.9f;       // of the lights, sampled by H; the rest is uniform
constexpr float kTail = 12 * kPiF / 180; // facets beyond 45 degrees fall to 1/e within this tilt
constexpr float kDiskOfSquare = 0.25f;   // area of the unit square for an area of the disk
constexpr float kEvenDensity = 0.5f / kPiF;
constexpr float kLeastCosine = 1e-18f; // of the light, by which its cosine is taken out again

// Masses of the cells of the square about the unit disk; what lies outside the disk has none.
template <class Mass> Distribution2D tabulate_on_disk(const Mass &mass_at) {
    std::vector<double> mass(static_cast<std::size_t>(kDensityCells * kDensityCells)), area = mass;
    constexpr int kParts = kDensityCells * kPartsOfCell;
    double total = 0, inside = 0;
    for (int j = 0; j < kParts; ++j)
        for (int i = 0; i < kParts; ++i) {
            const glm::vec2 p = (glm::vec2(i, j) + 0.5f) * (2.0f / kParts) - 1.0f;
            if (glm::dot(p, p) >= 1)
                continue;
            const auto cell =
                static_cast<std::size_t>(j / kPartsOfCell * kDensityCells + i / kPartsOfCell);
            const double m = mass_at(p);
            mass[cell] += m;
            area[cell] += 1;
            total += m;
            inside += 1;
        }
    for (std::size_t i = 0; i < mass.size(); ++i)
        mass[i] += kEvenShare * (total > 0 ? total : 1.0) * area[i] / inside;
    return {mass, kDensityCells, kDensityCells};
}

glm::vec2 square_about(const glm::vec2 &p) { return 0.5f * (p + 1.0f); }

} // namespace

TakedaCore::TakedaCore(const Bard &bard, double f0, const Progress &progress)
    : f0_(checked_f0(f0)), half_turn_(bard.symmetry() != Symmetry::none) {
    const bool orthotropic = bard.symmetry() == Symmetry::orthotropic;
    scaled_ = scaled_bard(bard, f0_, orthotropic ? kTableNodes : kFullTableNodes, progress);
    tabulate_densities(progress);
    tabulate_albedos(bard.symmetry(), progress);
}

void TakedaCore::tabulate_densities(const Progress &progress) {
    basics_ = tabulate_on_disk([&](const glm::vec2 &p) {
        stop_if_asked(progress);
        const float z = 1 - glm::dot(p, p);
        return scaled_.at(direction_of_disk(p)) * fresnel(f0_, std::sqrt(0.5f * (1 + z))) * z /
               std::max(z, 0.5f);
    });
    // For the facet that mirrors the view into the light V0 lies between two tilts: twice the
    // facet's, under light from straight above, and theta_i a/(a + theta_i), for the view from
    // straight above. The geometric mean of both samples equally well from all sides.
    halves_ = tabulate_on_disk([&](const glm::vec2 &p) {
        stop_if_asked(progress);
        const float sine = glm::length(p), tilt = std::asin(sine), turned = 2 * tilt;
        const float theta =
            std::sqrt(std::min(turned, kHalfPiF) * kHalfPiF * turned / (kHalfPiF + turned));
        const glm::vec2 level = p * (std::sin(theta) / std::max(sine, 1e-9f));
        return scaled_.at({level, std::cos(theta)}) * fresnel(f0_, std::cos(tilt)) *
               std::exp(-std::max(0.0f, tilt - 0.5f * kHalfPiF) / kTail);
    });
}

void TakedaCore::tabulate_albedos(Symmetry symmetry, const Progress &progress) {
    // limited_below_ is 0 still: this is the albedo before the limit
    light_albedo_ = AlbedoTable(symmetry, [&](const glm::vec3 &to_light) {
        return mean_weight_of_views(*this, to_light, progress);
    });
    unlimited_albedo_ = light_albedo_.maximum();
    limited_below_ = light_albedo_.cosine_above(1);
    view_albedo_ = AlbedoTable(symmetry, [&](const glm::vec3 &to_viewer) {
        return mean_weight_of_lights(*this, to_viewer, progress);
    });
}

float TakedaCore::limit_at(const glm::vec3 &to_light) const {
    return 1 / std::max(1.0f, light_albedo_.at(to_light));
}

float TakedaCore::f_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return kernel::f_cos(scaled_, f0_, to_light, to_viewer) * limit(to_light);
}

void TakedaCore::f_cos(std::span<const glm::vec3> to_light, std::span<const glm::vec3> to_viewer,
                       std::span<float> f_cos) const {
    assert(to_light.size() == f_cos.size() && to_viewer.size() == f_cos.size());
    if (kernel::evaluate(scaled_, f0_, limited_below_, to_light.data(), to_viewer.data(),
                         f_cos.data(), f_cos.size()))
        for (std::size_t i = 0; i < f_cos.size(); ++i)
            if (to_light[i].z < limited_below_)
                f_cos[i] *= limit(to_light[i]);
}

WeighedLight TakedaCore::weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const kernel::Weighed pair = kernel::weigh(scaled_, halves_, f0_, to_light, to_viewer);
    return {pair.f_cos * limit(to_light),
            kHalfShare * pair.density_per_sr + (1 - kHalfShare) * kEvenDensity};
}

// The disk of V0 has an area of 1/2 for a steradian.
WeighedLight TakedaCore::weigh_view(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const GreatCircle c = to_basic(to_light, to_viewer);
    const float density = basics_.density(square_about(disk_of_direction(c.basic))) *
                          (0.5f * kDiskOfSquare) * c.sine_ratio * (half_turn_ ? 1.0f : c.slope);
    return {f_cos(to_light, to_viewer) / std::max(to_light.z, kLeastCosine) * to_viewer.z, density};
}

// Most lights by the facet that mirrors the view into them; what lies below the horizon is a null
// sample.
glm::vec3 TakedaCore::draw(const glm::vec3 &to_viewer, const glm::vec3 &u) const {
    if (!(u.z < kHalfShare))
        return direction_of_disk(disk_of_square({u.x, u.y}));
    const bool near_level = u.z < kHalfShare * kernel::near_level_share(to_viewer.z);
    const glm::vec2 p = near_level ? std::sqrt(kernel::kNearLevel2) * disk_of_square({u.x, u.y})
                                   : 2.0f * halves_.sample({u.x, u.y}).point - 1.0f;
    const float z2 = 1 - glm::dot(p, p);
    if (!(z2 > 0))
        return glm::vec3(0);
    const glm::vec3 half(p, std::sqrt(z2));
    const float facing = glm::dot(to_viewer, half);
    return facing > 0 ? 2 * facing * half - to_viewer : glm::vec3(0);
}

// Where rho0 repeats after half a turn, V0 is turned to R's side with probability 1/2 - theta_i/pi:
// the density of the view then has no jump by the slope of the map.
glm::vec3 TakedaCore::draw_view(const glm::vec3 &to_light, const glm::vec3 &u) const {
    const glm::vec2 p = 2.0f * basics_.sample({u.x, u.y}).point - 1.0f;
    if (!(glm::dot(p, p) < 1))
        return glm::vec3(0);
    glm::vec3 basic = direction_of_disk(p);
    if (half_turn_) {
        const float tilt = angle_of(glm::length(glm::vec2(to_light)), to_light.z);
        const bool wants_away = u.z < 0.5f - tilt / kPiF;
        const bool is_away = basic.x * to_light.x + basic.y * to_light.y <= 0;
        if (wants_away != is_away)
            basic = {-basic.x, -basic.y, basic.z};
    }
    return view_of_basic(to_light, basic).to_viewer;
}

float TakedaCore::albedo(const glm::vec3 &to_light) const {
    return std::min(1.0f, light_albedo_.at(to_light));
}

float TakedaCore::albedo_of_view(const glm::vec3 &to_viewer) const {
    return view_albedo_.at(to_viewer);
}

TakedaCore::TakedaCore(detail::TableReader &from) { each_part(from, *this); }

template class Model<TakedaCore>;

} // namespace tsuya
