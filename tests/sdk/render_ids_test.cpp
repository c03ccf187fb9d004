// Ids of a render as Cryptomatte has them. The decoder is the test's own.

#include <bit>
#include <cstdio>
#include <map>

#include <gtest/gtest.h>

#include "sdk/aov_scenes.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

// MurmurHash3_x86_32 of these names as floats, published with the Cryptomatte plug-ins.
const std::map<std::string, double> kKnownIds{{"hello", 6.07056271024e-17},
                                              {"cube", -4.08461912519e+15},
                                              {"sphere", 2.79018604383e+15},
                                              {"plane", 3.66557617593e-11},
                                              {"m\xc3\xa4"
                                               "dchen",
                                               6.23612982116e+25}};

// Squares in a row, each half as wide as the one before, before nothing.
Scene named_squares() {
    Scene scene;
    double x = -1;
    for (const auto &[name, id] : kKnownIds) {
        Surface square = floor_square(0.3);
        for (glm::dvec3 &p : square.position)
            p = {p.x + x, -p.z + 0.03 * x, 0.1 * x};
        x += 0.31;
        square.panel_name = {"front"};
        scene.objects.push_back({name, {static_cast<std::uint32_t>(scene.surfaces.size())}, {0}});
        scene.surfaces.push_back(square);
    }
    scene.fabrics = {lambert(0.5)};
    scene.fabrics[0].name = "hello";
    scene.environment = Environment{.radiance = 1};
    scene.camera = {.eye = {-0.3, 0, 4},
                    .target = {-0.3, 0, 0},
                    .vertical_angle = 0.4,
                    .width = 50,
                    .height = 14};
    return scene;
}

// Coverage of a name in a pixel: what a program for mattes does.
double matte(const Image &ids, int x, int y, float id) {
    double coverage = 0;
    for (std::size_t r = 0; r < ids.channels.size(); r += 2)
        if (ids.pixel(x, y)[r] == id)
            coverage += double(ids.pixel(x, y)[r + 1]);
    return coverage;
}

TEST(Cryptomatte, NamesHaveTheirKnownIds) {
    const Scene scene = named_squares();
    const SpectralImage image =
        rendered(scene, quick(64), {"CryptoObject", "CryptoFabric", "coverage"});
    const Image &objects = aov_of(image, "CryptoObject");
    ASSERT_EQ(objects.channels.size(), 12u);
    EXPECT_EQ(objects.channels[0], "CryptoObject00.R");
    EXPECT_EQ(objects.channels[3], "CryptoObject00.A");
    EXPECT_EQ(objects.channels[10], "CryptoObject02.B");
    std::map<float, double> areas;
    bool mixed = false;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float *const ranks = objects.pixel(x, y);
            double sum = 0;
            for (std::size_t r = 0; r < 12; r += 2) {
                areas[ranks[r]] += double(ranks[r + 1]);
                sum += double(ranks[r + 1]);
                if (r > 0) {
                    EXPECT_LE(ranks[r + 1], ranks[r - 1]);
                }
                mixed = mixed || (r > 0 && ranks[r + 1] > 0);
            }
            EXPECT_NEAR(sum, *aov_of(image, "coverage").pixel(x, y), 1e-6);
            EXPECT_NEAR(matte(aov_of(image, "CryptoFabric"), x, y, 6.07056271024e-17f), sum, 1e-6);
        }
    EXPECT_TRUE(mixed) << "no pixel shows two";
    areas.erase(0.0f); // free ranks
    ASSERT_EQ(areas.size(), kKnownIds.size());
    const double side = 0.3 / pixel_width(scene.camera, 4);
    for (const auto &[name, id] : kKnownIds) {
        ASSERT_TRUE(areas.contains(static_cast<float>(id))) << name;
        EXPECT_NEAR(areas[static_cast<float>(id)], side * side, 0.1 * side * side) << name;
    }
}

TEST(Cryptomatte, MetadataNameTheIds) {
    Scene scene = named_squares();
    scene.objects[3].name = "a \"b\"\\\n";
    const SpectralImage image = rendered(scene, quick(4), {"CryptoObject", "CryptoPanel"});
    std::map<std::string, std::string> of_layer;
    std::string panel_manifest;
    for (const auto &[key, value] : image.metadata) {
        if (!key.starts_with("cryptomatte/"))
            continue;
        ASSERT_EQ(key.find('/', 12), 19u) << "seven digits: " << key;
        const std::string start = key.substr(0, 20);
        const std::string layer = image.metadata.at(start + "name");
        if (layer == "CryptoObject")
            of_layer[key.substr(20)] = value;
        else if (key.ends_with("manifest"))
            panel_manifest = value;
    }
    EXPECT_EQ(of_layer["name"], "CryptoObject");
    EXPECT_EQ(of_layer["hash"], "MurmurHash3_32");
    EXPECT_EQ(of_layer["conversion"], "uint32_to_float32");
    char hex[9];
    std::snprintf(hex, sizeof hex, "%08x", std::bit_cast<unsigned>(6.07056271024e-17f));
    EXPECT_NE(of_layer["manifest"].find(std::string("\"hello\":\"") + hex + "\""),
              std::string::npos)
        << of_layer["manifest"];
    EXPECT_NE(of_layer["manifest"].find(R"("a \"b\"\\\u000a":")"), std::string::npos);
    EXPECT_NE(panel_manifest.find("\"hello/front\":"), std::string::npos) << panel_manifest;
}

// More names in a pixel than it has room for, and a name that two objects share.
TEST(Cryptomatte, KeepsSixNamesAPixel) {
    Scene scene = named_squares();
    for (std::size_t i = 0; i < 4; ++i) {
        scene.objects.push_back(scene.objects[0]);
        scene.objects.back().name = "copy" + std::to_string(i % 3);
        scene.objects.back().surface = {static_cast<std::uint32_t>(scene.surfaces.size())};
        scene.surfaces.push_back(scene.surfaces[4]);
        for (glm::dvec3 &p : scene.surfaces.back().position)
            p += glm::dvec3(0.31 * double(i + 1), 0, 0.1);
    }
    scene.camera.width = scene.camera.height = 1;
    scene.camera.vertical_angle = 0.9;
    const SpectralImage image = rendered(scene, quick(1024), {"CryptoObject", "coverage"});
    const float *const ranks = image.aovs[0].pixel(0, 0);
    double sum = 0;
    for (std::size_t r = 0; r < 12; r += 2) {
        sum += double(ranks[r + 1]);
        for (std::size_t other = 0; other < r && ranks[r + 1] > 0; other += 2)
            EXPECT_NE(ranks[r], ranks[other]);
    }
    EXPECT_GT(sum, 0.5 * double(*image.aovs[1].pixel(0, 0)));
    EXPECT_LT(sum, double(*image.aovs[1].pixel(0, 0)) + 1e-6);
}

} // namespace
