#include "tsuya/sdk/takeda.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "disk.h"
#include "facets.h"

namespace tsuya {
namespace {

constexpr float kPi = 3.14159265f;
constexpr int kTableNodes = 161;     // quadrant; 0.5 degrees at the pole
constexpr int kFullTableNodes = 241; // whole square
constexpr int kDensityCells = 96;
constexpr int kAlbedoSamples = 1024;
constexpr float kSmallest = 1e-20f;

} // namespace

struct TakedaBrdf::Terms : FacetTerms {};

TakedaBrdf::TakedaBrdf(const Bard &bard, double f0)
    : f0_(static_cast<float>(f0)), half_turn_(bard.symmetry() != Symmetry::none) {
    const bool orthotropic = bard.symmetry() == Symmetry::orthotropic;
    const int nodes = orthotropic ? kTableNodes : kFullTableNodes;
    scaled_ = DiskTable(nodes, orthotropic, [&](const glm::vec3 &d) {
        const float half_cosine = std::sqrt(0.5f * (1 + d.z));
        return static_cast<float>(bard.at(d)) * std::max(d.z, 0.5f) / fresnel(f0_, half_cosine);
    });

    std::vector<double> mass(static_cast<std::size_t>(kDensityCells * kDensityCells));
    double total = 0;
    for (int j = 0; j < kDensityCells; ++j)
        for (int i = 0; i < kDensityCells; ++i) {
            const glm::vec2 u = (glm::vec2(i, j) + 0.5f) / static_cast<float>(kDensityCells);
            const glm::vec3 d = direction_of_disk(disk_of_square(u));
            const double m = scaled_.at(d) * fresnel(f0_, std::sqrt(0.5f * (1 + d.z))) * d.z /
                             std::max(d.z, 0.5f);
            mass[static_cast<std::size_t>(j * kDensityCells + i)] = m;
            total += m;
        }
    // A small even share keeps the density above 0 where rho0 is not
    for (double &m : mass)
        m += 0.01 * total / static_cast<double>(mass.size());
    density_ = Distribution2D(mass, kDensityCells, kDensityCells);
    tabulate_albedos(bard.symmetry());
}

void TakedaBrdf::tabulate_albedos(Symmetry symmetry) {
    const auto mean_weight = [](const auto &draw) {
        double sum = 0;
        for (int i = 0; i < kAlbedoSamples; ++i)
            if (const auto s = draw(quadrature_point(i)))
                sum += s->weight;
        return static_cast<float>(sum / kAlbedoSamples);
    };
    // limited_below_ is 0 still: this is the albedo before the limit
    light_albedo_ = AlbedoTable(symmetry, [&](const glm::vec3 &to_light) {
        return mean_weight([&](const glm::vec3 &u) { return sample_adjoint(to_light, u); });
    });
    unlimited_albedo_ = light_albedo_.maximum();
    limited_below_ = light_albedo_.cosine_above(1);
    view_albedo_ = AlbedoTable(symmetry, [&](const glm::vec3 &to_viewer) {
        return mean_weight([&](const glm::vec3 &u) { return sample(to_viewer, u); });
    });
}

float TakedaBrdf::limit(const glm::vec3 &to_light) const {
    return to_light.z < limited_below_ ? 1 / std::max(1.0f, light_albedo_.at(to_light)) : 1.0f;
}

TakedaBrdf::Terms TakedaBrdf::terms(const glm::vec3 &to_light, const glm::vec3 &to_viewer,
                                    const glm::vec3 &basic) const {
    const float sum = std::max(1 + glm::dot(to_light, to_viewer), kSmallest);
    const float light_half = std::sqrt(std::min(0.5f * sum, 1.0f)); // L.H
    return {{scaled_.at(basic) * fresnel(f0_, light_half) * limit(to_light),
             2 * (to_light.z + to_viewer.z) / sum}};
}

float TakedaBrdf::evaluate(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const float ci = to_light.z, cr = to_viewer.z;
    if (!(ci > 0 && cr > 0))
        return 0;
    return terms(to_light, to_viewer, to_basic(to_light, to_viewer).basic).per_sr(ci, cr);
}

float TakedaBrdf::evaluate_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    if (!(to_light.z > 0 && to_viewer.z > 0))
        return 0;
    return terms(to_light, to_viewer, to_basic(to_light, to_viewer).basic)
        .cos(to_light.z, to_viewer.z);
}

