#include "tsuya/scene/tryon.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "garment/expect_stops.h"
#include "samples/scratch.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/image_file.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/exposure.h"
#include "tsuya/scene/studio.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

namespace fs = std::filesystem;

TryOn small_job(const fs::path &output) {
    TryOn job = sample_try_on(data_folder());
    job.level = 0;
    job.width = 16;
    job.height = 20;
    job.render.stop.samples_per_pixel = 8;
    job.lamps = {"D65"};
    job.output = output;
    return job;
}

TEST(TryOn, LightsTheGarmentFromTheLeftOfThePicture) {
    for (const double azimuth : {0.0, 25.0, 140.0}) {
        TryOn job = small_job({});
        job.azimuth_deg = azimuth;
        const Scene scene = make_try_on_scene(job).scene;
        EXPECT_EQ(scene.light_groups, (std::vector<std::string>{"key", "fill"}));
        ASSERT_EQ(scene.lights.size(), 2u);
        const glm::dvec3 forward = scene.camera.target - scene.camera.eye;
        const glm::dvec3 right = glm::cross(forward, scene.camera.up);
        const auto centre_of = [&](const RectangleLight &box) {
            return box.corner + 0.5 * (box.edge_u + box.edge_v) - scene.camera.target;
        };
        const auto &key = std::get<RectangleLight>(scene.lights[0]),
                   &strip = std::get<RectangleLight>(scene.lights[1]);
        EXPECT_LT(glm::dot(centre_of(key), right), 0);
        EXPECT_GT(centre_of(key).y, 0);
        // The strip lights from the other side, much weaker.
        EXPECT_GT(glm::dot(centre_of(strip), right), 0);
        const glm::dvec3 &target = scene.camera.target;
        EXPECT_LT(irradiance(strip, target, glm::normalize(centre_of(strip))),
                  0.5 * irradiance(key, target, glm::normalize(centre_of(key))));
        EXPECT_EQ(key.group.value, 0u);
        EXPECT_EQ(strip.group.value, 0u);
    }
}

TEST(TryOn, PreparationStopsInEveryStage) {
    TryOn job = small_job({});
    job.tolerance_px = 2;
    std::vector<std::string> stages;
    const auto add = [&](bool read) {
        if (read)
            stages.emplace_back("garment: read");
        stages.insert(stages.end(),
                      {"garment: repair", "garment: join seams", "garment: measure",
                       "subdivide: topology", "subdivide: rates", "subdivide", "garment: frames"});
    };
    for (const bool read : {true, true, false, false}) // garment, body, and both as the camera sees
        add(read);
    tsuya::test::expect_stops_in_every_stage([&](const Progress &p) { make_try_on_scene(job, p); },
                                             stages);
}

TEST(TryOn, FramesTheWholeFigure) {
    const Scene scene = make_try_on_scene(small_job({})).scene;
    ASSERT_EQ(scene.objects.size(), 3u);
    for (const std::size_t surface : {0u, 1u})
        for (const glm::dvec3 &p : scene.surfaces[surface].position) {
            const glm::dvec3 pixel = project_point(scene.camera, p);
            ASSERT_GT(pixel.x, 0.03 * 16);
            ASSERT_LT(pixel.x, 0.97 * 16);
            ASSERT_GT(pixel.y, 0.03 * 20);
            ASSERT_LT(pixel.y, 0.97 * 20);
        }
}

TEST(TryOn, CoverageIsTheGarments) {
    const Scratch scratch;
    const TryOn job = small_job(scratch.folder());
    const RenderResult result = render_try_on(make_try_on_scene(job).scene, job.render);
    ASSERT_EQ(result.image.aov_names, std::vector<std::string>{"garment"});
    const Image &coverage = result.image.aovs[0];
    std::size_t covered = 0;
    for (const float v : coverage.data) {
        EXPECT_TRUE(v >= 0 && v <= 1) << v;
        covered += v == 1 ? 1 : 0;
    }
    EXPECT_GT(covered, 16u * 20u / 20u);
    EXPECT_LT(covered, 16u * 20u / 2u);
    EXPECT_EQ(*coverage.pixel(0, 0), 0);  // the wall
    EXPECT_EQ(*coverage.pixel(8, 14), 1); // the skirt
}

