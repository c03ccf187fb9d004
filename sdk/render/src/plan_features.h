#pragma once
// The features that a plan tells of, and what they cost.

#include <array>
#include <cstddef>
#include <string_view>

namespace tsuya {

enum class FeatureId : std::size_t {
    dye_depths,
    bounces,
    last_rays,
    wider_lobes,
    specular,
    diffuse,
    transmittance,
    idle_tables,
    own_tables,
    weave,
    dark_lights,
    far_lights,
    light_choice,
    lights_seen,
    environment,
    environment_rays,
    prints,
    holes,
    lens,
    aovs,
    light_parts,
    alpha,
    denoiser
};

// In the order of FeatureId.
inline constexpr std::array<std::string_view, 23> kFeatureNames = {
    "depths of dye",
    "bounces",
    "whole last rays",
    "wider lobes",
    "specular part",
    "diffuse part",
    "transmittance",
    "tables of idle fabrics",
    "tables for each fabric",
    "weave",
    "dark lights",
    "lights out of reach",
    "choice among lights",
    "visible lights",
    "environment",
    "environment sampling",
    "prints",
    "holes",
    "lens",
    "AOVs",
    "parts of the light",
    "alpha",
    "denoiser",
};

constexpr std::string_view name_of(FeatureId id) {
    return kFeatureNames[static_cast<std::size_t>(id)];
}

// Shares of the time that a sample takes with the feature, and what tables take: medians of
// `tests/bench/run skips`, see sdk/docs/render_speed/skips.csv.
namespace cost {

// Of what was measured, shares below are noise: none is told.
inline constexpr double kLeastShare = 0.05;

inline constexpr double kWholeLastRay = 0.18;        // of direct light, no environment
inline constexpr double kDarkLight = 0.1;            // beside another
inline constexpr double kEnvironmentSampling = 0.36; // beside a lamp
inline constexpr double kHoles = 0.11;
inline constexpr double kPrints = 0.19;
inline constexpr double kAovs = 0.17;
inline constexpr double kLightParts = 0.12;
inline constexpr double kAlpha = 0.05;
inline constexpr double kWiderLobes = 0.08;
// Of one fabric's own
inline constexpr double kTableSeconds = 0.6, kTableBytes = 1e6;

} // namespace cost
} // namespace tsuya
