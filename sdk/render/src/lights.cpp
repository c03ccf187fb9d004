#include "lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kBelowOne = 0x1.fffffep-1f;

// The share of the tree and of distant lights: half in proportion, half even.
constexpr double kEvenShare = 0.25;

// What a light is, of any kind.
template <class L> LightBehaviour behaviour_of(const L &light) {
    if constexpr (requires { light.behaviour; })
        return light.behaviour;
    else if constexpr (requires { light.visible; })
        return {.visible = light.visible, .shadows = light.shadows};
    else
        return {.shadows = light.shadows};
}

double highest_intensity(const auto &light) {
    return std::visit([](const auto &l) { return l.highest_intensity(); }, light);
}

// Powers of lights as numbers up to 2: what they are to each other counts, and very weak lights
// are no denormal numbers then.
double power_scale(const auto &lights) {
    double highest = 0;
    for (const auto &light : lights)
        highest = std::max(highest, highest_intensity(light));
    return highest > 0 ? std::ldexp(1.0, -std::ilogb(highest)) : 1.0;
}

} // namespace

Lights::Lights(const Scene &scene, const Plan &plan, const glm::dvec3 &centre,
               double scene_radius) {
    double from_near = 0; // irradiance in the middle of the scene
    for (const std::size_t i : plan.lights)
        if (const auto place = place_of(scene.lights[i])) {
            add(scene.lights[i], centre);
            const glm::dvec3 offset = place->centre - centre;
            from_near += highest_intensity(near_.back()) /
                         std::max(glm::dot(offset, offset), scene_radius * scene_radius * 0.01);
        }
    for (const std::size_t i : plan.lights)
        if (!place_of(scene.lights[i]))
            add(scene.lights[i], centre);
    std::vector<LightBounds> bounds;
    const double scale = power_scale(near_);
    for (const Near &light : near_)
        bounds.push_back(std::visit(
            [&](const auto &l) {
                return l.bounds(static_cast<float>(scale * l.highest_intensity()));
            },
            light));
    tree_ = LightTree(std::move(bounds));
    if (plan.environment)
        add_environment(*scene.environment);
    share_choices(from_near);
}

void Lights::add(const Light &light, const glm::dvec3 &centre) {
    struct Make {
        Lights &lights;
        const glm::dvec3 &centre;
        void operator()(const RectangleLight &l) {
            lights.near_.emplace_back(LightRectangle(l, centre));
        }
        void operator()(const DiskLight &l) { lights.near_.emplace_back(LightDisk(l, centre)); }
        void operator()(const SphereLight &l) { lights.near_.emplace_back(LightSphere(l, centre)); }
        void operator()(const PointLight &l) { lights.near_.emplace_back(LightPoint(l, centre)); }
        void operator()(const SunLight &l) { lights.suns_.emplace_back(l); }
    };
    std::visit(Make{*this, centre}, light);
    std::visit(
        [&](const auto &l) {
            const auto [visible, blocks, shadows] = behaviour_of(l);
            traits_.push_back({l.group.value, visible, blocks, shadows});
            obstacles_ |= blocks;
        },
        light);
    any_seen_ |= traits_.back().visible && near_.size() == traits_.size();
}

void Lights::add_environment(const Environment &environment) {
    environment_ = true;
    traits_.push_back({environment.group.value, environment.visible, false, true});
    environment_scale_ = static_cast<float>(environment.radiance);
    if (!environment.picture)
        return;
    picture_ = &*environment.picture;
    environment_turn_ = static_cast<float>(environment.turn / (2 * kPi));
    for (const LightGroupIndex group : environment.further_groups)
        further_groups_.push_back(group.value);
    const std::size_t channels = 1 + further_groups_.size();
    std::vector<double> mass;
    for (int y = 0; y < picture_->height; ++y) {
        const double sine = std::sin(kPiF * (y + 0.5) / picture_->height);
        for (int x = 0; x < picture_->width; ++x)
            mass.push_back(sine * std::accumulate(picture_->pixel(x, y),
                                                  picture_->pixel(x, y) + channels, 0.0f));
    }
    environment_density_ = Distribution2D(mass, picture_->height, picture_->width);
    environment_irradiance_ = kPiF * environment.radiance *
                              std::accumulate(mass.begin(), mass.end(), 0.0) /
                              static_cast<double>(mass.size());
}

void Lights::share_choices(double from_near) {
    std::vector<double> distant;
    for (const LightSun &sun : suns_)
        distant.push_back(sun.irradiance());
    if (picture_)
        distant.push_back(environment_irradiance_);
    const double all = std::accumulate(distant.begin(), distant.end(), 0.0);
    // Either has a share, a dark one none
    const double share =
        !(all > 0) ? 0 : (near_.empty() ? 1 : 0.5 * all / (all + from_near) + kEvenShare);
    for (const double one : distant)
        distant_choice_.push_back(all > 0 ? static_cast<float>(share * (one < all ? one / all : 1))
                                          : 0.0f);
}

std::optional<ChosenLight> Lights::choose(const Receiver &receiver, float u) const {
    float of_tree = 1;
    for (std::size_t i = 0; i < distant_choice_.size(); ++i) {
        if (u < distant_choice_[i])
            return ChosenLight{near_.size() + i, distant_choice_[i]};
        u -= distant_choice_[i];
        of_tree -= distant_choice_[i];
    }
    std::optional<ChosenLight> chosen = tree_.choose(receiver, std::min(u / of_tree, kBelowOne));
    if (chosen)
        chosen->probability *= of_tree;
    return chosen;
}

