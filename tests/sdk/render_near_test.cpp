// Cloth with a weave: what the camera sees from near and from far is one cloth.

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

// A repeat of side x side metres of which the places of `marks` (row by row) are warp, `o` weft,
// `.` a hole.
WeaveMap drawn(double side, int width, const std::string &marks) {
    WeaveMap map{.repeat = {side, side},
                 .size = {width, static_cast<int>(marks.size()) / width},
                 .threads = {1, 1}};
    for (const char mark : marks)
        map.place.push_back({.system = mark == 'x'   ? WeavePlace::kWarp
                                       : mark == 'o' ? WeavePlace::kWeft
                                                     : WeavePlace::kGap,
                             .slope = mark == 'x' ? 0.1f : 0.0f,
                             .along = 0.5f});
    return map;
}

Fabric woven(const WeaveMap &map) {
    Fabric fabric = satin(0.3);
    fabric.weave = ClothWeave{.preset = "drawn", .map = map};
    return fabric;
}

// A sheet of 1 m x 1 m, u to the right and v away from the viewer, that is seen whole by parallel
// rays under a distant light.
Scene sheet(const Fabric &fabric, int pixels, bool from_behind = false) {
    Scene scene;
    Surface surface = floor_square(1);
    surface.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scene.surfaces = {surface};
    scene.fabrics = {fabric};
    scene.objects = {{"sheet", {0}, {0}}};
    const double side = from_behind ? -1 : 1;
    scene.lights = {SunLight{.to_light = {-0.2, side, -0.1}, .irradiance = 3}};
    scene.camera = {.eye = {0, side, 0},
                    .target = {0, 0, 0},
                    .up = {0, 0, -1},
                    .width = pixels,
                    .height = pixels};
    scene.camera.orthographic_height = 1;
    return scene;
}

// One cloth's tables serve all its pictures.
SpectralImage picture(const Scene &scene, int samples) {
    static PreparedScene prepared;
    return render(scene, quick(samples), {}, &prepared).image;
}

double mean_of(const SpectralImage &image) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            sum += static_cast<double>(image.pixel(0, x, y)[0]);
    return sum / (image.width * image.height);
}

// Rows of the picture from above: `#` where there is light.
std::string seen(const Scene &scene) {
    const SpectralImage image = picture(scene, 16);
    float brightest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            brightest = std::max(brightest, image.pixel(0, x, y)[0]);
    std::string rows;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            rows += image.pixel(0, x, y)[0] > 0.5f * brightest ? '#' : '.';
    return rows;
}

TEST(NearCloth, HasTheMeanOfTheFarCloth) {
    const WeaveMap map = drawn(0.25, 4,
                               "xxoo"
                               "xx.o"
                               "xxxo"
                               "oxxx");
    const double far = mean_of(picture(sheet(satin(0.3), 64), 16));
    // All near; between near and far; all far
    for (const int pixels : {64, 6, 3, 2}) {
        const SpectralImage near = picture(sheet(woven(map), pixels), 65536 / (pixels * pixels));
        EXPECT_NEAR(mean_of(near) / far, 1, 5e-3) << pixels;
        if (pixels == 64) { // control: it is not the far cloth
            EXPECT_GT(largest_difference(near, 0, far), 0.5 * far);
        }
    }
}

TEST(NearCloth, IsTheFarClothFromFar) {
    const WeaveMap map = drawn(1e-3, 2,
                               "xo"
                               "ox");
    EXPECT_EQ(picture(sheet(woven(map), 16), 4).transport,
              picture(sheet(satin(0.3), 16), 4).transport);
}

// One place of the repeat has yarns. Places are half a metre, pixels a quarter: rows from above, v
// grows upwards.
TEST(NearCloth, LiesAsItIsCut) {
    const WeaveMap map = drawn(1, 2,
                               ".."
                               "x."); // at u < 1/2, v > 1/2
    Fabric fabric = woven(map);
    EXPECT_EQ(seen(sheet(fabric, 4)), "##.."
                                      "##.."
                                      "...."
                                      "....");
    // From behind a cloth of its own: the weft of a face runs to the right of its viewer. With the
    // picture's up to -z, from below u grows to the left: u in [-1/2, 0] is as in [1/2, 1]
    Scene lined = sheet(fabric, 4, true);
    lined.objects[0].back = FabricIndex{0};
    const std::string behind = seen(lined);
    EXPECT_EQ(std::count(behind.begin(), behind.end(), '#'), 4);
    EXPECT_EQ(behind, seen(sheet(fabric, 4)));
    // The cloth's own back is its face with the systems exchanged: the place at (v, u)
    EXPECT_EQ(seen(sheet(fabric, 4, true)), "...."
                                            "...."
                                            "##.."
                                            "##..");
}

TEST(NearCloth, IsFarWhereUvsSpanNoArea) {
    Scene scene = sheet(woven(drawn(0.5, 2,
                                    "xo"
                                    "ox")),
                        4);
    const double near = mean_of(picture(scene, 16));
    for (glm::vec2 &uv : scene.surfaces[0].uv)
        uv = {0.1, 0.1};
    const SpectralImage pointed = picture(scene, 16);
    scene.fabrics[0].weave.reset();
    EXPECT_EQ(pointed.transport, picture(scene, 16).transport);
    EXPECT_NE(near, mean_of(pointed));
}

TEST(NearCloth, IsPlanned) {
    Scene scene = sheet(woven(drawn(1e-3, 2,
                                    "xo"
                                    "ox")),
                        100);
    scene.camera.orthographic_height.reset();
    scene.camera.vertical_angle = 0.1;
    const Plan planned = plan(scene, quick(4));
    ASSERT_EQ(planned.near_cloths.size(), 1u);
    // 100 pixels of 2 mm each
    EXPECT_NEAR(planned.near_cloths[0].within, 0.2 / (2 * std::tan(0.05)), 1e-9);
    EXPECT_NE(explain(planned).find("the yarns of 'satin' appear nearer than 2 m"),
              std::string::npos)
        << explain(planned);
    scene.camera.orthographic_height = 1;
    EXPECT_NE(explain(plan(scene, quick(4))).find("is seen from far alone"), std::string::npos);
    scene.fabrics[0].colours.specular_tint = Spectrum::constant(0);
    EXPECT_EQ(plan(scene, quick(4)).near_cloths.size(), 1u); // by what follows the yarns
    scene.fabrics[0].specular = GgxFacets{};
    EXPECT_TRUE(plan(scene, quick(4)).near_cloths.empty()); // which shows no weave
    scene.fabrics[0] = satin(0.3);
    EXPECT_TRUE(plan(scene, quick(4)).near_cloths.empty());
}

TEST(NearCloth, WarnsOfAWeaveThatDoesNotExplainItsFilaments) {
    YarnLobes lobes;
    lobes.surface[1][24] = 1.2;
    Fabric fabric{.name = "odd", .specular = lobes};
    const auto warnings = [&](const std::string &marks) {
        fabric.weave = ClothWeave{.preset = "drawn", .map = drawn(1, 2, marks)};
        return render(sheet(fabric, 2), quick(1)).warnings;
    };
    EXPECT_TRUE(warnings("xxxo").empty());
    ASSERT_EQ(warnings("xooo").size(), 1u);
    EXPECT_EQ(warnings("xooo")[0].where, "fabrics.odd.weave");
    EXPECT_NE(warnings("xooo")[0].what.find("shows warp"), std::string::npos);
}

} // namespace
