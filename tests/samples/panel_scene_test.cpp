// Fabrics by panel in scene files and try-ons.

#include <gtest/gtest.h>

#include <sstream>

#include "samples/scratch.h"
#include "tsuya/color/image_file.h"
#include "tsuya/garment/mesh_file.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/export.h"
#include "tsuya/scene/scene_file.h"
#include "tsuya/scene/tryon.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

// Two pieces of cloth and a button without UV.
std::string coat_obj() {
    std::string text;
    for (const char *const piece : {"g Front\nusemtl satin\n", "g Back\nusemtl satin\n"})
        text += std::string("v -0.2 0 0\nv 0.2 0 0\nv 0.2 0.6 0\nv -0.2 0.6 0\nvt 0 0\nvt 0.4 0\n"
                            "vt 0.4 0.6\nvt 0 0.6\n") +
                piece + "f -4/-4 -3/-3 -2/-2 -1/-1\n";
    return text + "v 0 0.3 0.1\nv 0.2 0.3 0.1\nv 0.2 0.5 0.1\nv 0 0.5 0.1\n"
                  "g Button1\nusemtl horn\nf -4 -3 -2 -1\n";
}

std::string coat_scene(const std::string &garment) {
    return "[camera]\nwidth = 16\nheight = 20\n"
           "[fabrics.silk]\ndye = \"crimson\"\nfile = \"satin.toml\"\n[fabrics.lining]\n"
           "[fabrics.horn]\nreflectance = 0.1\n[environment]\n"
           "[garments.coat]\nmesh = \"coat.obj\"\nfabric = \"silk\"\n" +
           garment;
}

struct PanelScene : testing::Test {
    SceneFile read(const std::string &garment) const {
        scratch.write("coat.obj", coat_obj());
        std::filesystem::copy_file(find_fabric("black_satin", data_folder()),
                                   scratch / "satin.toml",
                                   std::filesystem::copy_options::overwrite_existing);
        return read_scene_file(scratch.write("a.scene.toml", coat_scene(garment)));
    }
    Object coat(const std::string &garment) const {
        return build_scene(read(garment)).scene.objects.at(0);
    }
    std::string problem(const std::string &garment) const {
        try {
            coat(garment);
        } catch (const Error &error) {
            return error.what();
        }
        return "accepted";
    }

    Scratch scratch{};
};

std::vector<std::pair<std::uint32_t, std::uint32_t>> fabrics_of(const Object &object) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
    for (const PanelFabric &panel : object.panels)
        all.emplace_back(panel.panel, panel.fabric.value);
    return all;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

TEST_F(PanelScene, PanelsHaveFabricsOfTheirOwn) {
    const Object object = coat("back = \"lining\"\n[garments.coat.panels.\"But*\"]\n"
                               "fabric = \"horn\"\n");
    EXPECT_EQ(object.fabric.value, 0u);
    ASSERT_TRUE(object.back);
    EXPECT_EQ(object.back->value, 1u);
    EXPECT_EQ(fabrics_of(object), (Pairs{{2, 2}}));
    EXPECT_FALSE(object.panels[0].back); // a button has no lining
    // Cloth is lined as the garment is
    EXPECT_EQ(coat("back = \"lining\"\n[garments.coat.panels.horn]\nfabric = \"horn\"\n"
                   "[garments.coat.panels.Back]\nfabric = \"silk\"\n")
                  .panels[0]
                  .back->value,
              1u);
    // By material, and the last counts
    EXPECT_EQ(fabrics_of(coat("[garments.coat.panels.\"*\"]\nfabric = \"horn\"\n"
                              "[garments.coat.panels.satin]\nfabric = \"silk\"\n"
                              "[garments.coat.panels.Back]\nfabric = \"lining\"\n")),
              (Pairs{{0, 0}, {1, 1}, {2, 2}}));
}

TEST_F(PanelScene, APanelMayHaveAnotherBackOrGrain) {
    const std::string horn = "[garments.coat.panels.horn]\nfabric = \"horn\"\n";
    const Object object = coat(horn + "[garments.coat.panels.Front]\nback = \"lining\"\n");
    ASSERT_EQ(object.panels.size(), 2u);
    EXPECT_EQ(object.panels[0].fabric.value, 0u);
    ASSERT_TRUE(object.panels[0].back);
    EXPECT_EQ(object.panels[0].back->value, 1u);
    const Scene turned =
        build_scene(read(horn + "[garments.coat.panels.\"F*\"]\ngrain_deg = 90\n")).scene;
    const Surface &surface = turned.surfaces[0];
    for (std::size_t t = 0; t < surface.triangle.size(); ++t) {
        const glm::vec3 warp = surface.warp[surface.triangle[t].x];
        if (surface.panel[t] < 2) { // not the button
            EXPECT_NEAR(std::abs(surface.panel[t] == 0 ? warp.x : warp.y), 1, 1e-5);
        }
    }
}

