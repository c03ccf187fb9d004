#include "tsuya/sdk/render.h"

#include <cstdio>

int main() {
    tsuya::Surface sheet{.position = {{-1, 0, 0}, {1, 0, 0}, {1, 2, 0}, {-1, 2, 0}},
                         .normal = std::vector<glm::vec3>(4, {0, 0, 1}),
                         .triangle = {{0, 1, 2}, {0, 2, 3}}};
    tsuya::Scene scene{
        .surfaces = {sheet},
        .fabrics = {{.name = "white", .colours = {.dye = tsuya::Spectrum::constant(0.8)}}},
        .objects = {{.name = "sheet"}},
        .environment = tsuya::Environment{},
        .camera = {.width = 8, .height = 8}};
    const tsuya::RenderResult result =
        tsuya::render(scene, {.stop = {.samples_per_pixel = 4}, .channels = 8});
    const float seen = result.image.pixel(0, 4, 4)[0];
    std::printf("%.3f of the light\n", static_cast<double>(seen));
    return seen > 0.79f && seen < 0.81f ? 0 : 1;
}
