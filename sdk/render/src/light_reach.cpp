#include "light_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace tsuya {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// By which share of their distances corners may seem to lie on the other side by rounding.
constexpr double kRounding = 1e-5;
// Half a unit in the last place of a float number of which so much is a share.
constexpr double kLostInRounding = 3e-8;

std::array<glm::dvec3, 8> corners_of(const SceneBox &box) {
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i] = {i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                      i & 4 ? box.high.z : box.low.z};
    return corners;
}

// Distance of a point from a box; 0 inside.
double distance_to(const SceneBox &box, const glm::dvec3 &point) {
    return glm::length(glm::max(glm::max(box.low - point, point - box.high), glm::dvec3(0)));
}

// How far corners lie in front of a plane, as a share of how far they lie from a point of it.
struct Fronts {
    double least = 1, most = -1;
};

struct Reach {
    const SceneBox &box;
    const Light &light;
    LightPlace place{};

    // \param intensity at most, to any side
    // \param radiance at most
    double most(double intensity, double radiance) const {
        const double distance = distance_to(box, place.centre) - place.radius;
        return distance > 0 ? std::min(intensity / (distance * distance), kPi * radiance)
                            : kPi * radiance;
    }
    double farthest() const {
        double farthest = 0;
        for (const glm::dvec3 &corner : corners_of(box))
            farthest = std::max(farthest, glm::length(place.centre - corner));
        return farthest;
    }
    // Of what shines in proportion to 1 over the square of the distance from its middle: the least
    // intensity is at a corner, and the largest distance.
    double least_of_round() const {
        double intensity = kInfinity;
        for (const glm::dvec3 &corner : corners_of(box)) {
            const glm::dvec3 to_light = place.centre - corner;
            const double distance = glm::length(to_light);
            if (!(distance > place.radius))
                return 0;
            intensity = std::min(intensity, distance * distance *
                                                irradiance(light, corner, to_light / distance));
        }
        return intensity / (farthest() * farthest());
    }
    Fronts fronts(const glm::dvec3 &normal) const {
        Fronts fronts;
        for (const glm::dvec3 &corner : corners_of(box)) {
            const glm::dvec3 away = corner - place.centre;
            const double front = glm::dot(normal, away) / std::max(glm::length(away), place.radius);
            fronts.least = std::min(fronts.least, front);
            fronts.most = std::max(fronts.most, front);
        }
        return fronts;
    }
    // Of a light that shines to one side.
    LightReach flat(const glm::dvec3 &normal, double area, double radiance) const {
        const auto [in_front, most_in_front] = fronts(normal);
        if (most_in_front < -kRounding)
            return {};
        LightReach reach{.most = most(area * radiance, radiance)};
        const double nearest = distance_to(box, place.centre);
        if (in_front > kRounding && nearest > place.radius) {
            // Every part of the light is so much farther and lower at most
            const double sine = place.radius / nearest, distance = farthest() + place.radius;
            reach.least = area * radiance * in_front * (nearest / (nearest + place.radius)) *
                          std::sqrt(1 - sine * sine) / (distance * distance);
        }
        return reach;
    }

    LightReach operator()(const RectangleLight &l) const {
        const glm::dvec3 across = glm::cross(l.edge_u, l.edge_v);
        const double area = glm::length(across);
        return flat(across / area, area, l.radiance);
    }
    LightReach operator()(const DiskLight &l) const {
        return flat(glm::normalize(l.direction), kPi * l.radius * l.radius, l.radiance);
    }
    LightReach operator()(const SphereLight &l) const {
        return {least_of_round(), most(kPi * l.radius * l.radius * l.radiance, l.radiance)};
    }
    LightReach operator()(const PointLight &l) const {
        if (misses(l))
            return {};
        // A profile may be dark anywhere
        return {l.profile ? 0 : least_of_round(),
                most(l.intensity * (l.profile ? l.profile->highest() : 1), kInfinity)};
    }
    LightReach operator()(const SunLight &l) const { return {l.irradiance, l.irradiance}; }

    // The sphere around the box lies outside of the light's cone.
    bool misses(const PointLight &l) const {
        const glm::dvec3 away = 0.5 * (box.low + box.high) - l.position;
        const double radius = 0.5 * glm::length(box.high - box.low), distance = glm::length(away);
        if (!(distance > radius))
            return false;
        const double cosine = glm::dot(away, glm::normalize(l.direction)) / distance;
        const double nearest =
            std::acos(std::clamp(cosine, -1.0, 1.0)) - std::asin(radius / distance);
        const double reaches =
            l.profile ? std::min(l.cone_angle, l.profile->last_angle()) : l.cone_angle;
        return nearest > reaches + kRounding;
    }
};

} // namespace

SceneBox box_of(const Scene &scene) {
    SceneBox box{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
    for (const Object &object : scene.objects)
        for (const glm::dvec3 &p : scene.surfaces[object.surface.value].position) {
            box.low = glm::min(box.low, p);
            box.high = glm::max(box.high, p);
        }
    return box;
}

std::vector<std::string> out_of_reach(const Scene &scene) {
    std::vector<std::string> why(scene.lights.size());
    if (scene.lights.empty())
        return why;
    const SceneBox box = box_of(scene);
    std::vector<LightReach> reach;
    // Of each group what the light gives that gives most everywhere
    std::vector<double> brightest(scene.light_groups.size(), 0);
    const auto group = [&](std::size_t i) {
        return std::visit([](const auto &l) { return l.group.value; }, scene.lights[i]);
    };
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        reach.push_back(reach_of(scene.lights[i], box));
        brightest[group(i)] = std::max(brightest[group(i)], reach[i].least);
    }
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        if (emission_of(scene.lights[i]) == 0)
            continue;
        std::ostringstream text;
        if (reach[i].most == 0)
            text << "shines past all surfaces";
        else if (reach[i].most < kLostInRounding * brightest[group(i)])
            text << "gives at most " << std::setprecision(1) << reach[i].most / brightest[group(i)]
                 << " of what another light of its group gives everywhere";
        why[i] = text.str();
    }
    return why;
}

LightReach reach_of(const Light &light, const SceneBox &box) {
    return std::visit(Reach{box, light, place_of(light).value_or(LightPlace{})}, light);
}

} // namespace tsuya