TEST_F(PanelScene, OfIslands) {
    EXPECT_EQ(fabrics_of(coat("[garments.coat.panels.horn]\nfabric = \"horn\"\n"
                              "[garments.coat.panels.island1]\nfabric = \"lining\"\n")),
              (Pairs{{1, 1}, {2, 2}}));
}

TEST_F(PanelScene, GrainIsKeptWhereIslandsAreNamed) {
    const Scene scene = build_scene(read("grain.Front = 90\n[garments.coat.panels.horn]\n"
                                         "fabric = \"horn\"\n[garments.coat.panels.\"isl*1\"]\n"
                                         "fabric = \"lining\"\n"))
                            .scene;
    EXPECT_EQ(fabrics_of(scene.objects[0]), (Pairs{{1, 1}, {2, 2}}));
    const Surface &surface = scene.surfaces[0];
    for (std::size_t t = 0; t < surface.triangle.size(); ++t)
        if (surface.panel[t] == 0) {
            EXPECT_NEAR(std::abs(surface.warp[surface.triangle[t].x].x), 1, 1e-5);
        }
}

TEST_F(PanelScene, ABodyMayBePrinted) {
    write_png(scratch / "a.png", Image::make(4, 2, {"R", "G", "B"}));
    const std::string scene = "[garments.coat.panels.Button1]\nfabric = \"horn\"\n"
                              "[bodies.b]\nmesh = \"cloth.obj\"\nfabric = \"horn\"\n"
                              "pattern = { picture = \"a.png\", width_m = 0.1 }\n";
    scratch.write("cloth.obj", cloth_obj());
    const Scene built = build_scene(read(scene)).scene;
    EXPECT_TRUE(built.objects[1].print);
    EXPECT_FALSE(built.surfaces[1].uv.empty());
}

TEST_F(PanelScene, WhatNamesNothingIsRefusedWithTheNearest) {
    const std::string what = problem("[garments.coat.panels.Frnt]\nfabric = \"horn\"\n");
    EXPECT_NE(what.find("no panel is named 'Frnt'"), std::string::npos) << what;
    EXPECT_NE(what.find("Front"), std::string::npos) << what;
    EXPECT_NE(what.find("a.scene.toml:"), std::string::npos) << what;
    EXPECT_NE(problem("[garments.coat.panels.Front]\nfabric = \"hron\"\n").find("horn"),
              std::string::npos);
    EXPECT_NE(problem("[garments.coat.panels.Front]\nfabrik = \"horn\"\n").find("fabric"),
              std::string::npos);
    // The button has no UV, and a satin needs one
    EXPECT_NE(problem("").find("no usable UV"), std::string::npos);
}

TEST_F(PanelScene, PatternsAreOfPanelsGarmentsAndFabrics) {
    write_png(scratch / "a.png", Image::make(4, 2, {"R", "G", "B"}));
    const std::string picture = "picture = \"a.png\"\n";
    const std::string horn = "[garments.coat.panels.Button1]\nfabric = \"horn\"\n";
    const Scene scene =
        build_scene(read("[garments.coat.pattern]\nwidth_m = 0.64\norigin_m = [0.1, 0.2]\n"
                         "turn_deg = 90\nrepeat = \"mirror\"\n" +
                         picture + horn + "[garments.coat.panels.Front.pattern]\nwidth_m = 0.4\n" +
                         "repeat = \"once\"\n[garments.coat.panels.Front.pattern.screens.a]\n" +
                         picture + "dye = \"indigo\"\n"))
            .scene;
    ASSERT_EQ(scene.prints.size(), 2u);
    const Object &coat = scene.objects[0];
    ASSERT_TRUE(coat.print);
    const Print &whole = scene.prints[coat.print->value];
    EXPECT_EQ(whole.placement.width, 0.64);
    EXPECT_EQ(whole.placement.origin, glm::dvec2(0.1, 0.2));
    EXPECT_NEAR(whole.placement.turn, kPi / 2, 1e-12);
    EXPECT_EQ(whole.placement.repeat, Repeat::mirror);
    EXPECT_EQ(whole.layers[0].inks.size(), 8u);
    ASSERT_EQ(coat.panels.size(), 2u);
    EXPECT_EQ(scene.prints[coat.panels[0].print->value].layers[0].inks.size(), 1u);
    EXPECT_EQ(scene.textures[1].channels, 1);
    EXPECT_FALSE(coat.panels[1].print); // the button's fabric has none

    const Object printed =
        build_scene(read(horn + "[fabrics.silk.pattern]\nwidth_m = 1\n" + picture))
            .scene.objects[0];
    EXPECT_TRUE(printed.print);
    const Scene lace =
        build_scene(read(horn + "[garments.coat.panels.Front.opacity]\nwidth_m = 0.2\n" + picture))
            .scene;
    ASSERT_EQ(lace.objects[0].panels.size(), 2u);
    EXPECT_TRUE(lace.objects[0].panels[0].opacity);
    EXPECT_EQ(lace.textures[lace.opacities[0].picture.value].channels, 1);
    EXPECT_EQ(lace.opacities[0].placement.width, 0.2);
    EXPECT_NE(problem("[garments.coat.pattern]\nwidth_m = 1\n" + picture +
                      "[garments.coat.pattern.screens.a]\n" + picture + "dye = \"indigo\"\n")
                  .find("both given"),
              std::string::npos);
    EXPECT_NE(problem("[garments.coat.pattern]\n" + picture).find("width_m"), std::string::npos);
    EXPECT_NE(problem("[garments.coat.pattern]\nwidth_m = 1\nrepeat = \"twice\"\n" + picture)
                  .find("tile, mirror or once"),
              std::string::npos);
    EXPECT_NE(problem("[garments.coat.pattern]\nwidth_m = 1\npicture = \"b.png\"\n").find("b.png"),
              std::string::npos);
}

