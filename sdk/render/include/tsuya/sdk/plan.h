#pragma once
/// \file
/// What a scene needs, found before it is rendered. Skipping may not change the picture.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tsuya/sdk/dye_depths.h"
#include "tsuya/sdk/scene.h"

namespace tsuya {

struct RenderSettings;

/// What it saves to leave something out. Time is an estimate, from scenes on which it was measured
/// (tests/bench/run skips); bytes are counted.
struct Saving {
    double of_sample = 0; ///< share of the time that a sample takes with it: 0.05 to 1, or 0
    double seconds = 0;   ///< of a processor, once a render
    double bytes = 0;     ///< of memory
};

/// A cloth whose yarns the camera may tell apart.
struct NearCloth {
    std::string fabric;
    double within = 0; ///< metres from the camera; infinite or 0 for parallel rays
};

/// Something that renders do, or leave out where a scene does not need it.
struct Feature {
    std::string name{}; ///< one of feature_names
    bool on = true;
    std::string why{};             ///< it is on, or off
    std::optional<Saving> saves{}; ///< of what is off; empty where there was nothing to save
};

/// The names of all features, in the order of Plan::features.
std::vector<std::string> feature_names();

/// The cheapest exact way through a scene.
struct Plan {
    int max_bounces = 0;      ///< 0 where no surface scatters light on
    bool environment = false; ///< an environment shines
    bool lights_seen = false; ///< the camera sees those that are visible
    bool any_specular = false;
    bool any_diffuse = false;
    bool widens = false;           ///< bounces meet wider lobes, see RenderSettings
    bool short_last_rays = false;  ///< the ray after a path's last vertex looks for lights alone
    bool keeps_idle_parts = false; ///< parts of fabrics whose weight is 0 are evaluated
    std::vector<std::size_t> lights{}; ///< into Scene::lights: those that shine or are things
    std::vector<NearCloth> near_cloths{};
    std::vector<bool> fabrics{}; ///< of Scene::fabrics, those whose materials are made
    std::vector<Feature> features{};
    int channels = 0; ///< of the render; RenderSettings::channels but for depths of dye
    /// The dyes whose depths are the channels; none: channels are wavelengths. Where a range ends
    /// at the most that a cloth can show, highest is 1 here.
    std::vector<DyeVariable> dyes{};

    /// Of this name. Throws std::out_of_range for one that is not among feature_names.
    const Feature &feature(std::string_view name) const;
};

/// The colours of a scene that vary with the wavelength, if their depths can be the channels of its
/// render: at most kMostDyes of them, in fabrics without coloured prints. The dyes of fabrics in
/// `open_dyes` are open and have the whole range, others that of their values. Throws Error with
/// the reason where they cannot.
std::vector<DyeVariable> dye_variables(const Scene &scene);

/// Finds what the scene and the settings do not need. The picture is the same with and without it.
Plan plan(const Scene &scene, const RenderSettings &settings);

/// The plan as lines of text: what the render has, then each feature, whether it is on, why, and
/// what it saves that it is off.
std::string explain(const Plan &plan);

/// Such as "about 12 % of a sample, 1.50 MB"; empty for nothing.
std::string text_of(const Saving &saving);

} // namespace tsuya