float TakedaBrdf::density_of_basic(const glm::vec3 &basic) const {
    return density_.density(square_of_disk(disk_of_direction(basic))) / (2 * kPi);
}

// Where rho0 repeats after half a turn, V0 is turned to R's side with probability 1/2 - theta_i/pi:
// the density of the view then has no jump by the slope of the map.
std::optional<glm::vec3> TakedaBrdf::draw_view(const glm::vec3 &to_light,
                                               const glm::vec3 &u) const {
    glm::vec3 basic = direction_of_disk(disk_of_square(density_.sample({u.x, u.y}).point));
    if (half_turn_) {
        const float tilt = angle_of(glm::length(glm::vec2(to_light)), to_light.z);
        const bool wants_away = u.z < 0.5f - tilt / kPi;
        const bool is_away = basic.x * to_light.x + basic.y * to_light.y <= 0;
        if (wants_away != is_away)
            basic = {-basic.x, -basic.y, basic.z};
    }
    const glm::vec3 to_viewer = view_of_basic(to_light, basic).to_viewer;
    return to_viewer.z > 0 ? std::optional(to_viewer) : std::nullopt;
}

float TakedaBrdf::density_of_view(const GreatCircle &c) const {
    return density_of_basic(c.basic) * c.sine_ratio * (half_turn_ ? 1.0f : c.slope);
}

float TakedaBrdf::density_of_light(const GreatCircle &c, const glm::vec3 &to_light,
                                   const glm::vec3 &to_viewer) const {
    return density_of_basic(c.basic) * jacobian_of_light(c, to_light, to_viewer);
}

float TakedaBrdf::pdf(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return weigh(to_light, to_viewer).pdf_per_sr;
}

// Half of the lights come from V0 and the inverse map; half from the map with view and light
// swapped, whose support is the whole hemisphere.
WeighedLight TakedaBrdf::weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    if (!(to_light.z > 0 && to_viewer.z > 0))
        return {};
    const GreatCircle circle = to_basic(to_light, to_viewer);
    const float swapped = density_of_view(to_basic(to_viewer, to_light));
    return {terms(to_light, to_viewer, circle.basic).cos(to_light.z, to_viewer.z),
            0.5f * (density_of_light(circle, to_light, to_viewer) + swapped)};
}

float TakedaBrdf::pdf_adjoint(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return to_light.z > 0 && to_viewer.z > 0 ? density_of_view(to_basic(to_light, to_viewer))
                                             : 0.0f;
}

std::optional<SampledDirection> TakedaBrdf::sample(const glm::vec3 &to_viewer,
                                                   const glm::vec3 &u) const {
    if (!(to_viewer.z > 0))
        return std::nullopt;
    std::optional<glm::vec3> to_light;
    if (u.z < 0.5f)
        to_light = light_of_basic(
            to_viewer, direction_of_disk(disk_of_square(density_.sample({u.x, u.y}).point)));
    else
        to_light = draw_view(to_viewer, {u.x, u.y, 2 * u.z - 1});
    if (!to_light)
        return std::nullopt;
    const WeighedLight light = weigh(*to_light, to_viewer);
    if (!(light.pdf_per_sr > 0))
        return std::nullopt;
    return SampledDirection{*to_light, light.f_cos / light.pdf_per_sr, light.pdf_per_sr};
}

std::optional<SampledDirection> TakedaBrdf::sample_adjoint(const glm::vec3 &to_light,
                                                           const glm::vec3 &u) const {
    if (!(to_light.z > 0))
        return std::nullopt;
    const std::optional<glm::vec3> to_viewer = draw_view(to_light, u);
    if (!to_viewer)
        return std::nullopt;
    const GreatCircle circle = to_basic(to_light, *to_viewer);
    const float density = density_of_view(circle);
    if (!(density > 0))
        return std::nullopt;
    const Terms t = terms(to_light, *to_viewer, circle.basic);
    return SampledDirection{*to_viewer, t.cos(to_viewer->z, to_light.z) / density, density};
}

float TakedaBrdf::albedo_of_light(const glm::vec3 &to_light) const {
    return to_light.z > 0 ? std::min(1.0f, light_albedo_.at(to_light)) : 0.0f;
}

float TakedaBrdf::albedo_of_view(const glm::vec3 &to_viewer) const {
    return to_viewer.z > 0 ? view_albedo_.at(to_viewer) : 0.0f;
}

} // namespace tsuya
