// Pictures do not depend on the unit of length: a ray leaves a surface by a bound of rounding
// errors, which is in proportion to the coordinates.

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

Scene scaled(Scene scene, double scale) {
    for (Surface &surface : scene.surfaces)
        for (glm::dvec3 &p : surface.position)
            p *= scale;
    for (Light &any : scene.lights) {
        auto &light = std::get<RectangleLight>(any);
        light.corner *= scale;
        light.edge_u *= scale;
        light.edge_v *= scale;
    }
    scene.camera.eye *= scale;
    scene.camera.target *= scale;
    return scene;
}

TEST(Scale, APowerOfTwoLeavesEveryBit) {
    const Scene scene = folded_satin(24, 24);
    PreparedScene prepared;
    const auto picture = [&](double scale) {
        return render(scaled(scene, scale), quick(16), {}, &prepared).image.transport;
    };
    for (const int power : {-20, -10, 10, 20})
        EXPECT_EQ(picture(std::ldexp(1.0, power)), picture(1.0)) << power;
}

TEST(Scale, MillimetresAndKilometresGiveThePictureOfMetres) {
    const Scene scene = folded_satin(24, 24);
    PreparedScene prepared;
    const std::vector<float> picture = render(scene, quick(64), {}, &prepared).image.transport;
    for (const double scale : {1e-5, 1e-3, 1e3}) {
        const std::vector<float> other =
            render(scaled(scene, scale), quick(64), {}, &prepared).image.transport;
        double sum = 0, difference = 0;
        for (std::size_t i = 0; i < picture.size(); ++i) {
            sum += static_cast<double>(picture[i]);
            difference += std::abs(static_cast<double>(other[i] - picture[i]));
        }
        // Paths of the same random numbers: few fall to the other side of an edge
        EXPECT_LT(difference, 2e-3 * sum) << scale;
    }
}

// A convex body has no light from itself. Its triangles are slivers, its shading normals theirs.
Scene convex_body(const glm::dvec3 &place) {
    const Surface smooth = sphere(200, 7);
    Surface flat;
    for (const glm::uvec3 &t : smooth.triangle) {
        const glm::dvec3 a = smooth.position[t.x], b = smooth.position[t.y],
                         c = smooth.position[t.z];
        const auto first = static_cast<unsigned>(flat.position.size());
        for (const glm::dvec3 &p : {a, b, c}) {
            flat.position.push_back(p + place);
            flat.normal.emplace_back(glm::normalize(glm::cross(b - a, c - a)));
        }
        flat.triangle.emplace_back(first, first + 1, first + 2);
    }
    Scene scene;
    scene.surfaces = {flat, floor_square(1e-3)}; // the second keeps the first from the centre
    for (glm::dvec3 &p : scene.surfaces[1].position)
        p -= place;
    scene.fabrics = {lambert(0.5)};
    scene.objects = {{"body", {0}, {0}}, {"far", {1}, {0}}};
    scene.environment = Environment{.radiance = 1};
    scene.camera = {
        .eye = place + glm::dvec3(1, 1.5, 3), .target = place, .width = 48, .height = 48};
    return scene;
}

TEST(Scale, NoRayMeetsTheTriangleThatItLeaves) {
    RenderSettings settings = quick(32);
    settings.max_bounces = 1;
    for (const double distance : {0.0, 0.7, 50.0})
        for (const double scale : {1e-3, 1.0, 1e3}) {
            const Scene scene = convex_body({distance, 0.3 * distance, -distance});
            const SpectralImage image = render(scaled(scene, scale), settings).image;
            float least = 1;
            for (int y = 0; y < image.height; ++y)
                for (int x = 0; x < image.width; ++x)
                    least = std::min(least, image.pixel(0, x, y)[0]);
            EXPECT_GT(least, 0.4999f) << distance << " " << scale;
        }
}

} // namespace