TEST(TryOn, WithoutABackdropPicturesHaveAlpha) {
    const Scratch scratch;
    TryOn job = small_job(scratch.folder());
    job.dyes = {"white"};
    job.backdrop = false;
    EXPECT_EQ(make_try_on_scene(job).scene.objects.size(), 2u); // garment and body
    run(job);
    const SpectralImage image = read_spectral_exr(scratch / "white.exr");
    ASSERT_TRUE(image.alpha);
    EXPECT_EQ(*image.alpha->pixel(0, 0), 0);
    EXPECT_NEAR(*image.alpha->pixel(8, 14), 1, 1e-5);
    EXPECT_EQ(image.pixel(1, 0, 0)[3], 0) << "the fill light is not seen";
    EXPECT_EQ(read_image(scratch / "white-D65.png").channels.size(), 4u);
}

TEST(TryOn, OneExposureIsMeteredForAllDyesAndLamps) {
    const Scratch scratch;
    TryOn job = small_job(scratch.folder());
    job.dyes = {"black", "white"};
    job.lamps = {"D65", "A"};
    job.metered = true;
    job.look.view = "Plain";
    const TryOnResult result = run(job);
    EXPECT_EQ(result.files.size(), 2u + 4u + 1u);
    DisplayOptions look = job.look;
    look.exposure_stops = result.exposure_stops;
    ExposureMeter white(job.look);
    for (const char *dye : {"black", "white"}) {
        const SpectralImage image = read_spectral_exr(scratch / (std::string(dye) + ".exr"));
        for (const NamedLamp &lamp : parse_lamps(job.lamps)) {
            const Image picture = picture_under(image, {&lamp, 1}, look);
            const Image file = read_image(scratch / (std::string(dye) + "-" + lamp.name + ".png"));
            EXPECT_NEAR(file.pixel(8, 14)[1], picture.pixel(8, 14)[1], 0.003f);
            if (dye == std::string("white"))
                white.add(image, {&lamp, 1});
        }
    }
    EXPECT_EQ(white.stops(), result.exposure_stops);
    EXPECT_NE(result.exposure_stops, 0);
}

TEST(TryOn, LooksThroughALensOrByParallelRays) {
    TryOn job = small_job({});
    job.lens = Lens{.f_number = 2};
    const Camera through = make_try_on_scene(job).scene.camera;
    EXPECT_EQ(through.lens->f_number, 2);
    EXPECT_NEAR(focus_distance(through), glm::distance(through.eye, through.target), 1e-12);
    job.lens.reset();
    job.orthographic = true;
    const Camera parallel = make_try_on_scene(job).scene.camera;
    EXPECT_GT(*parallel.orthographic_height, 1);
    EXPECT_FALSE(parallel.lens);
}

/// Departure of the garment's coverage from that of another picture, summed over the pixels.
double coverage_apart(const Image &a, const Image &b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i)
        sum += std::abs(a.data[i] - b.data[i]);
    return sum;
}

TEST(TryOn, APixelToleranceKeepsTheSilhouette) {
    const auto coverage = [](int level, std::optional<double> pixels) {
        TryOn job = small_job({});
        job.body.clear();
        job.level = level;
        job.tolerance_px = pixels;
        job.width = 64;
        job.height = 80;
        const Scene scene = [&] {
            Scene made = make_try_on_scene(job).scene;
            // Framed alike, so that the pictures can be compared.
            made.camera.eye = {0, 0.7, 4};
            made.camera.target = {0, 0.7, 0};
            return made;
        }();
        RenderResult result = render(scene, {.stop = {.samples_per_pixel = 32},
                                             .channels = 8,
                                             .max_bounces = 0,
                                             .aovs = {"garment"}});
        return std::pair(result.image.aovs.at(0), scene.surfaces[0].triangle.size());
    };
    const auto [truth, most] = coverage(2, {});
    const auto [within, fewer] = coverage(1, 0.03);
    const auto [coarse, fewest] = coverage(0, {});
    EXPECT_LT(fewer, most / 3);
    EXPECT_GT(fewer, fewest);
    EXPECT_LT(coverage_apart(within, truth), 0.5 * coverage_apart(coarse, truth));
}

