// Cameras against the formulas of their optics.

#include <cmath>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

// An upright square about a point, facing +z, before nothing.
Scene small_square(const glm::dvec3 &centre, double side) {
    const double h = side / 2;
    Scene scene;
    scene.surfaces = {{.position = {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}},
                       .normal = std::vector<glm::vec3>(4, {0, 0, 1}),
                       .triangle = {{0, 1, 2}, {0, 2, 3}}}};
    for (glm::dvec3 &p : scene.surfaces[0].position)
        p += centre;
    scene.fabrics = {lambert(0.5)};
    scene.objects = {{"square", {0}, {0}}};
    scene.environment = Environment{.radiance = 1};
    return scene;
}

// Where the picture has what the scene shows, by coverage: pixels.
struct Spot {
    double area = 0;
    glm::dvec2 centre{0, 0};
    double mean_square = 0; // of the distance from the centre
    double farthest = 0;    // of a pixel that it touches
};

Spot spot_of(const Scene &scene, int samples) {
    RenderSettings settings = quick(samples);
    settings.max_bounces = 0;
    settings.aovs = {"coverage"};
    const SpectralImage image = render(scene, settings).image;
    Spot spot;
    const auto each = [&](auto &&visit) {
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                if (const double share = *image.aovs[0].pixel(x, y); share > 0)
                    visit(share, glm::dvec2(x + 0.5, y + 0.5));
    };
    each([&](double share, const glm::dvec2 &at) {
        spot.area += share;
        spot.centre += share * at;
    });
    spot.centre /= spot.area;
    each([&](double share, const glm::dvec2 &at) {
        const glm::dvec2 off = at - spot.centre;
        spot.mean_square += share * glm::dot(off, off) / spot.area;
        spot.farthest = std::max(spot.farthest, glm::length(off));
    });
    return spot;
}

constexpr int kPixels = 64;

// The diameter of the blur disk of a point at the distance s through a lens of aperture A focused
// at d: A |1/d - 1/s| on a plane at distance 1 behind the lens, whatever the focal length.
double blur_pixels(const Camera &camera, double s) {
    return 2 * aperture_radius(camera) * std::abs(1 / focus_distance(camera) - 1 / s) *
           camera.height / (2 * std::tan(0.5 * camera.vertical_angle));
}

TEST(Lens, ApertureIsThatOfTheLensEquation) {
    Camera camera{.eye = {0, 0, 4}, .target = {0, 0, 0}, .lens = Lens{.f_number = 2}};
    // 50 mm behind the lens the sensor of 36 mm sees this angle
    camera.vertical_angle = 2 * std::atan(18.0 / 50);
    const double focal_length = 1 / (1 / 4.0 + 1 / 0.05);
    EXPECT_NEAR(aperture_radius(camera), focal_length / 2 / 2, 1e-12);
    camera.lens->focus_distance = 1e9; // then it is the focal length
    EXPECT_NEAR(aperture_radius(camera), 0.05 / 2 / 2, 1e-9);
    camera.lens.reset();
    EXPECT_EQ(aperture_radius(camera), 0);
}

// Before the plane that is sharp, behind it, and off the axis.
TEST(Lens, APointBecomesADiskOfItsSize) {
    const double side = 0.02;
    for (const glm::dvec3 &point :
         {glm::dvec3(0, 0, 1), glm::dvec3(0.02, -0.01, -1.5), glm::dvec3(-0.05, 0.03, 1)}) {
        Scene scene = small_square(point, side);
        scene.camera = {.eye = {0, 0, 3},
                        .target = {0, 0, 0},
                        .vertical_angle = 0.12,
                        .width = kPixels,
                        .height = kPixels,
                        .lens = Lens{.f_number = 0.8, .sensor_height = 0.024}};
        const double s = 3 - point.z, blur = blur_pixels(scene.camera, s);
        ASSERT_GT(blur, 10);
        ASSERT_LT(blur, 60);
        // A disk's mean square, and those of the square and of a pixel
        const double square = side / pixel_width(scene.camera, s);
        const double expected = blur * blur / 8 + square * square / 6 + 1 / 6.0;
        const Spot spot = spot_of(scene, 512);
        EXPECT_NEAR(spot.mean_square, expected, 0.04 * expected);
        EXPECT_LT(spot.farthest, blur / 2 + square + 1);
        EXPECT_GT(spot.farthest, blur / 2 - 1);
        EXPECT_NEAR(spot.area, square * square, 0.05 * square * square) << "no light is lost";

        Scene sharp = scene; // negative control
        sharp.camera.lens->focus_distance = s;
        EXPECT_LT(spot_of(sharp, 512).mean_square, 0.4 * expected);

        // A polygon of circumradius R has the mean square R^2 (2 + cos(2 pi / n)) / 6
        scene.camera.lens->blades = 5;
        const double polygon =
            blur * blur / 4 * (2 + std::cos(2 * kPi / 5)) / 6 + square * square / 6 + 1 / 6.0;
        EXPECT_NEAR(spot_of(scene, 512).mean_square, polygon, 0.04 * polygon);
        EXPECT_GT(expected, 1.1 * polygon);
    }
}

