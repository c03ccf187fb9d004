#pragma once
// Small surfaces and scenes for tests of the renderer.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/render.h"

namespace tsuya::test {

inline Fabric lambert(double albedo) {
    return {.name = "plain", .colours = {.dye = Spectrum::constant(albedo)}};
}

// A square in the plane y = 0, side metres wide, looking up; warp along -z.
inline Surface floor_square(double side) {
    const double h = side / 2;
    return {.position = {{-h, 0, h}, {h, 0, h}, {h, 0, -h}, {-h, 0, -h}},
            .normal = std::vector<glm::vec3>(4, {0, 1, 0}),
            .warp = std::vector<glm::vec3>(4, {0, 0, -1}),
            .triangle = {{0, 1, 2}, {0, 2, 3}}};
}

// A closed sphere of radius 1 with shading normals; coarse on purpose: normals and triangles
// differ.
inline Surface sphere(int rings, int sectors) {
    Surface s;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            const double theta = std::numbers::pi * i / rings;
            const double phi = 2 * std::numbers::pi * j / sectors;
            const glm::dvec3 p(std::sin(theta) * std::sin(phi), std::cos(theta),
                               std::sin(theta) * std::cos(phi));
            s.position.push_back(p);
            s.normal.emplace_back(glm::normalize(glm::vec3(p)));
            s.warp.emplace_back(std::cos(phi), 0, -std::sin(phi));
        }
    const auto at = [&](int i, int j) { return static_cast<unsigned>(i * sectors + j % sectors); };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            if (i > 0)
                s.triangle.emplace_back(at(i, j), at(i + 1, j), at(i, j + 1));
            if (i + 1 < rings)
                s.triangle.emplace_back(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
        }
    return s;
}

// The view under light from straight above of a satin made of one anisotropic lobe, 10 degree grid.
inline Bard satin_bard() {
    ReflectanceTable table;
    for (int t = 0; t < 90; t += 10)
        for (int p = 0; p <= 90; p += 15) {
            const double theta = t * kDegree, phi = p * kDegree;
            const double x = std::tan(theta / 2) * std::cos(phi) / 0.4;
            const double y = std::tan(theta / 2) * std::sin(phi) / 0.12;
            const double q = 1 + x * x + y * y;
            table.rows.push_back({0, 0, theta, phi, 0.12 / (q * q) + 0.001, 0});
        }
    return Bard::fit(table, "satin");
}

inline Fabric satin(double dye) {
    Fabric fabric = lambert(dye);
    fabric.name = "satin";
    fabric.specular = CarriedViews{.bard = satin_bard(), .f0 = 0.05};
    return fabric;
}

// A folded sheet above a floor, lit by a rectangle and an even environment in two light groups.
inline Scene folded_satin(int width, int height) {
    Scene scene;
    Surface sheet;
    constexpr int n = 24;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double x = 2.0 * i / n - 1, y = 2.0 * j / n;
            const double slope = 0.9 * std::cos(6 * x);
            sheet.position.emplace_back(x, y, 0.15 * std::sin(6 * x));
            sheet.normal.push_back(glm::normalize(glm::vec3(-slope, 0, 1)));
            sheet.warp.emplace_back(0, 1, 0);
        }
    for (unsigned j = 0; j < n; ++j)
        for (unsigned i = 0; i < n; ++i) {
            const unsigned a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            sheet.triangle.emplace_back(a, b, d);
            sheet.triangle.emplace_back(a, d, c);
        }
    scene.surfaces = {sheet, floor_square(6)};
    scene.fabrics = {satin(0.4), lambert(0.5)};
    scene.objects = {{"sheet", {0}, {0}}, {"floor", {1}, {1}}};
    scene.light_groups = {"key", "fill"};
    scene.lights = {RectangleLight{.corner = {-1.7, 1, 2.8},
                                   .edge_u = {-0.8, 0, -0.8},
                                   .edge_v = {0, 1, 0},
                                   .radiance = 8,
                                   .group = {0}}};
    scene.environment = Environment{.radiance = 0.3, .group = {1}};
    scene.camera = {.eye = {0.3, 1.3, 4.5},
                    .target = {0, 1, 0},
                    .vertical_angle = 0.55,
                    .width = width,
                    .height = height};
    return scene;
}

// A coarse ball in an even environment of radiance 1.
inline Scene furnace(const Fabric &fabric) {
    Scene scene;
    scene.surfaces = {sphere(7, 9)};
    scene.fabrics = {fabric};
    scene.objects = {{"ball", {0}, {0}}};
    scene.environment = Environment{.radiance = 1};
    scene.camera = {.eye = {0, 0.5, 4}, .target = {0, 0, 0}, .width = 24, .height = 24};
    return scene;
}

inline RenderSettings quick(int samples) {
    return {.stop = {.samples_per_pixel = samples}, .channels = 8};
}

// Where check_scene finds the first fault; `accepted` without one.
inline std::string place_of_fault(const Scene &scene) {
    try {
        check_scene(scene);
    } catch (const Error &error) {
        return error.problems()[0].where;
    }
    return "accepted";
}

// Largest |value - expected| over all pixels and channels of a group.
inline double largest_difference(const SpectralImage &image, std::size_t group, double expected) {
    double largest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int k = 0; k < image.basis.count; ++k)
                largest = std::max(largest, std::abs(image.pixel(group, x, y)[k] - expected));
    return largest;
}

} // namespace tsuya::test