TEST(TryOn, FramesGiveNumberedPictures) {
    const Scratch scratch;
    const auto cloth = [&](const char *name, const std::string &z) {
        std::string text = cloth_obj();
        text.replace(text.find("v 0.2 0.6 0"), 11, "v 0.2 0.6 " + z);
        return scratch.write(name, text);
    };
    TryOn job = small_job(scratch / "out");
    job.garment = cloth("cloth_0.obj", "0");
    job.frames = {cloth("cloth_1.obj", "0.3"), cloth("cloth_2.obj", "0")};
    job.body.clear();
    job.dyes = {"indigo"};
    const TryOnResult result = run(job);
    std::vector<std::string> names;
    for (const fs::path &file : result.files)
        names.push_back(file.filename().string());
    EXPECT_EQ(names, (std::vector<std::string>{"indigo-0000.exr", "indigo-D65-0000.png",
                                               "indigo-0001.exr", "indigo-D65-0001.png",
                                               "indigo-0002.exr", "indigo-D65-0002.png"}));
    const auto pixels = [&](std::size_t i) { return read_file(result.files.at(i)); };
    EXPECT_NE(pixels(1), pixels(3)); // it moves
    EXPECT_EQ(pixels(1), pixels(5)); // and comes back
    job.frames = {sample_try_on(data_folder()).garment};
    job.output = scratch / "other";
    EXPECT_THROW(run(job), Error);
    EXPECT_FALSE(fs::exists(job.output));
}

TEST(TryOn, StrictRefusesAGarmentWithAWarning) {
    const Scratch scratch;
    TryOn job = small_job(scratch / "out");
    job.body.clear();
    job.garment = scratch.write("cloth.obj", cloth_obj());
    job.strict = true;
    make_try_on_scene(job);
    job.garment = scratch.write("twice.obj", cloth_obj() + std::string("f 1/1 2/2 3/3 4/4\n"));
    EXPECT_THROW(make_try_on_scene(job), Error);
    job.strict = false;
    make_try_on_scene(job);
    // Half of the area without a UV.
    job.garment = scratch.write("half.obj", cloth_obj() + std::string("v 0.6 0.6 0\nv 0.6 0 0\n"
                                                                      "f 2 6 5 3\n"));
    EXPECT_THROW(make_try_on_scene(job), Error);
    job.max_degenerate_area = 1;
    make_try_on_scene(job);
}

TEST(TryOn, KeepsTheFabricsOwnDye) {
    const Scratch scratch;
    TryOn job = small_job(scratch.folder());
    job.dyes = {};
    const TryOnResult result = run(job);
    ASSERT_EQ(result.files.size(), 3u);
    EXPECT_EQ(result.files[0].filename(), "black_satin.exr");
}

TEST(TryOn, SavesWhatIsDoneWhereItIsStopped) {
    for (const bool wavelengths : {false, true}) {
        const Scratch scratch;
        std::atomic<bool> stop{false};
        Progress progress{.stop = &stop};
        progress.report = [&](std::string_view stage, double) {
            stop = stop || stage == (wavelengths ? "render white" : "render");
        };
        TryOn job = small_job(scratch.folder());
        job.render.stop.samples_per_pixel = 64;
        job.wavelengths = wavelengths;
        const TryOnResult result = run(job, progress);
        EXPECT_TRUE(result.interrupted);
        ASSERT_EQ(result.files.size(), wavelengths ? 2u : 4u); // of the first dye, or of both
        EXPECT_EQ(result.files[0].filename(), "white.exr");
        EXPECT_TRUE(fs::exists(result.files[1]));
        EXPECT_FALSE(fs::exists(scratch / "sheet.png"));
    }
}

// Also in a studio, whose lights have lamps of their own.
TEST(TryOn, MakesAPageOfAStudio) {
    const Scratch scratch;
    TryOn job = small_job(scratch.folder());
    job.studio = "shop";
    job.lamps = {"own"};
    job.dyes = {"white"};
    job.page = true;
    const TryOnResult result = run(job);
    ASSERT_EQ(result.files.back().filename(), "page.html");
    EXPECT_GT(fs::file_size(result.files.back()), 10000u);
    EXPECT_EQ(result.page_errors.size(), 1u);
}

