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

} // namespace

void add_studio_to(Scene &scene, std::vector<std::string> &own_lamps, const std::string &name,
                   const std::vector<glm::dvec3> &points, double azimuth, bool backdrop) {
    Studio studio = make_studio(name, subject_of(points, azimuth));
    std::vector<LightGroupIndex> group_of;
    own_lamps.resize(scene.light_groups.size());
    for (const StudioGroup &group : studio.groups) {
        const auto found =
            std::find(scene.light_groups.begin(), scene.light_groups.end(), group.name);
        const auto index = static_cast<std::size_t>(found - scene.light_groups.begin());
        if (found == scene.light_groups.end()) {
            scene.light_groups.push_back(group.name);
            own_lamps.emplace_back();
        }
        if (own_lamps[index].empty())
            own_lamps[index] = group.lamp;
        group_of.push_back({static_cast<std::uint32_t>(index)});
    }
    for (Light &light : studio.lights) {
        std::visit([&](auto &l) { l.group = group_of[l.group.value]; }, light);
        scene.lights.push_back(std::move(light));
    }
    if (studio.environment && !scene.environment) {
        studio.environment->group = group_of[studio.environment->group.value];
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
