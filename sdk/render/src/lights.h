#pragma once
// Lights as the path tracer samples and meets them.

#include <array>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "light_disk.h"
#include "light_point.h"
#include "light_rectangle.h"
#include "light_sphere.h"
#include "light_sun.h"
#include "light_tree.h"
#include "tsuya/sdk/detail/distribution.h"
#include "tsuya/sdk/plan.h"
#include "tsuya/sdk/scene.h"

namespace tsuya {

// At the camera's vertex as many lights are sampled each; of more a few are chosen.
inline constexpr std::size_t kFewLights = 4;

// A light that a ray meets. The densities are those with which `sample` and `choose` find it.
struct LightMet {
    float radiance;
    std::uint32_t group;
    std::size_t light;
    float pdf; // 1/sr
};

// Lights are numbered: those that are near, the suns, the environment.
class Lights {
  public:
    Lights(const Scene &scene, const Plan &plan, const glm::dvec3 &centre, double scene_radius);

    // Lights that are sampled from a point: all but an even environment, which is left to the
    // surface's own sampling: that is exact for it on a diffuser.
    std::size_t count() const { return near_.size() + suns_.size() + (picture_ ? 1 : 0); }
    // One light, by what it may give to the receiver. None where none gives anything.
    std::optional<ChosenLight> choose(const Receiver &receiver, float u) const;
    // Probability that `choose` gives this light.
    float choice_probability(const Receiver &receiver, std::size_t light) const;
    // A light that no ray is to meet has the density kOnlyDirection.
    std::optional<LightRay> sample(std::size_t light, const glm::vec3 &from, glm::vec2 u) const;
    // The groups that a sampled ray of a light goes to, each with its share of the radiance:
    // several of a coloured environment.
    struct Parts {
        std::size_t count = 1;
        std::array<std::uint32_t, kMostEnvironmentGroups> group;
        std::array<float, kMostEnvironmentGroups> share{1};
    };
    Parts parts(std::size_t light, const glm::vec3 &to_light) const {
        return light == environment_light() && !further_groups_.empty()
                   ? environment_parts(to_light)
                   : Parts{.group = {traits_[light].group}};
    }
    bool throws_shadows(std::size_t light) const { return traits_[light].shadows; }

    // Calls `meet(LightMet)` for every light that the ray crosses nearer than `farthest`.
    template <class F>
    void meet(const glm::vec3 &from, const glm::vec3 &direction, float farthest, F &&meet) const {
        tree_.cross(from, direction, [&](std::size_t i) {
            std::visit(
                [&](const auto &light) {
                    const std::optional<float> distance = light.crossing(from, direction);
                    if (distance && *distance < farthest && traits_[i].shadows)
                        meet(LightMet{light.radiance(), traits_[i].group, i,
                                      light.pdf(from, direction, *distance)});
                },
                near_[i]);
            return false;
        });
        if (farthest == std::numeric_limits<float>::infinity())
            meet_distant(direction, meet);
    }
    // `meet` would find a light, were nothing in its way; environments do not count.
    bool crosses_light(const glm::vec3 &from, const glm::vec3 &direction) const {
        return tree_.cross(from, direction, [&](std::size_t i) {
            return std::visit(
                [&](const auto &light) { return light.crossing(from, direction).has_value(); },
                near_[i]);
        }) || meets_sun(direction);
    }
    bool has_environment() const { return environment_; }

    // What the camera sees of lights nearer than `farthest`: the nearest, which hides what is
    // behind it. Empty where it sees through all of them.
    std::optional<LightMet> seen(const glm::vec3 &from, const glm::vec3 &direction,
                                 float farthest) const {
        return any_seen_ ? nearest_seen(from, direction, farthest) : std::nullopt;
    }
    // Calls `see(LightMet)` for all that a camera ray meets that leaves the scene.
    template <class F> void see_distant(const glm::vec3 &direction, F &&see) const {
        meet_distant(direction, [&](const LightMet &met) {
            if (traits_[met.light].visible)
                see(met);
        });
    }

    // A light that blocks, other than `to`, is nearer than `farthest`.
    bool block(const glm::vec3 &from, const glm::vec3 &direction, float farthest,
               std::size_t to) const {
        return obstacles_ && is_blocked(from, direction, farthest, to);
    }
    // Ends a ray at the nearest light that blocks: `farthest` becomes just as far.
    // \return whether it did
    bool end_at_obstacle(const glm::vec3 &from, const glm::vec3 &direction, float &farthest) const {
        return obstacles_ && find_obstacle(from, direction, farthest);
    }

  private:
    using Near = std::variant<LightRectangle, LightDisk, LightSphere, LightPoint>;
    struct Traits {
        std::uint32_t group;
        bool visible, blocks, shadows;
    };
    void add(const Light &light, const glm::dvec3 &centre);
    void add_environment(const Environment &environment);
    // \param from_near irradiance in the middle of the scene
    void share_choices(double from_near);
    template <class F> void meet_distant(const glm::vec3 &direction, F &&meet) const {
        if (environment_)
            for (std::size_t c = 0; c <= further_groups_.size(); ++c)
                meet(meet_environment(direction, c));
        for (std::size_t s = 0; s < suns_.size(); ++s)
            if (const std::size_t i = near_.size() + s;
                suns_[s].is_met(direction) && traits_[i].shadows)
                meet(LightMet{suns_[s].radiance(), traits_[i].group, i, suns_[s].pdf()});
    }
    bool meets_sun(const glm::vec3 &direction) const {
        for (const LightSun &sun : suns_)
            if (sun.is_met(direction))
                return true;
        return false;
    }
    // \param channel of the picture
    std::optional<LightMet> nearest_seen(const glm::vec3 &from, const glm::vec3 &direction,
                                         float farthest) const;
    bool is_blocked(const glm::vec3 &from, const glm::vec3 &direction, float farthest,
                    std::size_t to) const;
    bool find_obstacle(const glm::vec3 &from, const glm::vec3 &direction, float &farthest) const;
    LightMet meet_environment(const glm::vec3 &direction, std::size_t channel) const;
    Parts environment_parts(const glm::vec3 &to_light) const;
    std::size_t environment_light() const { return near_.size() + suns_.size(); }
    std::optional<LightRay> sample_environment(glm::vec2 u) const;
    // The values of the picture's channels; null for an even environment.
    const float *environment_pixel(const glm::vec3 &direction) const;
    float environment_radiance(const glm::vec3 &direction) const; // of all groups
    float environment_pdf(const glm::vec3 &direction) const;
    glm::vec2 square_of(const glm::vec3 &direction) const;

    std::vector<Near> near_{};
    std::vector<LightSun> suns_{};
    std::vector<Traits> traits_{}; // of all lights
    LightTree tree_{};             // of those near
    // Probabilities of the suns and the pictured environment; the tree has the rest.
    std::vector<float> distant_choice_{};
    bool obstacles_ = false, any_seen_ = false;
    bool environment_ = false;
    double environment_irradiance_ = 0; // of a picture
    float environment_scale_ = 0, environment_turn_ = 0;
    std::vector<std::uint32_t> further_groups_{};
    const Image *picture_ = nullptr;
    Distribution2D environment_density_{};
};

} // namespace tsuya