TEST(TryOn, OneRenderServesAllDyes) {
    const Scratch scratch;
    TryOn job = small_job(scratch.folder());
    job.dyes = {"indigo", "white"};
    EXPECT_EQ(run(job).stats.size(), 1u);
    SpectralImage image = read_spectral_exr(scratch / "indigo.exr");
    ASSERT_TRUE(image.depths);
    ASSERT_EQ(image.depths->dyes.size(), 1u);
    EXPECT_TRUE(image.depths->dyes[0].open);
    EXPECT_EQ(image.depths->dyes[0].dye, dye("indigo"));
    // Any other dye, too
    const std::vector<std::string> white{"white"};
    show_dyes(image, white);
    EXPECT_EQ(image.depths, read_spectral_exr(scratch / "white.exr").depths);
    const std::vector<std::string> two{"white", "indigo"};
    EXPECT_THROW(show_dyes(image, two), Error);
    const std::vector<std::string> unknown{"no dress=white"};
    EXPECT_THROW(show_dyes(image, unknown), Error);
    // A print has colours of its own
    job.pattern = data_folder() / "prints" / "sakura.png";
    job.garment = scratch.write("cloth.obj", cloth_obj());
    job.body.clear();
    EXPECT_EQ(run(job).stats.size(), 2u);
    EXPECT_FALSE(read_spectral_exr(scratch / "white.exr").depths);
    EXPECT_THROW(show_dyes(image = read_spectral_exr(scratch / "white.exr"), white), Error);
}

TEST(TryOn, RefusesADyeNamedTwice) {
    const Scratch scratch;
    TryOn job = small_job(scratch / "new");
    job.dyes = {"indigo", "indigo"};
    EXPECT_THROW(run(job), Error);
    EXPECT_FALSE(fs::exists(scratch / "new"));
}

// The grain of a garment counts in every fabric that has one, with views or without.
TEST(TryOn, SeesTheGrainOfFabricsWithoutViews) {
    const Scratch scratch;
    std::string bias = cloth_obj();
    const std::string straight = "vt 0 0\nvt 0.4 0\nvt 0.4 0.6\nvt 0 0.6\n";
    bias.replace(bias.find(straight), straight.size(),
                 "vt 0 0\nvt 0.28284 0.28284\nvt -0.14142 0.70711\nvt -0.42426 0.42426\n");
    const std::string start = "schema = \"tsuya-fabric 1\"\nname = \"f\"\n";
    std::string weft, warp;
    for (int i = 0; i < kYarnSlopes; ++i) {
        weft += i == 0 ? "0" : i == kYarnSlopes / 2 ? ", 0.2" : ", 0";
        warp += i == 0 ? "0" : i == kYarnSlopes / 2 ? ", 1.2" : ", 0";
    }
    const auto picture = [&](const std::string &fabric, const std::string &garment) {
        TryOn job = small_job({});
        job.fabric = scratch.write("f.fabric.toml", start + fabric);
        job.garment = scratch.write("cloth.obj", garment);
        job.body.clear();
        job.unit = "m";
        const Scene scene = make_try_on_scene(job).scene;
        return std::pair(render(scene, job.render).image.transport, scene.surfaces[0].warp.size());
    };
    for (const std::string &fabric :
         {std::string("model = \"ggx\"\n[ggx]\nalpha_weft = 0.05\nalpha_warp = 0.6\nf0 = 0.3\n"),
          "[yarn]\nf0 = 0.05\nroughness = 0.08\neven = 0.02\npit_weft = 0\npit_warp = 0\n"
          "surface_weft = [" +
              weft + "]\nsurface_warp = [" + warp + "]\n"}) {
        EXPECT_NE(picture(fabric, cloth_obj()).first, picture(fabric, bias).first) << fabric;
        EXPECT_GT(picture(fabric, bias).second, 0u);
    }
    const std::string even = "model = \"ggx\"\n[ggx]\nalpha_weft = 0.3\nalpha_warp = 0.3\n";
    EXPECT_EQ(picture(even, bias).second, 0u) << "no directions are looked for";
}

} // namespace
} // namespace tsuya::scene
