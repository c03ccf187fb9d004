#include "tsuya/sdk/light.h"

#include <cmath>
#include <span>
#include <vector>

#include "cone_falloff.h"
#include "profile_frame.h"

namespace tsuya {
namespace {

constexpr int kDiskCorners = 1024;
// Over its distance: a smaller disk is as a point.
constexpr double kSmallDisk = 1e-3;

template <class L> auto &emission(L &light) {
    if constexpr (requires { light.radiance; })
        return light.radiance;
    else if constexpr (requires { light.intensity; })
        return light.intensity;
    else
        return light.irradiance;
}

// Of radiance 1, by Lambert's formula for a polygon.
double of_polygon(std::span<const glm::dvec3> corners, const glm::dvec3 &point,
                  const glm::dvec3 &normal) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - point);
        const glm::dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - point);
        const glm::dvec3 across = glm::cross(a, b);
        const double sine = glm::length(across);
        if (sine > 0)
            sum += std::atan2(sine, glm::dot(a, b)) / sine * across;
    }
    return 0.5 * std::abs(glm::dot(sum, normal));
}

// \param away unit vector from the light
double intensity(const PointLight &l, const glm::dvec3 &away) {
    const double cosine = glm::dot(away, glm::normalize(l.direction));
    return l.intensity * cone_falloff(cosine, std::cos(l.full_angle), std::cos(l.cone_angle)) *
           (l.profile ? ProfileFrame(l).candela(*l.profile, away) : 1);
}

// By the midpoints of even steps, half a degree each.
double flux_of_profile(const PointLight &l) {
    constexpr int kVertical = 360, kHorizontal = 720;
    const ProfileFrame frame(l);
    double sum = 0;
    for (int i = 0; i < kVertical; ++i)
        for (int j = 0; j < kHorizontal; ++j) {
            const double theta = kPi * (i + 0.5) / kVertical, phi = 2 * kPi * j / kHorizontal;
            const glm::dvec3 away =
                std::cos(theta) * frame.axis +
                std::sin(theta) * (std::cos(phi) * frame.zero + std::sin(phi) * frame.quarter);
            sum += intensity(l, away) * std::sin(theta);
        }
    return sum * (kPi / kVertical) * (2 * kPi / kHorizontal);
}

struct Irradiance {
    const glm::dvec3 &point, &normal;

    double operator()(const RectangleLight &l) const {
        const glm::dvec3 corners[] = {l.corner, l.corner + l.edge_u, l.corner + l.edge_u + l.edge_v,
                                      l.corner + l.edge_v};
        return l.radiance * of_polygon(corners, point, normal);
    }
    double operator()(const DiskLight &l) const {
        const glm::dvec3 axis = glm::normalize(l.direction), to_light = l.centre - point;
        const double distance = glm::length(to_light);
        if (l.radius < kSmallDisk * distance)
            return l.radiance * kPi * l.radius * l.radius * std::abs(glm::dot(axis, to_light)) *
                   glm::dot(to_light, normal) / std::pow(distance, 4);
        // A polygon of the same area
        const glm::dvec3 aside = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 x = glm::normalize(glm::cross(axis, aside)), y = glm::cross(axis, x);
        constexpr double kStep = 2 * kPi / kDiskCorners;
        const double radius = l.radius * std::sqrt(kStep / std::sin(kStep));
        std::vector<glm::dvec3> corners;
        for (int i = 0; i < kDiskCorners; ++i)
            corners.push_back(l.centre +
                              radius * (std::cos(kStep * i) * x + std::sin(kStep * i) * y));
        return l.radiance * of_polygon(corners, point, normal);
    }
    double operator()(const SphereLight &l) const {
        const glm::dvec3 to_light = l.centre - point;
        return l.radiance * kPi * l.radius * l.radius * glm::dot(to_light, normal) /
               std::pow(glm::length(to_light), 3);
    }
    double operator()(const PointLight &l) const {
        const glm::dvec3 to_light = l.position - point;
        const double distance = glm::length(to_light);
        return intensity(l, -to_light / distance) * glm::dot(to_light, normal) /
               std::pow(distance, 3);
    }
    double operator()(const SunLight &l) const {
        return l.irradiance * glm::dot(glm::normalize(l.to_light), normal);
    }
};

struct Flux {
    double operator()(const RectangleLight &l) const {
        return kPi * l.radiance * glm::length(glm::cross(l.edge_u, l.edge_v));
    }
    double operator()(const DiskLight &l) const {
        return kPi * l.radiance * kPi * l.radius * l.radius;
    }
    double operator()(const SphereLight &l) const {
        return kPi * l.radiance * 4 * kPi * l.radius * l.radius;
    }
    double operator()(const PointLight &l) const {
        if (l.profile)
            return flux_of_profile(l);
        const double cos_full = std::cos(l.full_angle), cos_cone = std::cos(l.cone_angle);
        return 2 * kPi * l.intensity * ((1 - cos_full) + 0.5 * (cos_full - cos_cone));
    }
    double operator()(const SunLight &) const { return 0; }
};

} // namespace

double &emission_of(Light &light) {
    return std::visit([](auto &l) -> double & { return emission(l); }, light);
}

double emission_of(const Light &light) {
    return std::visit([](const auto &l) { return emission(l); }, light);
}

std::optional<LightPlace> place_of(const Light &light) {
    struct Place {
        std::optional<LightPlace> operator()(const RectangleLight &l) const {
            return LightPlace{
                l.corner + 0.5 * (l.edge_u + l.edge_v),
                0.5 * std::max(glm::length(l.edge_u + l.edge_v), glm::length(l.edge_u - l.edge_v))};
        }
        std::optional<LightPlace> operator()(const DiskLight &l) const {
            return LightPlace{l.centre, l.radius};
        }
        std::optional<LightPlace> operator()(const SphereLight &l) const {
            return LightPlace{l.centre, l.radius};
        }
        std::optional<LightPlace> operator()(const PointLight &l) const {
            return LightPlace{l.position, 0};
        }
        std::optional<LightPlace> operator()(const SunLight &) const { return std::nullopt; }
    };
    return std::visit(Place{}, light);
}

double irradiance(const Light &light, const glm::dvec3 &point, const glm::dvec3 &normal) {
    return std::visit(Irradiance{point, normal}, light);
}

double flux(const Light &light) { return std::visit(Flux{}, light); }

} // namespace tsuya
