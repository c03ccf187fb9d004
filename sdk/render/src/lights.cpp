#include "lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {
constexpr float kInfinity = std::numeric_limits<float>::infinity();
} // namespace

Lights::Lights(const Scene &scene, const Plan &plan, const glm::dvec3 &centre,
               double scene_radius) {
    std::vector<double> given;
    for (const std::size_t i : plan.lights) {
        const RectangleLight &light = scene.rectangles[i];
        Rectangle r;
        r.corner = light.corner - centre;
        r.edge_u = light.edge_u;
        r.edge_v = light.edge_v;
        const glm::dvec3 across = glm::cross(light.edge_u, light.edge_v);
        r.area = static_cast<float>(glm::length(across));
        r.normal = glm::normalize(across);
        r.dual_u = glm::cross(light.edge_v, across) / glm::dot(across, across);
        r.dual_v = glm::cross(across, light.edge_u) / glm::dot(across, across);
        r.radiance = static_cast<float>(light.radiance);
        r.group = light.group.value;
        rectangles_.push_back(r);
        const glm::dvec3 middle = light.corner + 0.5 * (light.edge_u + light.edge_v) - centre;
        given.push_back(light.radiance * r.area /
                        std::max(glm::dot(middle, middle), scene_radius * scene_radius * 0.01));
    }
    if (plan.environment) {
        const Environment &environment = *scene.environment;
        environment_ = true;
        environment_visible_ = environment.visible;
        environment_group_ = environment.group.value;
        environment_scale_ = static_cast<float>(environment.radiance);
        if (environment.picture) {
            picture_ = &*environment.picture;
            std::vector<double> mass;
            for (int y = 0; y < picture_->height; ++y) {
                const double sine = std::sin(kPiF * (y + 0.5) / picture_->height);
                for (int x = 0; x < picture_->width; ++x)
                    mass.push_back(picture_->pixel(x, y)[0] * sine);
            }
            environment_density_ = Distribution2D(mass, picture_->height, picture_->width);
            given.push_back(kPiF * environment.radiance *
                            std::accumulate(mass.begin(), mass.end(), 0.0) /
                            static_cast<double>(mass.size()));
        }
    }
    // Half in proportion, half even among those that shine: every light has a share, a dark one
    // none
    const double total = std::accumulate(given.begin(), given.end(), 0.0);
    const auto shining = static_cast<double>(
        std::count_if(given.begin(), given.end(), [](double g) { return g > 0; }));
    for (const double g : given)
        choice_.push_back(g > 0 ? static_cast<float>(0.5 * g / total + 0.5 / shining) : 0.0f);
}

std::size_t Lights::choose(float u) const {
    std::size_t i = 0;
    while (i + 1 < choice_.size() && u >= choice_[i])
        u -= choice_[i++];
    return i;
}

std::optional<LightRay> Lights::sample(std::size_t light, const glm::vec3 &from,
                                       glm::vec2 u) const {
    if (light < rectangles_.size()) {
        const Rectangle &r = rectangles_[light];
        const glm::vec3 offset = r.corner + u.x * r.edge_u + u.y * r.edge_v - from;
        const float distance2 = glm::dot(offset, offset), distance = std::sqrt(distance2);
        const float facing = -glm::dot(offset, r.normal) / distance;
        if (!(facing > 0))
            return std::nullopt;
        return LightRay{offset / distance, distance, r.radiance, distance2 / (facing * r.area),
                        r.group};
    }
    const Distribution2D::Sample s = environment_density_.sample(u);
    const float theta = kPiF * s.point.y, phi = 2 * kPiF * (s.point.x - 0.5f);
    const float sine = std::sin(theta);
    if (!(sine > 0))
        return std::nullopt;
    const glm::vec3 to_light(sine * std::sin(phi), std::cos(theta), sine * std::cos(phi));
    return LightRay{to_light, kInfinity, environment_radiance(to_light),
                    s.density / (2 * kPiF * kPiF * sine), environment_group_};
}

glm::vec2 Lights::square_of(const glm::vec3 &d) const {
    const float theta = std::atan2(std::sqrt(d.x * d.x + d.z * d.z), d.y);
    return {std::atan2(d.x, d.z) / (2 * kPiF) + 0.5f, theta / kPiF};
}

float Lights::environment_radiance(const glm::vec3 &direction) const {
    if (!picture_)
        return environment_scale_;
    const glm::vec2 p = square_of(direction);
    const int x = std::clamp(static_cast<int>(p.x * static_cast<float>(picture_->width)), 0,
                             picture_->width - 1);
    const int y = std::clamp(static_cast<int>(p.y * static_cast<float>(picture_->height)), 0,
                             picture_->height - 1);
    return environment_scale_ * picture_->pixel(x, y)[0];
}

float Lights::environment_pdf(const glm::vec3 &direction) const {
    if (!picture_)
        return 0;
    const float sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    return sine > 0 ? environment_density_.density(square_of(direction)) / (2 * kPiF * kPiF * sine)
                    : 0.0f;
}

} // namespace tsuya
