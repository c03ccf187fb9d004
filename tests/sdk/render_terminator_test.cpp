// Light at grazing incidence on surfaces of triangles: where it ends on a smooth surface, and that
// no triangle throws a shadow upon the surface that it is a part of.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

constexpr double kAlbedo = 0.8;
constexpr double kBright = kAlbedo / std::numbers::pi; // of what faces a sun of irradiance 1

// About the y axis, with the normals of a round one.
Surface prism(int sides, double radius, double turn) {
    Surface s;
    for (const double y : {-20.0, 20.0})
        for (int i = 0; i < sides; ++i) {
            const double angle = turn + 2 * std::numbers::pi * i / sides;
            const glm::dvec3 out(std::sin(angle), 0, std::cos(angle));
            s.position.push_back(radius * out + glm::dvec3(0, y, 0));
            s.normal.emplace_back(out);
        }
    const auto n = static_cast<unsigned>(sides);
    for (unsigned i = 0; i < n; ++i) {
        const unsigned j = (i + 1) % n;
        s.triangle.emplace_back(i, j, n + j);
        s.triangle.emplace_back(i, n + j, n + i);
    }
    return s;
}

glm::dvec3 across(double angle) { return {std::sin(angle), 0, std::cos(angle)}; }

Scene lit_from_aside(const Surface &surface, double angle) {
    Scene scene;
    scene.surfaces = {surface};
    scene.fabrics = {lambert(kAlbedo)};
    scene.objects = {{"prism", {0}, {0}}};
    scene.lights = {SunLight{.to_light = across(angle), .angular_radius = 0}};
    scene.camera = {.eye = {0, 0, 5}, .target = {0, 0, 0}, .width = 90, .height = 4};
    scene.camera.orthographic_height = 0.1;
    return scene;
}

// Largest difference from Lambert's law for the shading normal, of a sun of irradiance 1.
double largest_error(const Scene &scene, const glm::dvec3 &to_light) {
    RenderSettings settings = quick(64);
    settings.max_bounces = 0;
    settings.aovs = {"coverage", "normal"};
    const SpectralImage image = render(scene, settings).image;
    double largest = 0;
    int covered = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            if (*image.aovs[0].pixel(x, y) < 1)
                continue;
            ++covered;
            const float *const n = image.aovs[1].pixel(x, y);
            const double cosine = glm::dot(glm::dvec3(n[0], n[1], n[2]), to_light);
            largest = std::max(
                largest, std::abs(double(*image.pixel(0, x, y)) - kBright * std::max(0.0, cosine)));
        }
    EXPECT_GT(covered, 100);
    return largest;
}

// The light ends where the smooth surface turns away from it, not at the edge of a triangle.
TEST(Terminator, IsThatOfTheSmoothSurface) {
    for (const double turn : {0.0, 0.1, 0.2, 0.3, 0.4})
        for (const double light : {1.2, -1.8, 2.3}) {
            Scene scene = lit_from_aside(prism(12, 1, turn), light);
            scene.camera.orthographic_height = 0.09;
            EXPECT_LT(largest_error(scene, across(light)), 0.02 * kBright) << turn << " " << light;
        }
}

// Within a shell that keeps all light out, nearer than the smooth surface bulges.
TEST(Terminator, LetsNoLightThroughWhatLiesNear) {
    constexpr int kSides = 12;
    const double half = std::numbers::pi / kSides;
    Scene scene = lit_from_aside(prism(kSides, 1, half), 0);
    scene.surfaces.push_back(prism(kSides, 1.02, half));
    scene.objects.push_back({"shell", {1}, {0}});
    const double middle = std::cos(half);
    scene.camera = {.eye = {0.25, 0, middle + 0.012},
                    .target = {0.15, 0, middle},
                    .vertical_angle = 0.3,
                    .width = 24,
                    .height = 24};
    for (const double degrees : {91.0, 95.0, 100.0}) {
        std::get<SunLight>(scene.lights[0]).to_light = across(degrees * kDegree);
        RenderSettings settings = quick(16);
        settings.max_bounces = 2;
        EXPECT_EQ(largest_difference(render(scene, settings).image, 0, 0.0), 0.0) << degrees;
        Scene open = scene; // negative control: it is lit where there is no shell
        open.objects.pop_back();
        EXPECT_GT(largest_difference(render(open, settings).image, 0, 0.0), 0.0) << degrees;
    }
}

// A plane of many triangles of all shapes, tilted against all axes.
Surface tilted_plane(double scale, const glm::dvec3 &place) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.31, 0.87, 0.42));
    const glm::dvec3 along = glm::normalize(glm::cross(normal, glm::dvec3(0.2, 0.1, 1)));
    const glm::dvec3 aside = glm::cross(normal, along);
    constexpr int n = 60;
    Surface s;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            // Rows and columns of very different widths
            const double u = std::pow(2.0 * i / n - 1, 3), v = 2.0 * j / n - 1 + 0.01 * (i % 7);
            s.position.push_back(place + scale * (u * along + v * aside));
            s.normal.emplace_back(normal);
        }
    for (unsigned j = 0; j < n; ++j)
        for (unsigned i = 0; i < n; ++i) {
            const unsigned a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            s.triangle.emplace_back(a, b, d);
            s.triangle.emplace_back(a, d, c);
        }
    return s;
}

TEST(Stability, NoPixelOfALitPlaneIsInShadow) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.31, 0.87, 0.42));
    const glm::dvec3 along = glm::normalize(glm::cross(normal, glm::dvec3(0.2, 0.1, 1)));
    for (const double scale : {1e-3, 1.0, 1e5})
        for (const double moved : {0.0, scale < 1 ? 1.0 : 1e7}) // farther, positions are too coarse
            for (const double degrees : {0.0, 60.0, 85.0, 89.0}) {
                const glm::dvec3 place = moved * glm::dvec3(1, -0.3, 0.7);
                const double angle = degrees * kDegree;
                Scene scene;
                scene.surfaces = {tilted_plane(scale, place)};
                scene.fabrics = {lambert(kAlbedo)};
                scene.objects = {{"plane", {0}, {0}}};
                const glm::dvec3 to_light = std::cos(angle) * normal + std::sin(angle) * along;
                scene.lights = {SunLight{.to_light = to_light, .angular_radius = 0}};
                scene.camera = {.eye = place + 3 * scale * normal,
                                .target = place,
                                .up = along,
                                .vertical_angle = 0.5,
                                .width = 48,
                                .height = 48};
                RenderSettings settings = quick(16);
                settings.max_bounces = 0;
                const double expected = kBright * std::cos(angle);
                EXPECT_LT(largest_difference(render(scene, settings).image, 0, expected),
                          1e-3 * expected + 1e-7)
                    << scale << " " << moved << " " << degrees;
            }
}

} // namespace
