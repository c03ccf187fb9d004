#pragma once
/// \file
/// What a scene needs, found before it is rendered. Skipping may not change the picture.

#include <optional>
#include <string>
#include <vector>

#include "tsuya/sdk/dye_depths.h"
#include "tsuya/sdk/scene.h"

namespace tsuya {

struct RenderSettings;

/// Something that a render leaves out.
struct Skip {
    std::string what;
    std::string saves;
};

/// A cloth whose yarns the camera may tell apart.
struct NearCloth {
    std::string fabric;
    double within = 0; ///< metres from the camera; infinite or 0 for parallel rays
};

/// The cheapest exact way through a scene.
struct Plan {
    int max_bounces = 0;      ///< 0 where no surface scatters light on
    bool environment = false; ///< an environment shines
    bool lights_seen = false; ///< the camera sees those that are visible
    bool any_specular = false;
    bool any_diffuse = false;
    bool widens = false;          ///< bounces meet wider lobes, see RenderSettings
    bool short_last_rays = false; ///< the ray after a path's last vertex looks for lights alone
    std::vector<std::size_t> lights{}; ///< into Scene::lights: those that shine or are things
    std::vector<NearCloth> near_cloths{};
    std::vector<Skip> skips{};
    int channels = 0; ///< of the render; RenderSettings::channels but for depths of dye
    /// The dyes whose depths are the channels; none: channels are wavelengths. Where a range ends
    /// at the most that a cloth can show, highest is 1 here.
    std::vector<DyeVariable> dyes{};
};

/// The colours of a scene that vary with the wavelength, if their depths can be the channels of its
/// render: at most kMostDyes of them, in fabrics without coloured prints. The dyes of fabrics in
/// `open_dyes` are open and have the whole range, others that of their values. Throws Error with
/// the reason where they cannot.
std::vector<DyeVariable> dye_variables(const Scene &scene);

/// Finds what the scene and the settings do not need. The picture is the same with and without it.
Plan plan(const Scene &scene, const RenderSettings &settings);

/// The plan as lines of text.
std::string explain(const Plan &plan);

} // namespace tsuya
