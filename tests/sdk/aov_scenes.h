#pragma once
// What tests of AOVs and alpha share.

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"

namespace tsuya::test {

inline const Image &aov_of(const SpectralImage &image, const std::string &name) {
    for (std::size_t i = 0; i < image.aovs.size(); ++i)
        if (image.aov_names[i] == name)
            return image.aovs[i];
    ADD_FAILURE() << "no AOV " << name;
    static const Image none;
    return none;
}

inline SpectralImage rendered(const Scene &scene, RenderSettings settings,
                              std::vector<std::string> aovs) {
    settings.aovs = std::move(aovs);
    return render(scene, settings).image;
}

// Light through cloth that the camera sees through, too.
inline Scene lace() {
    Scene scene = folded_satin(24, 24);
    scene.surfaces[0].uv.assign(scene.surfaces[0].position.size(), {0, 0});
    for (std::size_t v = 0; v < scene.surfaces[0].uv.size(); ++v)
        scene.surfaces[0].uv[v] = glm::vec2(scene.surfaces[0].position[v]);
    scene.textures = {{.width = 2, .height = 2, .channels = 1, .data = {255, 100, 30, 255}}};
    scene.opacities = {{.picture = {0}, .placement = {.width = 0.3}}};
    scene.objects[0].opacity = OpacityIndex{0};
    return scene;
}

} // namespace tsuya::test
