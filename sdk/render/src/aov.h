#pragma once
// What a render can keep beside the transport, by name.

#include <string>
#include <vector>

#include "tsuya/sdk/render.h"

namespace tsuya {

enum class Aov {
    coverage,
    garment,
    depth,
    normal,
    warp,
    weft,
    uv,
    albedo,
    direct,
    indirect,
    surface,
    body,
    samples,
    error,
    object_ids,
    fabric_ids,
    panel_ids
};

// Of the names in the settings, all of which are known.
std::vector<Aov> aovs_of(const RenderSettings &settings);

// Names of its channels. \param channels of the render
std::vector<std::string> channels_of(Aov aov, const Scene &scene, int channels);

// It is summed up from what the camera sees.
bool is_of_first_hit(Aov aov);
// It is a part of the transport.
bool is_part_of_light(Aov aov);
bool is_ids(Aov aov);
bool asks_for(const RenderSettings &settings, bool (*kind)(Aov));

// What the ids of an AOV stand for, in the order of FirstHit's indices: an object's panels stand
// one after the other, see first_panels.
std::vector<std::string> id_names(Aov aov, const Scene &scene);
// Index of the first panel of each object among all panels.
std::vector<std::uint32_t> first_panels(const Scene &scene);

} // namespace tsuya
