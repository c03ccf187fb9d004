#pragma once
/// \file
/// Lights of a scene, and what they give to a point.
///
/// All are relative to the lamp of their group. The unit is that of the transport T: a perfect
/// white diffuser that receives irradiance pi has T = 1. So radiance 1 is what that diffuser
/// reflects, a light of intensity pi gives T = 1 at a distance of one metre, and where T = 1 stands
/// for `white_lux` lux, each photometric value is pi / white_lux times itself in these units: cd/m2
/// as radiance, cd as intensity, lx as irradiance, lm as flux.

#include <optional>
#include <string>
#include <variant>

#include <glm/glm.hpp>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/intensity_profile.h"
#include "tsuya/sdk/scene_index.h"

namespace tsuya {

/// Bounds within which sums of float products stay finite: over 65536 samples, with responses of
/// up to 10^4 /sr and the squares that errors are estimated from. Also of intensity and irradiance.
inline constexpr double kLargestRadiance = 1e12;
inline constexpr double kSmallestLight = 1e-14; ///< area of a light, square metres
/// Radians. A sun of a smaller angular radius is parallel: float directions do not tell it apart.
inline constexpr double kSmallestSun = 1e-4;

/// What a light is beside its light.
struct LightBehaviour {
    /// The camera sees the side that shines, and not what is behind it.
    bool visible = false;
    /// It is an obstacle: it absorbs what arrives from other lights, from either side. The camera
    /// sees this only where the light is visible.
    bool blocks = false;
    /// Things throw shadows in it. Without, its light goes through everything.
    bool shadows = true;
};

/// A rectangle that shines to the side of cross(edge_u, edge_v).
struct RectangleLight {
    std::string name{}; ///< for messages
    glm::dvec3 corner{0, 2, 2};
    glm::dvec3 edge_u{1, 0, 0}, edge_v{0, 1, 0}; ///< metres
    double radiance = 1.0;                       ///< 0 to kLargestRadiance
    LightGroupIndex group{};
    LightBehaviour behaviour{};
};

/// A disk that shines to one side. Its area is kSmallestLight at least: a smaller one is a
/// PointLight.
struct DiskLight {
    std::string name{}; ///< for messages
    glm::dvec3 centre{0, 2, 2};
    glm::dvec3 direction{0, 0, -1}; ///< where it faces; any length above 0
    double radius = 0.5;            ///< metres
    double radiance = 1.0;          ///< 0 to kLargestRadiance
    LightGroupIndex group{};
    LightBehaviour behaviour{};
};

/// A sphere that shines outwards. Its cross section is kSmallestLight at least: a smaller one is a
/// PointLight.
struct SphereLight {
    std::string name{}; ///< for messages
    glm::dvec3 centre{0, 2, 2};
    double radius = 0.1;   ///< metres
    double radiance = 1.0; ///< 0 to kLargestRadiance
    LightGroupIndex group{};
    LightBehaviour behaviour{};
};

/// A light at a point: to all sides, within a cone, or as a luminaire was measured. Nothing but its
/// light can be seen of it.
struct PointLight {
    std::string name{}; ///< for messages
    glm::dvec3 position{0, 2, 2};
    double intensity = 1.0;         ///< along the axis of the cone; 0 to kLargestRadiance
    glm::dvec3 direction{0, -1, 0}; ///< axis of cone and profile; any length above 0
    /// Angles from the axis, radians: up to `full_angle` the intensity is the axis's, at
    /// `cone_angle` and beyond it is 0. 0 <= full_angle <= cone_angle, 0 < cone_angle <= pi; where
    /// cone_angle is pi and full_angle as well, the light is the same to all sides.
    double full_angle = kPi, cone_angle = kPi;
    LightGroupIndex group{};
    bool shadows = true; ///< see LightBehaviour
    /// Its candelas are factors of `intensity`; the product is kLargestRadiance at most.
    std::optional<IntensityProfile> profile{};
    /// Where the profile's horizontal angle is 0, as far as it is perpendicular to the axis; any
    /// length above 0. The angle grows counter-clockwise seen against the axis: from above, of a
    /// luminaire that shines down.
    glm::dvec3 zero_plane{0, 0, 1};
};

/// Light from a direction, infinitely far: the sun.
struct SunLight {
    std::string name{};               ///< for messages
    glm::dvec3 to_light{0, 1, 0};     ///< any length above 0
    double angular_radius = 0.004652; ///< radians, 0 (parallel light) to pi / 2
    double irradiance = 1.0;          ///< of a plane that faces it; 0 to kLargestRadiance
    LightGroupIndex group{};
    bool visible = false; ///< to the camera directly, where it is no parallel light
    bool shadows = true;  ///< see LightBehaviour
};

/// One of the kinds of light. The environment is described by itself.
using Light = std::variant<RectangleLight, DiskLight, SphereLight, PointLight, SunLight>;

/// The name of any kind of light.
inline const std::string &name_of(const Light &light) {
    return std::visit([](const auto &l) -> const std::string & { return l.name; }, light);
}

/// The value that scales a light: its radiance, intensity or irradiance.
double &emission_of(Light &light);
/// The same, to be read.
double emission_of(const Light &light);

/// A sphere around a light.
struct LightPlace {
    glm::dvec3 centre{0, 0, 0};
    double radius = 0;
};
/// Where a light is; empty for a sun.
std::optional<LightPlace> place_of(const Light &light);

/// Irradiance that a light gives to a small plane, were nothing in its way. The whole light has to
/// lie above the plane, and the plane on the side to which the light shines; a sphere of a radius
/// above 0 has to be farther away than its radius.
double irradiance(const Light &light, const glm::dvec3 &point, const glm::dvec3 &normal);

/// What a light emits to all sides. 0 of a sun, which has no end.
double flux(const Light &light);

} // namespace tsuya
