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
    double from_rectangles = 0; // irradiance in the middle of the scene
    for (const std::size_t i : plan.lights) {
        const RectangleLight &light = scene.rectangles[i];
        const LightRectangle &r = rectangles_.emplace_back(light, centre);
        const glm::dvec3 middle = light.corner + 0.5 * (light.edge_u + light.edge_v) - centre;
        from_rectangles += light.radiance * r.area() /
                           std::max(glm::dot(middle, middle), scene_radius * scene_radius * 0.01);
    }
    tree_ = LightTree(rectangles_);
    if (!plan.environment)
        return;
    const Environment &environment = *scene.environment;
    environment_ = true;
    environment_visible_ = environment.visible;
    environment_group_ = environment.group.value;
    environment_scale_ = static_cast<float>(environment.radiance);
    if (!environment.picture)
        return;
    picture_ = &*environment.picture;
    std::vector<double> mass;
    for (int y = 0; y < picture_->height; ++y) {
        const double sine = std::sin(kPiF * (y + 0.5) / picture_->height);
        for (int x = 0; x < picture_->width; ++x)
            mass.push_back(picture_->pixel(x, y)[0] * sine);
    }
    environment_density_ = Distribution2D(mass, picture_->height, picture_->width);
    const double from_environment = kPiF * environment.radiance *
                                    std::accumulate(mass.begin(), mass.end(), 0.0) /
                                    static_cast<double>(mass.size());
    // Half in proportion, half even: either has a share, a dark one none
    if (from_environment > 0)
        environment_choice_ =
            rectangles_.empty()
                ? 1.0f
                : static_cast<float>(0.5 * from_environment / (from_environment + from_rectangles) +
                                     0.25);
}

std::optional<ChosenLight> Lights::choose(const Receiver &receiver, float u) const {
    if (u < environment_choice_)
        return ChosenLight{environment_light(), environment_choice_};
    std::optional<ChosenLight> chosen =
        tree_.choose(receiver, (u - environment_choice_) / (1 - environment_choice_));
    if (chosen)
        chosen->probability *= 1 - environment_choice_;
    return chosen;
}

float Lights::choice_probability(const Receiver &receiver, std::size_t light) const {
    return light == environment_light()
               ? environment_choice_
               : (1 - environment_choice_) * tree_.probability(receiver, light);
}

std::optional<LightRay> Lights::sample(std::size_t light, const glm::vec3 &from,
                                       glm::vec2 u) const {
    if (light < rectangles_.size())
        return rectangles_[light].sample(from, u);
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

LightMet Lights::meet_environment(const glm::vec3 &direction) const {
    return {environment_radiance(direction), environment_group_, environment_light(),
            environment_pdf(direction)};
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