float Lights::choice_probability(const Receiver &receiver, std::size_t light) const {
    if (light >= near_.size())
        return light - near_.size() < distant_choice_.size() ? distant_choice_[light - near_.size()]
                                                             : 0.0f;
    float of_tree = 1;
    for (const float choice : distant_choice_)
        of_tree -= choice;
    return of_tree * tree_.probability(receiver, light);
}

std::optional<LightRay> Lights::sample(std::size_t light, const glm::vec3 &from,
                                       glm::vec2 u) const {
    if (light == environment_light())
        return sample_environment(u);
    const auto sample_one = [&](const auto &l) { return l.sample(from, u); };
    if (light < near_.size() && traits_[light].shadows)
        return std::visit(sample_one, near_[light]);
    std::optional<LightRay> ray = light < near_.size() ? std::visit(sample_one, near_[light])
                                                       : suns_[light - near_.size()].sample(u);
    // No ray is to meet a light that goes through everything
    if (ray && !traits_[light].shadows && ray->pdf < kOnlyDirection) {
        ray->radiance /= ray->pdf;
        ray->pdf = kOnlyDirection;
    }
    return ray;
}

std::optional<LightMet> Lights::nearest_seen(const glm::vec3 &from, const glm::vec3 &direction,
                                             float farthest) const {
    std::optional<LightMet> nearest;
    tree_.cross(from, direction, [&](std::size_t i) {
        if (!traits_[i].visible)
            return false;
        std::visit(
            [&](const auto &light) {
                const std::optional<float> front = light.crossing(from, direction);
                const std::optional<float> any =
                    front || !traits_[i].blocks ? front : light.obstacle(from, direction);
                if (any && *any < farthest) {
                    farthest = *any;
                    nearest = LightMet{front ? light.radiance() : 0.0f, traits_[i].group, i, 0};
                }
            },
            near_[i]);
        return false;
    });
    return nearest;
}

bool Lights::is_blocked(const glm::vec3 &from, const glm::vec3 &direction, float farthest,
                        std::size_t to) const {
    return tree_.cross(from, direction, [&](std::size_t i) {
        if (!traits_[i].blocks || i == to)
            return false;
        const std::optional<float> distance = std::visit(
            [&](const auto &light) { return light.obstacle(from, direction); }, near_[i]);
        return distance && *distance < farthest;
    });
}

bool Lights::find_obstacle(const glm::vec3 &from, const glm::vec3 &direction,
                           float &farthest) const {
    bool ended = false;
    tree_.cross(from, direction, [&](std::size_t i) {
        const std::optional<float> distance =
            traits_[i].blocks
                ? std::visit([&](const auto &light) { return light.obstacle(from, direction); },
                             near_[i])
                : std::nullopt;
        if (distance && *distance < farthest) {
            // Its own front still counts
            farthest = std::nextafter(*distance, kInfinity);
            ended = true;
        }
        return false;
    });
    return ended;
}

std::optional<LightRay> Lights::sample_environment(glm::vec2 u) const {
    const Distribution2D::Sample s = environment_density_.sample(u);
    const float theta = kPiF * s.point.y;
    const float phi = 2 * kPiF * (s.point.x - 0.5f + environment_turn_);
    const float sine = std::sin(theta);
    if (!(sine > 0))
        return std::nullopt;
    const glm::vec3 to_light(sine * std::sin(phi), std::cos(theta), sine * std::cos(phi));
    return LightRay{to_light, kInfinity, environment_radiance(to_light),
                    s.density / (2 * kPiF * kPiF * sine)};
}

glm::vec2 Lights::square_of(const glm::vec3 &d) const {
    const float theta = std::atan2(std::sqrt(d.x * d.x + d.z * d.z), d.y);
    float x = std::atan2(d.x, d.z) / (2 * kPiF) + 0.5f;
    if (environment_turn_ != 0) {
        x -= environment_turn_;
        x -= std::floor(x);
    }
    return {x, theta / kPiF};
}

LightMet Lights::meet_environment(const glm::vec3 &direction, std::size_t channel) const {
    const std::size_t light = environment_light();
    const float *const pixel = environment_pixel(direction);
    return {environment_scale_ * (pixel ? pixel[channel] : 1.0f),
            channel == 0 ? traits_[light].group : further_groups_[channel - 1], light,
            environment_pdf(direction)};
}

Lights::Parts Lights::environment_parts(const glm::vec3 &to_light) const {
    Parts parts{.count = 1 + further_groups_.size(), .group = {traits_.back().group}};
    const float *const pixel = environment_pixel(to_light);
    const float all = std::accumulate(pixel, pixel + parts.count, 0.0f);
    for (std::size_t c = 0; c < parts.count; ++c) {
        parts.share[c] = all > 0 ? pixel[c] / all : 0;
        if (c > 0)
            parts.group[c] = further_groups_[c - 1];
    }
    return parts;
}

const float *Lights::environment_pixel(const glm::vec3 &direction) const {
    if (!picture_)
        return nullptr;
    const glm::vec2 p = square_of(direction);
    const int x = std::clamp(static_cast<int>(p.x * static_cast<float>(picture_->width)), 0,
                             picture_->width - 1);
    const int y = std::clamp(static_cast<int>(p.y * static_cast<float>(picture_->height)), 0,
                             picture_->height - 1);
    return picture_->pixel(x, y);
}

float Lights::environment_radiance(const glm::vec3 &direction) const {
    const float *const pixel = environment_pixel(direction);
    return pixel ? environment_scale_ *
                       std::accumulate(pixel, pixel + 1 + further_groups_.size(), 0.0f)
                 : environment_scale_;
}

float Lights::environment_pdf(const glm::vec3 &direction) const {
    if (!picture_)
        return 0;
    const float sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    return sine > 0 ? environment_density_.density(square_of(direction)) / (2 * kPiF * kPiF * sine)
                    : 0.0f;
}

} // namespace tsuya