TEST(Orthographic, SizeDoesNotDependOnDistance) {
    for (const double z : {1.0, -6.0}) {
        Scene scene = small_square({0.2, -0.1, z}, 0.5);
        scene.camera = {.eye = {0, 0, 3},
                        .target = {0, 0, 0},
                        .width = kPixels,
                        .height = kPixels,
                        .orthographic_height = 1.5};
        const double pixels = kPixels / 1.5;
        const Spot spot = spot_of(scene, 64);
        EXPECT_NEAR(spot.area, 0.25 * pixels * pixels, 0.5);
        EXPECT_NEAR(spot.centre.x, kPixels / 2.0 + 0.2 * pixels, 0.02);
        EXPECT_NEAR(spot.centre.y, kPixels / 2.0 + 0.1 * pixels, 0.02);

        scene.camera.shift = {0.1, -0.25}; // the frame moves to the right and downwards
        const Spot shifted = spot_of(scene, 64);
        EXPECT_NEAR(shifted.centre.x, spot.centre.x - 0.1 * kPixels, 0.02);
        EXPECT_NEAR(shifted.centre.y, spot.centre.y - 0.25 * kPixels, 0.02);
    }
}

TEST(Orthographic, ItsPlaneIsWhereTheSceneBegins) {
    Scene scene = small_square({0, 0, 3.5}, 0.5);
    scene.camera = {
        .eye = {0, 0, 3}, .target = {0, 0, 0}, .width = 8, .height = 8, .orthographic_height = 1};
    EXPECT_EQ(spot_of(scene, 4).area, 0);
    scene.camera.eye.z = 4;
    EXPECT_GT(spot_of(scene, 4).area, 0);
}

// Columns in which a row of the picture begins and ends to show the square, by coverage.
glm::dvec2 edges_of_row(const Image &coverage, int y) {
    double first = 0;
    while (first < coverage.width && *coverage.pixel(static_cast<int>(first), y) == 0)
        ++first;
    double sum = 0;
    for (int x = 0; x < coverage.width; ++x)
        sum += static_cast<double>(*coverage.pixel(x, y));
    first += 1 - static_cast<double>(*coverage.pixel(static_cast<int>(first), y));
    return {first, first + sum};
}

// A tall board seen from below its middle: by a shift its edges stay upright, by a tilt they do
// not.
TEST(Shift, KeepsUprightEdgesParallel) {
    Scene scene = small_square({0, 2, 0}, 2);
    scene.camera = {.eye = {0, 0.5, 6},
                    .target = {0, 0.5, 0},
                    .vertical_angle = 0.5,
                    .width = kPixels,
                    .height = kPixels,
                    .shift = {0.05, 0.5}};
    RenderSettings settings = quick(64);
    settings.max_bounces = 0;
    settings.aovs = {"coverage"};
    const auto slant = [&] {
        const Image coverage = render(scene, settings).image.aovs[0];
        const glm::dvec2 high = edges_of_row(coverage, 20), low = edges_of_row(coverage, 40);
        EXPECT_GT(high.y - high.x, 10);
        return glm::length(high - low);
    };
    EXPECT_LT(slant(), 0.2);
    scene.camera.shift = {0, 0};
    scene.camera.target.y = 2;
    EXPECT_GT(slant(), 1);
}

TEST(Shift, MovesThePictureByItsShare) {
    Scene scene = small_square({0.1, 0.3, -0.5}, 0.4);
    scene.camera = {.eye = {0.2, 0.4, 3},
                    .target = {0, 0.2, 0},
                    .vertical_angle = 0.6,
                    .width = kPixels,
                    .height = kPixels};
    const Spot spot = spot_of(scene, 64);
    scene.camera.shift = {0.25, 0.125};
    const Spot shifted = spot_of(scene, 64);
    EXPECT_NEAR(shifted.area, spot.area, 0.5);
    EXPECT_NEAR(shifted.centre.x, spot.centre.x - 0.25 * kPixels, 0.05);
    EXPECT_NEAR(shifted.centre.y, spot.centre.y + 0.125 * kPixels, 0.05);
}

} // namespace
