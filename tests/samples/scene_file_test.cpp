#include "tsuya/scene/scene_file.h"

#include <atomic>
#include <regex>

#include <gtest/gtest.h>

#include "garment/expect_stops.h"
#include "samples/scratch.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/plan.h"

namespace tsuya::scene {
namespace {

SceneFile read(const Scratch &scratch, const std::string &text) {
    scratch.write("cloth.obj", cloth_obj());
    return read_scene_file(scratch.write("a.scene.toml", text));
}

TEST(SceneFile, HasDefaults) {
    const Scratch scratch;
    const SceneFile file =
        read(scratch, "[fabrics.silk]\n[garments.cloth]\nmesh = \"cloth.obj\"\nfabric = \"silk\"\n"
                      "[environment]\n");
    EXPECT_FALSE(file.camera);
    EXPECT_EQ(file.framing.width, 800);
    EXPECT_EQ(file.framing.height, 1000);
    EXPECT_NEAR(file.framing.azimuth, 25 * kDegree, 1e-12);
    ASSERT_EQ(file.garments.size(), 1u);
    EXPECT_TRUE(file.garments[0].visible);
    EXPECT_TRUE(file.garments[0].options.want_frames);
    EXPECT_EQ(file.garments[0].options.metres_per_unit, 1);
    EXPECT_FALSE(file.garments[0].options.unit_stated);
    EXPECT_EQ(file.garments[0].options.subdivide.level, 1);
    EXPECT_FALSE(file.fabrics[0].dye);
    EXPECT_TRUE(file.fabrics[0].file.empty());
    EXPECT_FALSE(file.backdrop);
    ASSERT_TRUE(file.environment);
    EXPECT_EQ(file.environment->radiance, 1);
    EXPECT_EQ(file.light_groups, std::vector<std::string>{"environment"});
    EXPECT_EQ(file.render.stop.samples_per_pixel, StopRule{}.samples_per_pixel);
    EXPECT_TRUE(file.output.lamps.empty());
    EXPECT_EQ(file.output.look.view, "Soft");
}

TEST(SceneFile, ADyeMayStayOpen) {
    const Scratch scratch;
    const std::string rest = "[garments.cloth]\nmesh = \"cloth.obj\"\nfabric = \"silk\"\n"
                             "[environment]\n";
    const SceneFile file =
        read(scratch, "[fabrics.lining]\n[fabrics.silk]\ndye = \"any\"\n" + rest);
    const Scene scene = build_scene(file).scene;
    ASSERT_EQ(scene.open_dyes.size(), 1u);
    EXPECT_EQ(scene.fabrics[scene.open_dyes[0].value].name, "silk");
    EXPECT_TRUE(scene.fabrics[scene.open_dyes[0].value].colours.any_dye());
    EXPECT_EQ(plan(scene, file.render).dyes.size(), 1u);
}

TEST(SceneFile, BuildsAScene) {
    const Scratch scratch;
    const BuiltScene built = build_scene(read(scratch, small_scene("[backdrop]\n")));
    const Scene &scene = built.scene;
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[0].name, "cloth");
    EXPECT_EQ(scene.light_groups, (std::vector<std::string>{"key", "fill"}));
    EXPECT_EQ(scene.environment->group, LightGroupIndex{1});
    EXPECT_EQ(scene.camera.width, 16);
    EXPECT_FALSE(scene.surfaces[0].warp.empty());
    EXPECT_FALSE(scene.fabrics[0].colours.dye.is_constant());
    // The camera frames the cloth
    const glm::dvec3 pixel = project_point(scene.camera, {0, 0.3, 0});
    EXPECT_NEAR(pixel.x, 8, 1);
    EXPECT_NEAR(pixel.y, 10, 1);
}

/// What loading a mesh reports; the order of both builders below.
const std::vector<std::string> kLoading{
    "garment: repair",  "garment: join seams", "garment: measure", "subdivide: topology",
    "subdivide: rates", "subdivide",           "garment: frames"};

TEST(SceneFile, BuildingStopsInEveryStage) {
    const Scratch scratch;
    const SceneFile file = read(scratch, small_scene());
    std::vector<std::string> stages{"garment: read"};
    stages.insert(stages.end(), kLoading.begin(), kLoading.end());
    tsuya::test::expect_stops_in_every_stage([&](const Progress &p) { build_scene(file, p); },
                                             stages);
}

TEST(SceneFile, ReadingPanelNamesStops) {
    const Scratch scratch;
    const std::atomic<bool> stop = true;
    std::string text = small_scene();
    text.replace(text.find("fabric = \"silk\""), 15, "fabric = \"silk\"\ngrain.panel = 3");
    const SceneFile file = read(scratch, text);
    EXPECT_THROW(read_scene_file(file.path, {.stop = &stop}), Interrupted);
}

TEST(SceneFile, APixelToleranceIsOfTheScenesCamera) {
    const Scratch scratch;
    const auto mesh = (data_folder() / "dress" / "dress.obj").string();
    const auto triangles = [&](const std::string &camera, const std::string &garment,
                               const std::string &light = "[environment]\n") {
        const BuiltScene built = build_scene(
            read(scratch, "[camera]\n" + camera + "[fabrics.silk]\n[garments.dress]\nmesh = \"" +
                              mesh + "\"\nfabric = \"silk\"\n" + garment + light));
        EXPECT_EQ(built.reports.at(0).report.limit_triangles,
                  built.scene.surfaces.at(0).triangle.size());
        return built.scene.surfaces.at(0).triangle.size();
    };
    const std::string near = "eye = [0, 1.2, 0.5]\ntarget = [0, 1.2, 0]\n",
                      away = "eye = [0, 1.2, 0.5]\ntarget = [0, 1.2, 1]\n",
                      fine = "tolerance_px = 0.25\n";
    const std::size_t control = triangles(near, "level = 0\n");
    // Faces that the camera does not see stay as coarse as the control mesh.
    EXPECT_EQ(triangles(away, fine), control);
    const std::size_t seen = triangles(near, fine);
    EXPECT_GT(seen, control + control / 10);
    EXPECT_LT(seen, 4 * control);
    // The picture moves with the mesh.
    EXPECT_NEAR(static_cast<double>(triangles("eye = [3, 1.2, 0.5]\ntarget = [3, 1.2, 0]\n",
                                              fine + "translate = [3, 0, 0]\n")),
                static_cast<double>(seen), 1e-3 * static_cast<double>(seen));
    // A light behind the dress throws shadows before the camera that looks away.
    EXPECT_GT(triangles(away, fine, "[lights.k]\ncentre = [0, 1.2, -3]\ntarget = [0, 1.2, 0]\n"),
              control + control / 10);
    // Without an eye, the camera frames the dress as level 1 divides it.
    EXPECT_GT(triangles("", "tolerance_px = 0.1\n"), triangles("", "tolerance_px = 1\n"));
}

TEST(SceneFile, ReadsEveryKey) {
    const Scratch scratch;
    scratch.write("flat.csv", "wavelength_nm,value\n400,0.5\n700,0.5\n");
    const SceneFile file = read(
        scratch,
        "[camera]\neye = [1, 2, 3]\ntarget = [0, 1, 0]\nup = [0, 0, 1]\nvertical_angle_deg = 30\n"
        "shift = [0.1, -0.2]\nf_number = 4\nsensor_height_mm = 24\nfocus_distance = 2.5\n"
        "aperture_blades = 6\n"
        "[fabrics.a]\ndye = \"flat.csv\"\nf0 = 0.1\ntransmittance = 0.2\nweft_tint = \"#ff0000\"\n"
        "warp_dye = 0.3\nlustre = \"dull\"\ndelustre = 0.4\n"
        "warp_tint = \"flat.csv\"\nspecular_tint = 0.9\n[fabrics.b]\nreflectance = 0.25\n"
        "[garments.g]\nmesh = \"cloth.obj\"\nfabric = \"b\"\nunit = \"mm\"\nup = \"z\"\nlevel = 3\n"
        "tolerance_px = 0.5\nsewing_tolerance_mm = 0.25\nstrict = true\nmax_degenerate_area = "
        "0.5\nseam_crease = 3\n"
        "fold_crease = 4\nfold_angle_deg = 30\ntranslate = [1, 2, 3]\nvisible = "
        "false\nmetres_per_uv = "
        "2\ndefault_grain_deg = 90\n"
        "invented_grain_deg = 45\ngrain.panel = 30\n"
        "[bodies.b]\nmesh = \"cloth.obj\"\nfabric = \"a\"\n"
        "[backdrop]\ncentre = [1, 0, 0]\nazimuth_deg = 90\nwidth = 5\nfront = 2\nback = 3\n"
        "height = 4\nradius = 1\nreflectance = 0.3\n"
        "[lights.k]\ncentre = [0, 1, 2]\ntarget = [0, 1, 0]\nwidth = 2\nheight = 3\nradiance = 7\n"
        "group = \"sun\"\n"
        "[environment]\nradiance = 0.5\ngroup = \"sun\"\nvisible = false\n"
        "[render]\nerror = 0.02\nseconds = 5\nchannels = 8\nmax_bounces = 3\nseed = "
        "4294967295\ndenoise = true\nwiden_after_diffuse = false\n"
        "aovs = [\"depth\"]\n"
        "[output]\nlamps = [\"A\", \"D65\"]\nadapt = \"cat02\"\nview = \"Plain\"\nexposure = -1\n"
        "alpha = true\n");
    ASSERT_TRUE(file.camera);
    EXPECT_EQ(file.camera->eye, glm::dvec3(1, 2, 3));
    EXPECT_EQ(file.camera->up, glm::dvec3(0, 0, 1));
    EXPECT_NEAR(file.camera->vertical_angle, 30 * kDegree, 1e-12);
    EXPECT_EQ(file.camera->shift, glm::dvec2(0.1, -0.2));
    EXPECT_EQ(file.camera->lens->f_number, 4);
    EXPECT_NEAR(file.camera->lens->sensor_height, 0.024, 1e-12);
    EXPECT_EQ(file.camera->lens->focus_distance, 2.5);
    EXPECT_EQ(file.camera->lens->blades, 6);
    EXPECT_NEAR(file.fabrics[0].dye->at(500), 0.5, 1e-12);
    EXPECT_EQ(file.fabrics[0].transmittance, Spectrum::constant(0.2));
    EXPECT_EQ(file.fabrics[0].warp_dye, Spectrum::constant(0.3));
    EXPECT_EQ(file.fabrics[0].lustre, Lustre::dull);
    EXPECT_EQ(file.fabrics[0].delustre, 0.4);
    EXPECT_GT(file.fabrics[0].weft_tint->at(650), 2 * file.fabrics[0].weft_tint->at(450));
    EXPECT_NEAR(file.fabrics[0].warp_tint->at(500), 0.5, 1e-12);
    EXPECT_EQ(file.fabrics[0].specular_tint, Spectrum::constant(0.9));
    EXPECT_FALSE(file.fabrics[1].transmittance || file.fabrics[1].weft_tint);
    EXPECT_EQ(file.fabrics[0].f0, 0.1);
    EXPECT_EQ(file.fabrics[1].dye->at(500), 0.25);
    const MeshEntry &garment = file.garments.at(0);
    EXPECT_EQ(garment.fabric, 1u);
    EXPECT_EQ(garment.options.metres_per_unit, 0.001);
    EXPECT_TRUE(garment.options.unit_stated);
    EXPECT_EQ(garment.options.up, garment::UpAxis::z);
    EXPECT_EQ(garment.options.subdivide.level, 3);
    EXPECT_EQ(garment.tolerance_px, 0.5);
    EXPECT_TRUE(garment.options.strict);
    EXPECT_EQ(garment.options.seams.tolerance, 0.25e-3);
    EXPECT_EQ(garment.options.frames.max_degenerate_area, 0.5);
    EXPECT_EQ(garment.options.subdivide.seam_crease, 3);
    EXPECT_EQ(garment.options.subdivide.fold_crease, 4);
    EXPECT_NEAR(garment.options.subdivide.fold_angle, 30 * kDegree, 1e-12);
    EXPECT_EQ(garment.translate, glm::dvec3(1, 2, 3));
    EXPECT_FALSE(garment.visible);
    EXPECT_EQ(garment.options.metres_per_uv, 2.0);
    EXPECT_NEAR(garment.options.frames.default_grain, 90 * kDegree, 1e-12);
    EXPECT_NEAR(*garment.options.frames.invented_grain, 45 * kDegree, 1e-12);
    EXPECT_NEAR(garment.options.frames.grain.at("panel"), 30 * kDegree, 1e-12);
    EXPECT_FALSE(file.bodies.at(0).options.want_frames);
    EXPECT_EQ(file.bodies.at(0).fabric, 0u);
    EXPECT_NEAR(file.backdrop->shape.azimuth, 90 * kDegree, 1e-12);
    EXPECT_EQ(file.backdrop->shape.back, 3);
    EXPECT_EQ(file.backdrop->reflectance.at(500), 0.3);
    const auto &light = std::get<RectangleLight>(file.lights.at(0));
    EXPECT_EQ(light.radiance, 7);
    EXPECT_NEAR(glm::length(light.edge_v), 3, 1e-12);
    EXPECT_EQ(file.light_groups, std::vector<std::string>{"sun"});
    EXPECT_FALSE(file.environment->visible);
    EXPECT_EQ(file.render.stop.relative_error, 0.02);
    EXPECT_EQ(file.render.stop.seconds, 5.0);
    EXPECT_EQ(file.render.channels, 8);
    EXPECT_EQ(file.render.max_bounces, 3);
    EXPECT_TRUE(file.render.denoise);
    EXPECT_FALSE(file.render.widen_after_diffuse);
    EXPECT_EQ(file.render.seed, 4294967295u); // as --seed
    EXPECT_EQ(file.render.aovs, std::vector<std::string>{"depth"});
    EXPECT_EQ(file.output.lamps.at(1).name, "D65");
    EXPECT_EQ(file.output.look.adapt, Adaptation::cat02);
    EXPECT_EQ(file.output.look.view, "Plain");
    EXPECT_EQ(file.output.look.exposure_stops, -1);
    EXPECT_FALSE(file.output.metered);
    EXPECT_TRUE(file.output.alpha);
    EXPECT_TRUE(read(scratch, small_scene("[output]\nexposure = \"metered\"\n")).output.metered);
}

TEST(SceneFile, PicturesWithAlphaHaveNoBackdrop) {
    const Scratch scratch;
    const auto objects = [&](const std::string &output) {
        return build_scene(read(scratch, small_scene("[bodies.board]\nmesh = \"cloth.obj\"\n"
                                                     "fabric = \"silk\"\n[backdrop]\n" +
                                                     output)))
            .scene.objects;
    };
    const std::vector<Object> all = objects(""), shown = objects("[output]\nalpha = true\n");
    ASSERT_EQ(all.size(), 3u);
    ASSERT_EQ(shown.size(), 2u);
    EXPECT_TRUE(shown[0].garment);
    EXPECT_FALSE(shown[1].garment);
    EXPECT_FALSE(all[2].garment);
    // Nor that of a studio
    std::string text = "studio = \"softbox\"\n" + small_scene();
    EXPECT_EQ(build_scene(read(scratch, text)).scene.objects.size(), 2u);
    text += "[output]\nalpha = true\n";
    EXPECT_EQ(build_scene(read(scratch, text)).scene.objects.size(), 1u);
}

TEST(SceneFile, CamerasFrameWithTheirOptics) {
    const Scratch scratch;
    const auto camera = [&](const std::string &keys) {
        std::string text = small_scene();
        text.replace(text.find("width = 16"), 10, "width = 16\n" + keys);
        return build_scene(read(scratch, text)).scene.camera;
    };
    const Camera sharp = camera("f_number = 2.8\nfocus = [0, 0.3, 0.2]\n");
    EXPECT_NEAR(*sharp.lens->focus_distance, distance_along_view(sharp, {0, 0.3, 0.2}), 1e-12);
    EXPECT_LT(*sharp.lens->focus_distance, glm::distance(sharp.eye, sharp.target));
    EXPECT_FALSE(camera("f_number = 2.8\n").lens->focus_distance) << "the target's";
    // 0.6 m with 8 % free
    const Camera parallel = camera("projection = \"orthographic\"\nazimuth_deg = 0\n"
                                   "elevation_deg = 0\n");
    EXPECT_NEAR(*parallel.orthographic_height, 0.6 / 0.92, 1e-9);
    EXPECT_EQ(
        camera("projection = \"orthographic\"\northographic_height = 3\n").orthographic_height, 3);
    // Behind the camera
    std::string text = small_scene();
    text.replace(text.find("width = 16"), 10, "width = 16\nf_number = 2\nfocus = [0, 0, 1000]\n");
    EXPECT_THROW(build_scene(read(scratch, text)), Error);
}

TEST(SceneFile, ReadsThatOfTheSamples) {
    const SceneFile file = read_scene_file(data_folder() / "scenes" / "dress.scene.toml");
    EXPECT_EQ(file.garments.size(), 1u);
    EXPECT_EQ(file.output.lamps.size(), 3u);
}

// Where nothing looks at f0, one that is given would be lost without a word.
TEST(SceneFile, F0IsRefusedWhereNothingLooksAtIt) {
    const Scratch scratch;
    const auto build = [&](const std::string &fabric) {
        return build_scene(read(scratch, small_scene("[fabrics.other]\nf0 = 0.125\n" + fabric)));
    };
    const std::string start = "schema = \"tsuya-fabric 1\"\nname = \"f\"\n";
    scratch.write("ggx.fabric.toml",
                  start + "model = \"ggx\"\n[ggx]\nalpha_weft = 0.2\nalpha_warp = 0.2\n");
    for (const std::string fabric : {"", "file = \"ggx.fabric.toml\"\n"})
        try {
            build(fabric);
            ADD_FAILURE() << fabric;
        } catch (const Error &error) {
            const Problem &p = error.problems()[0];
            EXPECT_EQ(p.where, (scratch / "a.scene.toml").string() + ":17:1: fabrics.other.f0");
            EXPECT_NE(p.accepted.find("takeda"), std::string::npos) << p.accepted;
        }
    const auto satin = data_folder() / "fabrics" / "black_satin.fabric.toml";
    const BuiltScene built = build("file = \"" + satin.string() + "\"\n");
    EXPECT_EQ(std::get<CarriedViews>(built.scene.fabrics.back().specular).f0, 0.125);
}

// A body has no yarn directions: a fabric that reflects otherwise when it is turned is refused on
// it, whether or not it has views.
TEST(SceneFile, BodiesHaveNoFabricWithAGrain) {
    const Scratch scratch;
    scratch.write("cloth.obj", cloth_obj());
    const auto where = [&](const std::string &facets) {
        scratch.write("f.fabric.toml",
                      "schema = \"tsuya-fabric 1\"\nname = \"f\"\nmodel = \"ggx\"\n[ggx]\n" +
                          facets);
        try {
            build_scene(read(scratch, small_scene("[fabrics.hard]\n"
                                                  "file = \"f.fabric.toml\"\n"
                                                  "[bodies.board]\n"
                                                  "mesh = \"cloth.obj\"\n"
                                                  "fabric = \"hard\"\n")));
        } catch (const Error &error) {
            return error.problems()[0].where;
        }
        return std::string("accepted");
    };
    const std::string refused = where("alpha_weft = 0.05\nalpha_warp = 0.6\n");
    EXPECT_TRUE(
        std::regex_match(refused, std::regex(".*/a\\.scene\\.toml:\\d+:\\d+: bodies\\.board")))
        << refused;
    EXPECT_EQ(where("alpha_weft = 0.2\nalpha_warp = 0.2\n"), "accepted");
}

// By their names and lines in the file, not by their place in the renderer's arrays.
TEST(SceneFile, LightsAreNamedAsInTheFile) {
    const Scratch scratch;
    scratch.write("cloth.obj", cloth_obj());
    const SceneFile file =
        read(scratch, small_scene("[lights.\"far away\"]\ncentre = [9e5, 0, 0]\nradiance = 0\n"));
    ASSERT_EQ(file.lights.size(), 2u);
    EXPECT_EQ(name_of(file.lights[1]), "far away");
    EXPECT_NE(
        explain(plan(build_scene(file).scene, file.render)).find("off  dark lights: 'far away'"),
        std::string::npos);
    SceneFile wrong = file;
    auto &light = std::get<RectangleLight>(wrong.lights[1]);
    light.radiance = -1;
    light.corner.x = 1e30;
    try {
        build_scene(wrong);
        ADD_FAILURE() << "accepted";
    } catch (const Error &error) {
        ASSERT_EQ(error.problems().size(), 2u);
        const std::string place = file.light_places[1] + ": lights.far away";
        EXPECT_EQ(error.problems()[0].where, place);
        EXPECT_EQ(error.problems()[1].where, place + ".radiance");
        EXPECT_EQ(place.rfind((scratch / "a.scene.toml").string() + ":", 0), 0u) << place;
    }
}

} // namespace
} // namespace tsuya::scene
