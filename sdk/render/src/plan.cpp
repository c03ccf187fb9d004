#include "tsuya/sdk/plan.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "aov.h"
#include "dye_channels.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/near_yarn.h"
#include "tsuya/sdk/render.h"

namespace tsuya {
namespace {

std::string name_in(const Scene &scene, std::size_t light) {
    const std::string &name = name_of(scene.lights[light]);
    return name.empty() ? "lights[" + std::to_string(light) + "]" : "'" + name + "'";
}

// The light is seen, or what it hides, though it be dark.
bool is_thing(const Light &light) {
    return std::visit(
        [](const auto &l) {
            if constexpr (requires { l.behaviour; })
                return l.behaviour.visible || l.behaviour.blocks;
            else
                return false;
        },
        light);
}

// Where a pixel sees two repeats: from there on a weave is seen from far alone.
double near_within(const WeaveMap &map, const Camera &camera) {
    const double footprint = kFarFromRepeats * std::min(map.repeat.x, map.repeat.y);
    if (camera.orthographic_height)
        return *camera.orthographic_height / camera.height < footprint
                   ? std::numeric_limits<double>::infinity()
                   : 0;
    return footprint * camera.height / (2 * std::tan(0.5 * camera.vertical_angle));
}

} // namespace

Plan plan(const Scene &scene, const RenderSettings &settings) {
    Plan p{.channels = settings.channels};
    if (!scene.open_dyes.empty()) {
        p.dyes = dye_variables(scene);
        if (!p.dyes.empty())
            p.channels = depth_channels(p.dyes);
    }
    const auto skip = [&](bool idle, std::string what, std::string saves) {
        if (idle && settings.skip)
            p.skips.push_back({std::move(what), std::move(saves)});
        return idle && settings.skip;
    };
    const std::vector<bool> used = fabrics_in_use(scene);
    for (std::size_t i = 0; i < scene.fabrics.size(); ++i) {
        const Fabric &fabric = scene.fabrics[i];
        if (skip(!used[i], "fabric '" + fabric.name + "' dresses nothing", "its tables"))
            continue;
        const bool specular = has_specular(fabric);
        const bool transmits = fabric.colours.transmittance.any_above_zero();
        const bool is_open = std::any_of(scene.open_dyes.begin(), scene.open_dyes.end(),
                                         [&](FabricIndex open) { return open.value == i; });
        const bool diffuse = fabric.colours.any_dye() || is_open || transmits;
        skip(!specular, "no specular part in fabric '" + fabric.name + "'",
             "its evaluation at every point");
        skip(!diffuse, "no dye in fabric '" + fabric.name + "'", "the diffuse part at every point");
        skip(!transmits, "no transmittance of fabric '" + fabric.name + "'",
             "shadow rays to lights behind it");
        if (specular && fabric.weave && fabric.weave->has_map())
            p.near_cloths.push_back({fabric.name, near_within(fabric.weave->map, scene.camera)});
        p.any_specular |= specular;
        p.any_diffuse |= diffuse;
    }

    const bool scatters = p.any_specular || p.any_diffuse;
    p.max_bounces = settings.max_bounces;
    if (settings.max_bounces > 0 &&
        skip(!scatters, "nothing scatters light", "all bounces and shadow rays"))
        p.max_bounces = 0;
    p.widens = settings.widen_after_diffuse && p.max_bounces > 0;
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (!skip(emission_of(scene.lights[i]) == 0 && !is_thing(scene.lights[i]),
                  "the light " + name_in(scene, i) + " is dark", "its shadow rays"))
            p.lights.push_back(i);
    p.environment = scene.environment && !skip(scene.environment->radiance == 0,
                                               "the environment is dark", "its sampling");
    skip(!scene.environment, "there is no environment", "its sampling");
    skip(scene.environment && scene.environment->radiance > 0 && !scene.environment->picture,
         "the environment is even", "its shadow rays: the surface's own sampling meets it");
    // With holes, a ray to the environment looks for what it meets
    p.short_last_rays = skip(
        !p.environment || scene.opacities.empty(), "what a path's last ray meets beside lights",
        p.environment ? "finding the nearest hit" : "tracing it where it points at no light");
    skip(scene.opacities.empty(), "no cloth has holes", "looking for them along every ray");
    p.lights_seen = !settings.alpha;
    skip(settings.aovs.empty(), "no AOVs were asked for", "their memory and writing");
    skip(!settings.aovs.empty() && !asks_for(settings, is_part_of_light),
         "no parts of the light were asked for", "telling them apart in every sample");
    skip(!settings.alpha, "no alpha was asked for", "its memory and writing");
    return p;
}

namespace {

std::string channels_text(const Plan &p) {
    std::string text = "channels: " + std::to_string(p.channels);
    if (p.dyes.empty())
        return text + " over wavelengths\n";
    text += " depths of";
    for (std::size_t i = 0; i < p.dyes.size(); ++i)
        text += std::string(i > 0 ? " and" : "") + (p.dyes[i].open ? " the open dye '" : " '") +
                p.dyes[i].name + "'";
    return text + ": every dye and lamp afterwards\n";
}

std::string near_text(const NearCloth &cloth) {
    if (!(cloth.within > 0))
        return "weave: '" + cloth.fabric + "' is seen from far alone\n";
    if (std::isinf(cloth.within))
        return "weave: the yarns of '" + cloth.fabric + "' appear\n";
    std::ostringstream text;
    text << "weave: the yarns of '" << cloth.fabric << "' appear nearer than "
         << std::setprecision(2) << cloth.within << " m\n";
    return text.str();
}

} // namespace

std::string explain(const Plan &p) {
    std::string text = channels_text(p) + "bounces: up to " + std::to_string(p.max_bounces) + "\n";
    text += "lights: " + detail::counted(p.lights.size(), "light") +
            (p.environment ? ", environment" : "") + "\n";
    text += std::string("parts:") + (p.any_diffuse ? " diffuse" : "") +
            (p.any_specular ? " specular" : "") + "\n";
    for (const NearCloth &cloth : p.near_cloths)
        text += near_text(cloth);
    if (p.widens)
        text += "lobes: wider after diffuse scattering\n";
    for (const Skip &s : p.skips)
        text += "skipped: " + s.what + "; saves " + s.saves + "\n";
    return text;
}

} // namespace tsuya
