// What a cloth does that a solid does not: light through it, and colours of its two systems of
// yarns.

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

Fabric thin(Fabric fabric, double transmittance) {
    fabric.colours.transmittance = Spectrum::constant(transmittance);
    return fabric;
}

Fabric delustred(Fabric fabric) {
    fabric.colours.delustre = 1;
    return fabric;
}

double mean_difference(const Scene &scene) {
    RenderSettings settings = quick(256);
    settings.max_bounces = 1000;
    const SpectralImage image = render(scene, settings).image;
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            sum += image.pixel(0, x, y)[0] - 1;
    return sum / (image.width * image.height);
}

// A cloth that loses nothing cannot be seen in a white environment, from outside or through itself,
// though its shading normals are far from its triangles' normals.
TEST(Furnace, LosslessThinClothIsInvisible) {
    for (const Fabric &fabric : {thin(lambert(0.4), 0.6), thin(lambert(0), 1),
                                 thin(delustred(satin(0.3)), 0.7), thin(satin(0), 1)})
        EXPECT_NEAR(mean_difference(furnace(fabric)), 0, 2e-3) << fabric.name;
    // A body that follows yarns keeps 0.99 of the light
    EXPECT_NEAR(mean_difference(furnace(thin(satin(0.3), 0.7))), -0.008, 0.007);
}

TEST(Furnace, LossyThinClothIsSeen) { // negative control
    EXPECT_LT(mean_difference(furnace(thin(lambert(0.4), 0.58))), -4e-3);
    EXPECT_LT(mean_difference(furnace(thin(satin(0.3), 0.68))), -4e-3);
}

TEST(PreparedScene, LeavesThePictureAsItIs) {
    PreparedScene prepared;
    for (const double dye : {0.3, 0.6}) {
        const Scene scene = furnace(satin(dye));
        EXPECT_EQ(render(scene, quick(4), {}, &prepared).image.transport,
                  render(scene, quick(4)).image.transport);
        EXPECT_EQ(prepared.use().tables.made, 1u);
    }
}

// A sheet seen from above that is lit by a rectangle on one side of it.
Scene lit_sheet(const Fabric &fabric, bool from_behind) {
    Scene scene;
    scene.surfaces = {floor_square(20)};
    scene.fabrics = {fabric};
    scene.objects = {{"sheet", {0}, {0}}};
    scene.lights = {RectangleLight{
        .corner = {0.2, 1.5, 0.1}, .edge_u = {1, 0, 0}, .edge_v = {0, 0, 1}, .radiance = 5}};
    if (from_behind) {
        RectangleLight &light = std::get<RectangleLight>(scene.lights[0]);
        light.corner.y = -light.corner.y;
        std::swap(light.edge_u, light.edge_v);
    }
    scene.camera = {.eye = {0, 1.2, 0.4}, .target = {0, 0, 0}, .width = 4, .height = 4};
    scene.camera.vertical_angle = 0.002;
    return scene;
}

// Dye and transmittance scatter alike, so a lamp gives as much from behind as from above.
TEST(ThinCloth, LambertianToBothSides) {
    const double above = *render(lit_sheet(lambert(0.3), false), quick(2048)).image.pixel(0, 1, 1);
    const auto from_behind = [](const Fabric &fabric) {
        return render(lit_sheet(fabric, true), quick(2048)).image;
    };
    EXPECT_GT(above, 0.1);
    EXPECT_NEAR(*from_behind(thin(lambert(0.1), 0.3)).pixel(0, 1, 1), above, 0.01 * above);
    // Below a specular surface, whose share at 8 degrees is in the transmittance: what it takes at
    // other angles is little more
    const double coated = *from_behind(thin(satin(0), 0.3)).pixel(0, 1, 1);
    EXPECT_NEAR(coated, above, 0.1 * above);
    EXPECT_EQ(largest_difference(from_behind(satin(0.3)), 0, 0.0), 0.0); // negative control
}

// The camera sees light through the sheet that the sheet's own sampling found.
TEST(ThinCloth, EnvironmentIsSeenThroughIt) {
    Scene scene = lit_sheet(thin(lambert(0.2), 0.5), false);
    scene.lights.clear();
    scene.environment = Environment{.radiance = 2};
    EXPECT_NEAR(*render(scene, quick(256)).image.pixel(0, 2, 2), 1.4, 1e-3);
}

Scene shot_sheet(double weft, double warp) {
    Fabric fabric = satin(0);
    fabric.colours.weft_tint = Spectrum::constant(weft);
    fabric.colours.warp_tint = Spectrum::constant(warp);
    return lit_sheet(fabric, false);
}

TEST(ShotCloth, SystemsAddUpToTheWhole) {
    const auto value = [](const Scene &scene) {
        return *render(scene, quick(256)).image.pixel(0, 1, 1);
    };
    const float weft = value(shot_sheet(1, 0)), warp = value(shot_sheet(0, 1));
    EXPECT_GT(weft, 1e-4f);
    EXPECT_GT(warp, 1e-4f);
    const float whole = value(lit_sheet(satin(0), false));
    EXPECT_NEAR(weft + warp, whole, 1e-5f * whole);
    EXPECT_NEAR(value(shot_sheet(0.5, 0.5)), 0.5f * whole, 1e-5f * whole);
}

// The normals of filaments along the warp lie in the plane across it: where light and view ask for
// one there the cloth has the warp's colour, and the weft's after a quarter turn.
TEST(ShotCloth, ColourTurnsWithTheCloth) {
    const auto weft_share = [](bool turned) {
        const auto value = [&](double weft, double warp) {
            Scene scene = shot_sheet(weft, warp);
            std::get<RectangleLight>(scene.lights[0]).corner = {0.8, 1.5, -0.1};
            std::get<RectangleLight>(scene.lights[0]).edge_u = {0.2, 0, 0};
            std::get<RectangleLight>(scene.lights[0]).edge_v = {0, 0, 0.2};
            scene.camera.eye = {0, 1.2, 0.01};
            if (turned) // warp along x
                scene.surfaces[0].warp.assign(4, {1, 0, 0});
            return *render(scene, quick(256)).image.pixel(0, 1, 1);
        };
        return value(1, 0) / (value(1, 0) + value(0, 1));
    };
    EXPECT_GT(weft_share(true), weft_share(false) + 0.3f);
}

} // namespace
