#include "studio_stage.h"

#include <algorithm>
#include <limits>

namespace tsuya::scene {
namespace {

Subject subject_of(const std::vector<glm::dvec3> &points, double azimuth) {
    Subject subject{.lower = glm::dvec3(std::numeric_limits<double>::max()),
                    .upper = glm::dvec3(-std::numeric_limits<double>::max()),
                    .azimuth = azimuth};
    for (const glm::dvec3 &p : points) {
        subject.lower = glm::min(subject.lower, p);
        subject.upper = glm::max(subject.upper, p);
    }
    return subject;
}

// The number of groups where there is none of the name.
std::size_t index_of_group(const Scene &scene, const std::string &name) {
    return static_cast<std::size_t>(std::ranges::find(scene.light_groups, name) -
                                    scene.light_groups.begin());
}

} // namespace

std::vector<StudioGroup> lit_groups(const Studio &studio, bool environment) {
    std::vector<bool> lit(studio.groups.size(), false);
    for (const Light &light : studio.lights)
        std::visit([&](const auto &l) { lit[l.group.value] = true; }, light);
    if (environment && studio.environment)
        lit[studio.environment->group.value] = true;
    std::vector<StudioGroup> groups;
    for (std::size_t g = 0; g < lit.size(); ++g)
        if (lit[g])
            groups.push_back(studio.groups[g]);
    return groups;
}

void add_studio_to(Scene &scene, std::vector<std::string> &own_lamps, const std::string &name,
                   const std::vector<glm::dvec3> &points, double azimuth, bool backdrop) {
    Studio studio = make_studio(name, subject_of(points, azimuth));
    const bool takes_environment = studio.environment && !scene.environment;
    own_lamps.resize(scene.light_groups.size());
    for (const StudioGroup &group : lit_groups(studio, takes_environment)) {
        const std::size_t index = index_of_group(scene, group.name);
        if (index == scene.light_groups.size()) {
            scene.light_groups.push_back(group.name);
            own_lamps.emplace_back();
        }
        if (own_lamps[index].empty())
            own_lamps[index] = group.lamp;
    }
    const auto in_scene = [&](LightGroupIndex group) -> LightGroupIndex {
        return {static_cast<std::uint32_t>(index_of_group(scene, studio.groups[group.value].name))};
    };
    for (Light &light : studio.lights) {
        std::visit([&](auto &l) { l.group = in_scene(l.group); }, light);
        scene.lights.push_back(std::move(light));
    }
    if (takes_environment) {
        studio.environment->group = in_scene(studio.environment->group);
        scene.environment = std::move(studio.environment);
    }
    if (!backdrop)
        return;
    const auto surface = static_cast<std::uint32_t>(scene.surfaces.size());
    const auto fabric = static_cast<std::uint32_t>(scene.fabrics.size());
    scene.surfaces.push_back(make_cyclorama(studio.backdrop));
    scene.fabrics.push_back(
        {.name = "backdrop", .colours = {.dye = Spectrum::constant(studio.backdrop_reflectance)}});
    scene.objects.push_back({"backdrop", {surface}, {fabric}});
}

} // namespace tsuya::scene
