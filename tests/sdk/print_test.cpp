// Pictures on cloth: how textures are filtered, and what a print shows.

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "mip_texture.h"
#include "sdk/render_scenes.h"
#include "tsuya/sdk/error.h"

namespace tsuya::test {
namespace {

// Black and white squares of one pixel.
Texture chequers(int width, int height) {
    Texture texture{.width = width, .height = height};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            texture.data.insert(texture.data.end(), 3, (x + y) % 2 == 0 ? 0 : 255);
    return texture;
}

Texture plain(std::array<std::uint8_t, 4> pixel, int channels = 4) {
    Texture texture{.width = 1, .height = 1, .channels = channels};
    texture.data.assign(pixel.begin(), pixel.begin() + channels);
    return texture;
}

TEST(MipTexture, ShowsPixelsCloseUpAndTheirMeanFromAfar) {
    const Texture texture = chequers(64, 32);
    const MipTexture mip(texture);
    // Middles of pixels; the first is in the upper left corner
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            EXPECT_EQ(mip.at({(static_cast<float>(x) + 0.5f) / 64,
                              1 - (static_cast<float>(y) + 0.5f) / 32},
                             1.0f / 64, Repeat::tile)
                          .x,
                      (x + y) % 2 == 0 ? 0 : 1);
    // The mean of linear light, within half a step of the code
    EXPECT_NEAR(mip.at({0.3f, 0.4f}, 0.5f, Repeat::tile).x, 0.5f, 0.003f);
    EXPECT_NEAR(mip.mean().y, 0.5f, 0.003f);
    // Between: from the pixel to the mean
    const float middle = mip.at({0.5f / 64, 1 - 0.5f / 32}, 1.5f / 64, Repeat::tile).x;
    EXPECT_GT(middle, 0.1f);
    EXPECT_LT(middle, 0.45f);
}

TEST(MipTexture, OfAnySizeKeepsItsMean) {
    for (const auto &[width, height] : {std::pair(7, 5), {1, 9}, {33, 2}, {100, 3}}) {
        Texture texture{.width = width, .height = height, .channels = 1};
        double sum = 0;
        for (int i = 0; i < width * height; ++i) {
            texture.data.push_back(static_cast<std::uint8_t>((i * 37) % 251));
            sum += texture.data.back() / 255.0;
        }
        EXPECT_NEAR(static_cast<double>(MipTexture(texture).mean().w), sum / (width * height),
                    0.006)
            << width << " x " << height;
    }
}

TEST(MipTexture, RepeatsAsAsked) {
    Texture texture{.width = 4, .height = 1, .channels = 1, .data = {0, 85, 170, 255}};
    const MipTexture mip(texture);
    const auto at = [&](float x, Repeat repeat) { return mip.at({x, 0.5f}, 0, repeat).w * 3; };
    EXPECT_NEAR(at(1.375f, Repeat::tile), 1, 1e-5);
    EXPECT_NEAR(at(-0.125f, Repeat::tile), 3, 1e-5);
    EXPECT_NEAR(at(1.375f, Repeat::mirror), 2, 1e-5);
    EXPECT_NEAR(at(-0.125f, Repeat::mirror), 0, 1e-5);
    EXPECT_NEAR(at(2.375f, Repeat::mirror), 1, 1e-5);
    EXPECT_EQ(at(1.375f, Repeat::once), 0);
    EXPECT_NEAR(at(0.99f, Repeat::once), 3, 1e-5);
    // Interpolated across the edge of a tile
    EXPECT_NEAR(at(1.0f, Repeat::tile), 1.5, 1e-5);
    // Far away there are still pixels
    EXPECT_NEAR(at(4096.375f, Repeat::tile), 1, 1e-3);
}

TEST(MipTexture, ColoursCountAsMuchAsTheyCover) {
    Texture texture{.width = 2, .height = 1, .channels = 4, .data = {255, 0, 0, 255, 0, 255, 0, 0}};
    const glm::vec4 mean = MipTexture(texture).mean();
    EXPECT_NEAR(mean.x, 1, 1e-3);
    EXPECT_NEAR(mean.y, 0, 1e-3);
    EXPECT_NEAR(mean.w, 0.5, 0.003);
}

// Eight inks that are told apart at one wavelength: the number of the corner over ten.
std::vector<Spectrum> inks() {
    std::vector<Spectrum> all;
    for (int i = 0; i < 8; ++i)
        all.push_back(Spectrum::constant(0.1 * i));
    return all;
}

// A floor with UVs in metres, (0, 0) in its middle, seen from straight above.
Scene printed_floor(const Fabric &fabric, Texture texture, std::vector<Spectrum> layer_inks) {
    Scene scene;
    scene.surfaces = {floor_square(2)};
    scene.surfaces[0].uv = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    scene.fabrics = {fabric};
    scene.textures = {std::move(texture)};
    scene.prints = {{.layers = {{.inks = std::move(layer_inks)}}}};
    scene.objects = {{"floor", {0}, {0}}};
    scene.objects[0].print = PrintIndex{0};
    scene.environment = Environment{.radiance = 1};
    scene.camera = {
        .eye = {0, 2, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .width = 16, .height = 16};
    scene.camera.vertical_angle = 2 * std::atan(0.25);
    return scene;
}

double value(const Scene &scene, int x = 7, int y = 7, int samples = 16) {
    return static_cast<double>(*render(scene, quick(samples)).image.pixel(0, x, y));
}

TEST(Print, ShowsItsInks) {
    for (int corner = 0; corner < 8; ++corner) {
        const auto code = [&](int bit) {
            return static_cast<std::uint8_t>((corner >> bit) & 1 ? 255 : 0);
        };
        EXPECT_NEAR(
            value(printed_floor(lambert(0.9), plain({code(0), code(1), code(2), 255}), inks())),
            0.1 * corner, 1e-4);
    }
    // 188 is half of 255 in linear light: half of red's 0.1
    EXPECT_NEAR(value(printed_floor(lambert(0.9), plain({188, 0, 0, 255}), inks())), 0.05, 3e-4);
    // What it does not cover has the dye of the cloth
    EXPECT_NEAR(value(printed_floor(lambert(0.9), plain({0, 0, 0, 102}), inks())), 0.54, 1e-3);
    EXPECT_NEAR(
        value(printed_floor(lambert(0.9), plain({51, 0, 0, 0}, 1), {Spectrum::constant(0.4)})),
        0.8 * 0.9 + 0.2 * 0.4, 1e-3);
}

TEST(Print, LiesInMetresOfCloth) {
    Texture texture{.width = 2, .height = 2, .data = {0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255}};
    Scene scene = printed_floor(lambert(0.9), texture, inks());
    Placement &placement = scene.prints[0].placement;
    placement = {.width = 0.8, .origin = {-0.4, -0.4}, .repeat = Repeat::once};
    // The picture of 1 m sees the middles of the four pixels at a fifth of its sides from the
    // middle
    const auto quarter = [&](double right, double up) {
        Scene seen = scene;
        seen.camera.target = {right, 0, -up};
        seen.camera.eye = {right, 2, -up};
        seen.camera.vertical_angle = 0.01;
        return value(seen);
    };
    EXPECT_NEAR(quarter(-0.2, 0.2), 0, 1e-3);
    EXPECT_NEAR(quarter(0.2, 0.2), 0.1, 1e-3);
    EXPECT_NEAR(quarter(-0.2, -0.2), 0.2, 1e-3);
    EXPECT_NEAR(quarter(0.2, -0.2), 0.4, 1e-3);
    EXPECT_NEAR(quarter(0.5, 0), 0.9, 1e-3); // beyond
    placement.turn = kPi / 2;
    placement.origin = {0.4, -0.4};
    EXPECT_NEAR(quarter(-0.2, -0.2), 0, 1e-3);
    EXPECT_NEAR(quarter(-0.2, 0.2), 0.1, 1e-3);
    placement.turn = 0;
    placement.origin = {-0.8, 0};
    placement.repeat = Repeat::tile;
    EXPECT_NEAR(quarter(0.2, 0.6), 0, 1e-3);
    placement.repeat = Repeat::mirror;
    EXPECT_NEAR(quarter(0.2, 0.6), 0.1, 1e-3);
}

// The dye of a print goes into the filaments as any dye does.
TEST(Print, OnSatinIsThatSatinDyed) {
    Scene printed = printed_floor(satin(0), plain({255, 0, 0, 255}),
                                  std::vector<Spectrum>(8, Spectrum::constant(0.4)));
    Scene dyed = printed;
    dyed.objects[0].print.reset();
    dyed.fabrics[0] = satin(0.4);
    const auto mean = [](const Scene &scene) {
        const std::vector<float> values = render(scene, quick(512)).image.transport;
        return std::accumulate(values.begin(), values.end(), 0.0) /
               static_cast<double>(values.size());
    };
    const double expected = mean(dyed);
    EXPECT_GT(expected, 0.2);
    EXPECT_NEAR(mean(printed), expected, 0.003 * expected);
}

// What a print leaves free has the dyes of the cloth's own yarns.
TEST(Print, LeavesShotClothShotWhereItDoesNotCover) {
    Fabric shot = satin(0);
    shot.colours.weft_dye = Spectrum{{400, 700}, {0.05, 0.6}};
    shot.colours.warp_dye = Spectrum{{400, 700}, {0.6, 0.05}};
    Scene printed = printed_floor(shot, plain({0, 0, 0, 255}), inks()); // black
    printed.prints[0].placement = {.width = 0.1, .origin = {5, 5}, .repeat = Repeat::once};
    Scene free = printed;
    free.objects[0].print.reset();
    const auto picture = render(printed, quick(256)).image.transport,
               expected = render(free, quick(256)).image.transport;
    for (std::size_t i = 0; i < picture.size(); i += 97)
        EXPECT_NEAR(picture[i], expected[i], 0.05f * expected[i]) << i;
}

TEST(Print, OfALiningIsSeenFromBehind) {
    Scene scene = printed_floor(lambert(0.9), plain({255, 0, 0, 255}), inks());
    scene.fabrics.push_back(lambert(0.5));
    scene.objects[0].print.reset();
    scene.objects[0].back = FabricIndex{1};
    scene.objects[0].back_print = PrintIndex{0};
    EXPECT_NEAR(value(scene), 0.9, 1e-3);
    scene.camera.eye = {0, -2, 0};
    EXPECT_NEAR(value(scene), 0.1, 1e-3);
}

// From afar a fine print is even at the first sample; a coarse one is not.
TEST(Print, IsFilteredByWhatAPixelSees) {
    const auto deviation = [](double width) {
        std::vector<Spectrum> greys;
        for (unsigned corner = 0; corner < 8; ++corner)
            greys.push_back(Spectrum::constant(0.8 * std::popcount(corner) / 3));
        Scene scene = printed_floor(lambert(0.9), chequers(64, 64), greys);
        scene.prints[0].placement.width = width;
        const std::vector<float> values = render(scene, quick(1)).image.transport;
        double sum = 0, squares = 0;
        for (const float v : values) {
            sum += static_cast<double>(v);
            squares += static_cast<double>(v * v);
        }
        const double mean = sum / static_cast<double>(values.size());
        EXPECT_NEAR(mean, 0.4, 0.06);
        return std::sqrt(squares / static_cast<double>(values.size()) - mean * mean);
    };
    EXPECT_LT(deviation(0.25), 0.01); // squares of 4 mm, pixels of 60 mm
    EXPECT_GT(deviation(16), 0.1);    // squares of 250 mm
}

TEST(Print, ThatIsWrongIsRefused) {
    const Scene good = printed_floor(lambert(0.9), plain({0, 0, 0, 255}), inks());
    EXPECT_EQ(place_of_fault(good), "accepted");
    Scene scene = good;
    scene.prints[0].layers[0].inks.pop_back();
    EXPECT_EQ(place_of_fault(scene), "prints[0].layers[0]");
    scene = good; // of two shapes
    scene.textures.push_back({.width = 2, .height = 1, .channels = 1, .data = {0, 0}});
    scene.prints[0].layers.push_back({{1}, {Spectrum::constant(0.5)}});
    EXPECT_EQ(place_of_fault(scene), "prints[0].layers[1]");
    scene = good;
    scene.prints[0].placement.width = 0;
    EXPECT_EQ(place_of_fault(scene), "prints[0].width");
    scene = good;
    scene.objects[0].print = PrintIndex{1};
    EXPECT_EQ(place_of_fault(scene), "objects[0].print");
    scene = good;
    scene.surfaces[0].uv.clear();
    EXPECT_EQ(place_of_fault(scene), "objects[0]");
    scene = good;
    scene.textures[0].data.pop_back();
    EXPECT_EQ(place_of_fault(scene), "textures[0]");
    scene = good;
    scene.prints[0].layers[0].inks[3] = Spectrum::constant(1.5);
    EXPECT_EQ(place_of_fault(scene).substr(0, 24), "prints[0].layers[0].inks");
}

// A sheet with a picture of holes above a floor; the light is above both.
Scene sheet_with_holes(Texture picture) {
    Scene scene;
    scene.surfaces = {floor_square(4), floor_square(20)};
    scene.surfaces[0].uv = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
    for (glm::dvec3 &p : scene.surfaces[0].position)
        p.y = 1;
    scene.fabrics = {lambert(0.8), lambert(0.4)};
    scene.textures = {std::move(picture)};
    scene.opacities = {{.picture = {0}}};
    scene.objects = {{"sheet", {0}, {0}}, {"floor", {1}, {1}}};
    scene.objects[0].opacity = OpacityIndex{0};
    scene.lights = {RectangleLight{
        .corner = {-0.5, 2, -0.5}, .edge_u = {1, 0, 0}, .edge_v = {0, 0, 1}, .radiance = 5}};
    scene.camera = {
        .eye = {0, 0.5, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .width = 8, .height = 8};
    return scene;
}

RenderSettings direct(int samples) {
    RenderSettings settings = quick(samples);
    settings.max_bounces = 0;
    return settings;
}

double mean_of(const Scene &scene, const RenderSettings &settings) {
    const std::vector<float> values = render(scene, settings).image.transport;
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(Opacity, LightIsWeakenedByWhatLiesOnItsWay) {
    const Scene half = sheet_with_holes(plain({64, 0, 0, 0}, 1));
    Scene open = half;
    open.objects.erase(open.objects.begin());
    const double whole = mean_of(open, direct(16));
    EXPECT_GT(whole, 0.1);
    EXPECT_NEAR(mean_of(half, direct(16)), whole * (1 - 64.0 / 255), 0.01 * whole);
    EXPECT_EQ(mean_of(sheet_with_holes(plain({255, 0, 0, 0}, 1)), direct(16)), 0);
    EXPECT_NEAR(mean_of(sheet_with_holes(plain({0, 0, 0, 0}, 1)), direct(16)), whole, 1e-5 * whole);
}

TEST(Opacity, TheCameraSeesThroughHoles) {
    const auto seen = [](std::uint8_t cover) {
        Scene scene = sheet_with_holes(plain({cover, 0, 0, 0}, 1));
        scene.lights.clear();
        scene.environment = Environment{.radiance = 1, .visible = true};
        scene.surfaces.pop_back(); // no floor: black cloth before a bright sky
        scene.objects.pop_back();
        scene.fabrics[0] = lambert(0);
        scene.camera.target = {0, 1, 0};
        return mean_of(scene, quick(256));
    };
    EXPECT_NEAR(seen(102), 0.6, 0.01);
    EXPECT_EQ(seen(255), 0);
    EXPECT_EQ(seen(0), 1);
}

TEST(Opacity, OfAllIsNoOpacity) {
    const Scene whole = sheet_with_holes(plain({255, 0, 0, 0}, 1));
    Scene without = whole;
    without.objects[0].opacity.reset();
    Scene seen = whole, seen_without = without;
    for (Scene *const scene : {&seen, &seen_without})
        scene->camera.eye = {0, 4, 0};
    EXPECT_EQ(render(seen, quick(8)).image.transport,
              render(seen_without, quick(8)).image.transport);
}

// White lace among light from all sides.
TEST(Opacity, WhiteLaceIsNotSeenInAFurnace) {
    Scene scene = sheet_with_holes(chequers(8, 8));
    scene.textures[0].channels = 1;
    scene.textures[0].data.resize(64);
    scene.lights.clear();
    scene.environment = Environment{.radiance = 1};
    scene.fabrics = {lambert(1), lambert(1)};
    scene.camera.eye = {0.3, 4, 0.2};
    RenderSettings settings = quick(64);
    settings.max_bounces = 256;
    EXPECT_NEAR(mean_of(scene, settings), 1, 2e-3);
    scene.fabrics[0] = lambert(0.9); // negative control
    EXPECT_LT(mean_of(scene, settings), 0.99);
}

TEST(Opacity, NeedsAPictureOfCoverage) {
    Scene scene = sheet_with_holes(plain({1, 2, 3, 4}));
    EXPECT_THROW(check_scene(scene), Error);
    scene = sheet_with_holes(plain({1, 0, 0, 0}, 1));
    scene.surfaces[0].uv.clear();
    EXPECT_THROW(check_scene(scene), Error);
}

} // namespace
} // namespace tsuya::test
