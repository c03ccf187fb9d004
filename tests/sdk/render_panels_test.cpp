// A fabric for every panel of a surface, and for its two sides.

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/plan.h"

namespace tsuya::test {
namespace {

// One square of two triangles, of panels 0 and 1, from above.
Scene two_panels() {
    Scene scene;
    scene.surfaces = {floor_square(2)};
    scene.surfaces[0].panel = {0, 1};
    scene.fabrics = {satin(0.4), lambert(0.7), lambert(0.1)};
    scene.objects = {{"sheet", {0}, {0}}};
    scene.lights = {RectangleLight{
        .corner = {0.2, 1.5, 0.1}, .edge_u = {1, 0, 0}, .edge_v = {0, 0, 1}, .radiance = 5}};
    scene.environment = Environment{.radiance = 0.2};
    scene.camera = {.eye = {0, 2, 1}, .target = {0, 0, 0}, .width = 16, .height = 16};
    return scene;
}

TEST(PanelFabrics, ArePaintedAsObjectsOfTheirOwn) {
    Scene scene = two_panels();
    scene.objects[0].panels = {{.panel = 1, .fabric = {1}}};
    Scene apart = two_panels();
    apart.surfaces.push_back(apart.surfaces[0]);
    for (std::size_t i = 0; i < 2; ++i) {
        apart.surfaces[i].triangle = {apart.surfaces[0].triangle[i == 0 ? 0 : 1]};
        apart.surfaces[i].panel.clear();
    }
    apart.surfaces[1].triangle = {{0, 2, 3}};
    apart.objects = {{"a", {0}, {0}}, {"b", {1}, {1}}};
    const auto picture = render(scene, quick(16)).image.transport;
    EXPECT_EQ(picture, render(apart, quick(16)).image.transport);
    EXPECT_NE(picture, render(two_panels(), quick(16)).image.transport);
    EXPECT_EQ(fabrics_in_use(scene), (std::vector<bool>{true, true, false}));
}

// The same square seen from below: its light and camera are below it too.
Scene from_below(Scene scene) {
    scene.camera.eye.y = -scene.camera.eye.y;
    scene.camera.eye.x = 0.3;
    RectangleLight &light = std::get<RectangleLight>(scene.lights[0]);
    light.corner.y = -light.corner.y;
    std::swap(light.edge_u, light.edge_v);
    return scene;
}

// A surface that is turned over has the other side outside.
Surface turned_over(Surface surface) {
    for (glm::vec3 &normal : surface.normal)
        normal = -normal;
    for (glm::uvec3 &triangle : surface.triangle)
        std::swap(triangle.y, triangle.z);
    return surface;
}

double mean_difference(const Scene &a, const Scene &b) {
    const SpectralImage first = render(a, quick(256)).image, second = render(b, quick(256)).image;
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < first.transport.size(); ++i) {
        sum += std::abs(first.transport[i] - second.transport[i]);
        all += first.transport[i];
    }
    return sum / all;
}

TEST(Back, OfAnotherFabricIsSeenFromBehindAlone) {
    Scene lined = two_panels();
    lined.objects[0].back = FabricIndex{1};
    EXPECT_EQ(render(lined, quick(16)).image.transport,
              render(two_panels(), quick(16)).image.transport);
    Scene lining = from_below(two_panels());
    lining.surfaces[0] = turned_over(lining.surfaces[0]);
    lining.objects[0].fabric = {1};
    EXPECT_LT(mean_difference(from_below(lined), lining), 1e-4);
    EXPECT_GT(mean_difference(from_below(two_panels()), lining), 0.1); // negative control
}

TEST(Back, OfAPanelIsItsOwn) {
    Scene scene = from_below(two_panels());
    scene.objects[0].panels = {{.panel = 0, .fabric = {1}, .back = FabricIndex{2}},
                               {.panel = 1, .fabric = {1}, .back = FabricIndex{2}}};
    Scene whole = from_below(two_panels());
    whole.surfaces[0] = turned_over(whole.surfaces[0]);
    whole.objects[0].fabric = {2};
    EXPECT_LT(mean_difference(scene, whole), 1e-4);
}

// Where warp floats on the face, weft floats behind: a warp satin has a weft satin's back.
TEST(Back, OfAFabricHasItsYarnSystemsExchanged) {
    Fabric shot = satin(0.1);
    shot.colours.weft_tint = Spectrum::constant(0.2);
    Scene scene = from_below(two_panels());
    scene.fabrics[0] = shot;
    // What is seen from behind, as the face of a weft satin
    Scene weft_satin = scene;
    Surface &surface = weft_satin.surfaces[0];
    surface = turned_over(surface);
    surface.warp.assign(4, {1, 0, 0});
    std::swap(weft_satin.fabrics[0].colours.weft_tint, weft_satin.fabrics[0].colours.warp_tint);
    EXPECT_LT(mean_difference(scene, weft_satin), 1e-4);
    Scene copy_of_face = scene; // negative control
    copy_of_face.surfaces[0] = turned_over(copy_of_face.surfaces[0]);
    EXPECT_GT(mean_difference(scene, copy_of_face), 0.05);
}

TEST(PanelFabrics, ThatAreWrongAreRefused) {
    Scene scene = two_panels();
    scene.objects[0].panels = {{.panel = 2, .fabric = {1}}};
    EXPECT_EQ(place_of_fault(scene), "objects[0].panels[0]");
    scene.objects[0].panels = {{.panel = 1, .fabric = {7}}};
    EXPECT_EQ(place_of_fault(scene), "objects[0].panels[0].fabric");
    scene.objects[0].panels = {{.panel = 1, .fabric = {1}}, {.panel = 1, .fabric = {2}}};
    EXPECT_EQ(place_of_fault(scene), "objects[0].panels[1]");
    scene.objects[0] = {"sheet", {0}, {0}, FabricIndex{9}};
    EXPECT_EQ(place_of_fault(scene), "objects[0].back");
    scene.objects[0] = {"sheet", {0}, {1}};
    scene.objects[0].panels = {{.panel = 1, .fabric = {0}}};
    scene.surfaces[0].warp.clear(); // the satin of panel 1 needs it
    EXPECT_EQ(place_of_fault(scene), "objects[0].panels[0]");
}

} // namespace
} // namespace tsuya::test