TEST_F(PanelScene, TryOn) {
    scratch.write("coat.obj", coat_obj());
    const auto fabric = [](const char *name) { return find_fabric(name, data_folder()); };
    TryOn job{.garment = scratch / "coat.obj",
              .fabric = fabric("black_satin"),
              .back = fabric("black_lining"),
              .panels = {{.panels = "Button*", .fabric = fabric("plastic")},
                         {.panels = "Back", .back = fabric("black_taffeta")}},
              .level = 0,
              .width = 16,
              .height = 20};
    const Scene scene = make_try_on_scene(job).scene;
    const Object &coat = scene.objects[0];
    EXPECT_EQ(scene.fabrics[coat.fabric.value].name, "black_satin");
    EXPECT_EQ(scene.fabrics[coat.back->value].name, "black_lining");
    ASSERT_EQ(coat.panels.size(), 2u);
    EXPECT_EQ(scene.fabrics[coat.panels[0].fabric.value].name, "black_satin");
    EXPECT_EQ(scene.fabrics[coat.panels[0].back->value].name, "black_taffeta");
    EXPECT_EQ(scene.fabrics[coat.panels[1].fabric.value].name, "plastic");
    job.panels = {{.panels = "Zip", .fabric = fabric("plastic")}};
    EXPECT_THROW(make_try_on_scene(job), Error);
}

TEST_F(PanelScene, IsExportedWithItsFabrics) {
    scratch.write("coat.obj", coat_obj());
    const auto fabric = [](const char *name) { return find_fabric(name, data_folder()); };
    const TryOn job{.garment = scratch / "coat.obj",
                    .fabric = fabric("black_satin"),
                    .panels = {{.panels = "Button*", .fabric = fabric("plastic")}},
                    .level = 0,
                    .dyes = {"#ff0000"}};
    const std::vector<ExportedFabric> exported = export_glb(job, scratch / "coat.glb");
    ASSERT_EQ(exported.size(), 2u);
    EXPECT_EQ(exported[0].name, "black_satin");
    EXPECT_GT(exported[0].anisotropy_strength, 0.3);
    EXPECT_GT(exported[0].l2_cos, 0.02);
    EXPECT_LT(exported[0].l2_cos, 0.6);
    // Facets are what viewers have
    EXPECT_EQ(exported[1].name, "plastic");
    EXPECT_NEAR(exported[1].roughness, std::sqrt(0.08), 1e-9);
    EXPECT_EQ(exported[1].anisotropy_strength, 0);
    EXPECT_LT(exported[1].l2_cos, 1e-6);
    const garment::MeshFile back = garment::read_mesh(scratch / "coat.glb");
    EXPECT_EQ(back.mesh.panel_name.size(), 3u);
    EXPECT_EQ(back.mesh.panel_label[2].material, "plastic");
    EXPECT_THROW(export_glb(job, scratch / "no" / "coat.glb"), Error);
    EXPECT_FALSE(std::filesystem::exists(scratch / "no"));
}

// Red warp and green weft have no dye in common.
TEST_F(PanelScene, ShotClothIsExportedInTheMeanOfItsDyes) {
    scratch.write("coat.obj", coat_obj());
    const TryOn job{.garment = scratch / "coat.obj",
                    .fabric = find_fabric("shot_silk", data_folder()),
                    .invented_grain = 0.0,
                    .level = 0,
                    .dyes = {}};
    export_glb(job, scratch / "coat.glb");
    const std::string glb = read_file(scratch / "coat.glb");
    const std::string key = "\"baseColorFactor\":[";
    const std::size_t at = glb.find(key);
    ASSERT_NE(at, std::string::npos);
    std::istringstream numbers(glb.substr(at + key.size(), 100));
    double red = 0, green = 0;
    char comma = 0;
    numbers >> red >> comma >> green;
    EXPECT_GT(red, 0.1);
    EXPECT_GT(green, 0.1);
}

} // namespace
} // namespace tsuya::scene
