#include "tsuya/scene/studio.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/render.h"

namespace tsuya::scene {
namespace {

TEST(Cyclorama, LooksAtTheCentreAndBendsSmoothly) {
    const Cyclorama shape{.centre = {1, 0.5, -2}, .azimuth = 0.7};
    const Surface surface = make_cyclorama(shape);
    check_surface(surface, "backdrop");
    const glm::dvec3 above = shape.centre + glm::dvec3(0, 1.0, 0);
    for (const glm::uvec3 &t : surface.triangle) {
        const glm::dvec3 a = surface.position[t.x], b = surface.position[t.y],
                         c = surface.position[t.z];
        const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
        EXPECT_GT(glm::dot(normal, above - (a + b + c) / 3.0), 0);
        for (const unsigned v : {t.x, t.y, t.z})
            EXPECT_GT(glm::dot(normal, glm::dvec3(surface.normal[v])), 0.99);
    }
    for (const glm::vec3 &normal : surface.normal)
        EXPECT_NEAR(glm::length(normal), 1, 1e-6);
}

TEST(Cyclorama, StandsBehindTheCentre) {
    const Cyclorama shape{.azimuth = 0.7, .front = 4, .back = 2.5, .height = 6};
    double nearest = 1e9, farthest = -1e9, top = 0;
    for (const glm::dvec3 &p : make_cyclorama(shape).position) {
        const double towards = glm::dot(p, direction_at(0.7, 0));
        nearest = std::min(nearest, towards);
        farthest = std::max(farthest, towards);
        top = std::max(top, p.y);
        EXPECT_GE(p.y, 0);
    }
    EXPECT_NEAR(nearest, -2.5, 1e-9);
    EXPECT_NEAR(farthest, 4, 1e-9);
    EXPECT_NEAR(top, 6, 1e-9);
}

TEST(Cyclorama, RefusesABendThatDoesNotFit) {
    EXPECT_THROW(make_cyclorama({.back = 1, .radius = 1.2}), Error);
    EXPECT_THROW(make_cyclorama({.width = 0}), Error);
}

TEST(Irradiance, OfASmallLightFollowsTheInverseSquare) {
    const RectangleLight light{.corner = {-0.005, -0.005, 3},
                               .edge_u = {0, 0.01, 0},
                               .edge_v = {0.01, 0, 0},
                               .radiance = 5};
    EXPECT_NEAR(irradiance(light, {0, 0, 0}, {0, 0, 1}), 5 * 1e-4 / 9, 1e-8);
}

TEST(Irradiance, OfALargeLightIsThatOfASum) {
    const Softbox box{.centre = {-1, 1.5, 1}, .target = {0.2, 0.4, 0}, .width = 1.2, .height = 0.7};
    const RectangleLight light = make_light(box);
    const glm::dvec3 normal = glm::normalize(box.centre - box.target);
    const glm::dvec3 side = glm::normalize(glm::cross(light.edge_u, light.edge_v));
    constexpr int kSteps = 200;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const glm::dvec3 to_light = light.corner + light.edge_u * ((i + 0.5) / kSteps) +
                                        light.edge_v * ((j + 0.5) / kSteps) - box.target;
            const double square = glm::dot(to_light, to_light);
            sum += glm::dot(to_light, normal) * -glm::dot(to_light, side) / (square * square);
        }
    sum *= light.radiance * box.width * box.height / (kSteps * kSteps);
    EXPECT_NEAR(irradiance(light, box.target, normal), sum, 1e-4 * sum);
}

TEST(Softbox, GivesItsStrengthAtItsTarget) {
    const Softbox box{.centre = {-2, 2.5, 1}, .target = {0, 1, 0}, .width = 0.8, .strength = 1.5};
    const RectangleLight light = make_light(box);
    const glm::dvec3 normal = glm::normalize(box.centre - box.target);
    EXPECT_NEAR(irradiance(light, box.target, normal), 1.5 * kPi, 1e-9);
    // The side that shines is that of cross(edge_u, edge_v)
    EXPECT_GT(glm::dot(glm::cross(light.edge_u, light.edge_v), box.target - box.centre), 0);
    EXPECT_NEAR(glm::length(light.edge_u), 0.8, 1e-12);
    EXPECT_NEAR(glm::length(light.corner + 0.5 * (light.edge_u + light.edge_v) - box.centre), 0,
                1e-12);
}

TEST(Softbox, RefusesWhatFacesNowhere) {
    EXPECT_THROW(make_light({.centre = {0, 1, 0}, .target = {0, 1, 0}}), Error);
    EXPECT_THROW(make_light({.centre = {0, 3, 0}, .target = {0, 1, 0}}), Error);
    EXPECT_THROW(make_light({.width = -1}), Error);
    EXPECT_THROW(make_light({.strength = NAN}), Error);
}

TEST(Framing, TouchesItsMarginsAndKeepsAllInside) {
    const std::vector<glm::dvec3> points{{-0.3, 0, 0.2}, {0.4, 0, -0.1}, {0, 1.75, 0}, {0, 1, 0.5}};
    const Framing framing{.azimuth = 0.5, .elevation = 0.1, .margin = 0.1};
    const Camera camera = frame_points(points, framing);
    double top = 1e9, bottom = -1e9;
    for (const glm::dvec3 &p : points) {
        const glm::dvec3 pixel = project_point(camera, p);
        EXPECT_GT(pixel.z, 0);
        EXPECT_GE(pixel.x, 0.05 * camera.width - 1e-6);
        EXPECT_LE(pixel.x, 0.95 * camera.width + 1e-6);
        top = std::min(top, pixel.y);
        bottom = std::max(bottom, pixel.y);
    }
    EXPECT_NEAR(top, 0.05 * camera.height, 1e-6);
    EXPECT_NEAR(bottom, 0.95 * camera.height, 1e-6);
    const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
    EXPECT_NEAR(glm::length(back - direction_at(0.5, 0.1)), 0, 1e-9);
}

TEST(Framing, TouchesTheSidesOfWhatIsWide) {
    const Camera camera =
        frame_points({{-2, 0, 0}, {3, 0, 0}, {0, 0.1, 0}}, {.margin = 0.2, .width = 100});
    EXPECT_NEAR(project_point(camera, {-2, 0, 0}).x, 10, 1e-6);
    EXPECT_NEAR(project_point(camera, {3, 0, 0}).x, 90, 1e-6);
}

TEST(Framing, FramesWithAShiftAndByParallelRays) {
    const std::vector<glm::dvec3> points{{-0.3, 0, 0.2}, {0.4, 0, -0.1}, {0, 1.75, 0}, {0, 1, 0.5}};
    for (const bool orthographic : {false, true}) {
        const Framing framing{.azimuth = 0.5,
                              .elevation = 0.1,
                              .margin = 0.1,
                              .orthographic = orthographic,
                              .shift = {0.3, -0.25}};
        const Camera camera = frame_points(points, framing);
        EXPECT_EQ(camera.shift, framing.shift);
        double top = 1e9, bottom = -1e9;
        for (const glm::dvec3 &p : points) {
            const glm::dvec3 pixel = project_point(camera, p);
            EXPECT_GT(pixel.z, 0);
            EXPECT_GE(pixel.x, 0.05 * camera.width - 1e-6);
            EXPECT_LE(pixel.x, 0.95 * camera.width + 1e-6);
            top = std::min(top, pixel.y);
            bottom = std::max(bottom, pixel.y);
        }
        EXPECT_NEAR(top, 0.05 * camera.height, 1e-6);
        EXPECT_NEAR(bottom, 0.95 * camera.height, 1e-6);
    }
}

// Where project_point says that a camera sees a point, there a render shows it.
TEST(Camera, ProjectsAsItIsRendered) {
    const glm::dvec3 point(0.13, 0.9, -0.2);
    Camera camera{.eye = {0.5, 1.4, 3}, .target = {0, 1, 0}, .width = 64, .height = 48};
    std::vector<Camera> cameras(3, camera);
    cameras[1].shift = {0.2, -0.15};
    cameras[2].shift = {-0.1, 0.1};
    cameras[2].orthographic_height = 1.6;
    for (const Camera &one : cameras) {
        Scene scene;
        scene.surfaces = {{.position = {point, point, point},
                           .normal = std::vector<glm::vec3>(3, {0, 0, 1}),
                           .triangle = {{0, 1, 2}}}};
        scene.surfaces[0].position[0] += glm::dvec3(-0.09, -0.06, 0);
        scene.surfaces[0].position[1] += glm::dvec3(0.09, -0.06, 0);
        scene.surfaces[0].position[2] += glm::dvec3(0, 0.12, 0);
        scene.fabrics = {{.name = "plain"}};
        scene.objects = {{"point", {0}, {0}}};
        scene.environment = Environment{};
        scene.camera = one;
        const Image coverage =
            render(scene, {.stop = {.samples_per_pixel = 256}, .channels = 8, .aovs = {"coverage"}})
                .image.aovs[0];
        glm::dvec2 sum(0);
        double area = 0;
        for (int y = 0; y < one.height; ++y)
            for (int x = 0; x < one.width; ++x) {
                const double share = *coverage.pixel(x, y);
                area += share;
                sum += share * glm::dvec2(x + 0.5, y + 0.5);
            }
        ASSERT_GT(area, 2);
        const glm::dvec3 pixel = project_point(one, point);
        EXPECT_NEAR(sum.x / area, pixel.x, 0.05);
        EXPECT_NEAR(sum.y / area, pixel.y, 0.05);
    }
}

TEST(Framing, RefusesNothingAndNonsense) {
    EXPECT_THROW(frame_points({}, {}), Error);
    EXPECT_THROW(frame_points({{0, 0, 0}}, {}), Error);
    EXPECT_THROW(frame_points({{0, 0, 0}, {0, 1, 0}}, {.vertical_angle = 4}), Error);
}

TEST(Camera, SeesTheRightOnTheRight) {
    const Camera camera{.eye = {0, 1, 3}, .target = {0, 1, 0}, .width = 100, .height = 80};
    const glm::dvec3 pixel = project_point(camera, {0.1, 1.1, 0});
    EXPECT_GT(pixel.x, 50);
    EXPECT_LT(pixel.y, 40);
    EXPECT_NEAR(pixel.z, 3, 1e-12);
}

} // namespace
} // namespace tsuya::scene
