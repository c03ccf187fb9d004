#include "bench/skirt.h"

#include <cmath>
#include <numbers>

namespace tsuya::bench {
namespace {

// Warp down the skirt, weft around it.
Surface pleated_cone(unsigned around, unsigned down) {
    Surface s;
    const auto at = [&](double turn, double drop) {
        const double angle = 2 * std::numbers::pi * turn;
        const double radius = (0.15 + 0.35 * drop) * (1 + 0.12 * drop * std::cos(24 * angle));
        return glm::dvec3(radius * std::sin(angle), 0.8 - 0.75 * drop, radius * std::cos(angle));
    };
    constexpr double kStep = 1e-4;
    for (unsigned j = 0; j <= down; ++j)
        for (unsigned i = 0; i < around; ++i) {
            const double turn = double(i) / around, drop = double(j) / down;
            const glm::dvec3 weft = at(turn + kStep, drop) - at(turn - kStep, drop);
            const glm::dvec3 warp = at(turn, drop - kStep) - at(turn, drop + kStep);
            s.position.push_back(at(turn, drop));
            s.normal.emplace_back(glm::normalize(glm::cross(weft, warp)));
            s.warp.emplace_back(glm::normalize(warp));
        }
    for (unsigned j = 0; j < down; ++j)
        for (unsigned i = 0; i < around; ++i) {
            const unsigned a = j * around + i, b = j * around + (i + 1) % around;
            s.triangle.emplace_back(a, a + around, b + around);
            s.triangle.emplace_back(a, b + around, b);
        }
    return s;
}

Surface plane(double side) {
    const double h = side / 2;
    return {.position = {{-h, 0, h}, {h, 0, h}, {h, 0, -h}, {-h, 0, -h}},
            .normal = std::vector<glm::vec3>(4, {0, 1, 0}),
            .triangle = {{0, 1, 2}, {0, 2, 3}}};
}

} // namespace

Scene skirt(const Fabric &fabric, int lights, int size) {
    Scene scene;
    scene.surfaces = {pleated_cone(500, 100), plane(6)};
    scene.fabrics = {fabric, {.name = "plane", .colours = {.dye = Spectrum::constant(0.5)}}};
    scene.objects = {{"skirt", {0}, {0}}, {"plane", {1}, {1}}};
    scene.camera = {.eye = {0, 1.0, 2.6},
                    .target = {0, 0.4, 0},
                    .vertical_angle = 0.5,
                    .width = size,
                    .height = size};
    for (int i = 0; i < lights; ++i) {
        // Evenly over the arc, the first at its middle
        const double turn = -0.5 + 2.4 * (std::fmod(i * std::numbers::phi, 1.0));
        const glm::dvec3 middle(2 * std::sin(turn), 1.6 + 0.4 * std::sin(3.0 * i),
                                2 * std::cos(turn));
        const glm::dvec3 ahead = glm::normalize(glm::dvec3(0, 0.4, 0) - middle);
        const glm::dvec3 u = 0.3 * glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
        const glm::dvec3 v = glm::cross(ahead, u);
        scene.lights.push_back(RectangleLight{.corner = middle - 0.5 * (u + v),
                                              .edge_u = u,
                                              .edge_v = v,
                                              .radiance = 100.0 / lights});
    }
    return scene;
}

} // namespace tsuya::bench
