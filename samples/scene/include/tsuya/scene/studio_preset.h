#pragma once
/// \file
/// Whole studios by name: lights in groups, each with a lamp of its own, and a backdrop.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/scene/studio.h"
#include "tsuya/sdk/scene.h"

namespace tsuya::scene {

/// The studio that a try-on has where none is named.
inline constexpr const char *kDefaultStudio = "portrait";

/// What a studio is built around.
struct Subject {
    glm::dvec3 lower{0, 0, 0}, upper{0, 1.6, 0}; ///< bounds, metres
    double azimuth = 0;                          ///< of the camera, see Framing
};

/// A light group of a studio.
struct StudioGroup {
    std::string name{};
    std::string lamp{}; ///< that fits it, see lamp_names
};

/// Lights about a subject. Groups of the lights are indices into `groups`.
struct Studio {
    std::vector<StudioGroup> groups{};
    std::vector<Light> lights{};
    std::optional<Environment> environment{};
    Cyclorama backdrop{};
    double backdrop_reflectance = 0.2;
};

/// Names that `make_studio` knows: portrait, softbox, shop, home, daylight, gallery, lab.
std::vector<std::string> studio_names();

/// One line about a studio: what it is, and its groups with their lamps. Throws Error at `studio`
/// for an unknown name, with the known ones and the nearest.
std::string studio_description(std::string_view name);

/// A studio in the size of the subject: as for a dress form of 1.6 m, with everything in
/// proportion. Throws Error as studio_description.
Studio make_studio(std::string_view name, const Subject &subject);

} // namespace tsuya::scene
