// The layout of spectral EXRs, seen by a reader of the test's own; files of other programs and of
// the first layout.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "color_test.h"
#include "limited_disk.h"
#include "plain_exr.h"
#include "some_pictures.h"
#include "tsuya/color/difference.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/relight.h"
#include "tsuya/color/srgb.h"
#include "tsuya/sdk/file.h"

namespace tsuya {
namespace {

using namespace tsuya::test;

std::vector<PlainPart> parts_of(const SpectralImage &image,
                                const SpectralExrOptions &options = {}) {
    const Folder folder;
    write_spectral_exr(folder / "t.exr", image, options);
    return read_plain_exr(read_file(folder / "t.exr"));
}

TEST(SpectralLayout, FirstPartIsThePictureUnderItsLamp) {
    SpectralImage image = some_transport();
    image.alpha = ramp(37, 29, {"A"});
    const std::vector<PlainPart> parts = parts_of(image);
    const PlainPart &rgb = parts.front();
    EXPECT_EQ(rgb.text("name"), "rgb");
    EXPECT_EQ(rgb.channels, (std::vector<std::string>{"A", "B", "G", "R"}));
    for (const auto &[name, type] : rgb.pixel_type)
        EXPECT_EQ(type, 1) << name << " is no half";
    EXPECT_EQ(rgb.type.at("chromaticities"), "chromaticities");
    const std::vector<float> rec709{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
    const std::vector<float> written = rgb.floats("chromaticities");
    ASSERT_EQ(written.size(), rec709.size());
    for (std::size_t i = 0; i < rec709.size(); ++i)
        EXPECT_NEAR(written[i], rec709[i], 1e-4) << i;
    EXPECT_EQ(rgb.type.at("adoptedNeutral"), "v2f");
    EXPECT_NEAR(rgb.floats("adoptedNeutral").at(0), 0.3127, 1e-4);
    EXPECT_EQ(rgb.text("tsuya:rgb.lamp"), "D65");
    EXPECT_EQ(rgb.text("software").substr(0, 6), "tsuya ");
    EXPECT_EQ(rgb.text("tsuya:meta:samples_per_pixel"), "64");
    const Image xyz = relight(image, lamp("D65"));
    for (const std::size_t pixel : {0, 500, 1072}) {
        const float *const v = xyz.data.data() + 3 * pixel;
        const glm::dvec3 expected = srgb_from_xyz() * glm::dvec3(v[0], v[1], v[2]);
        EXPECT_NEAR(rgb.values.at("R")[pixel], expected.x, 1e-3 * std::abs(expected.x));
        EXPECT_NEAR(rgb.values.at("B")[pixel], expected.z, 1e-3 * std::abs(expected.z));
        EXPECT_NEAR(rgb.values.at("A")[pixel], image.alpha->data[pixel], 1e-3);
    }
}

TEST(SpectralLayout, PictureIsUnderTheLampsThatAreGiven) {
    const SpectralImage image = some_transport();
    NamedLamp weak{.name = "A", .spectrum = lamp("A"), .factor = 0.25};
    const auto red = [&](const std::vector<NamedLamp> &lamps) {
        return parts_of(image, {.lamps = lamps}).front().values.at("R").at(40);
    };
    const NamedLamp full{.name = "A", .spectrum = lamp("A")};
    EXPECT_NEAR(red({weak}), 0.25f * red({full}), 2e-3f * std::abs(red({full})));
    const PlainPart both =
        parts_of(image, {.lamps = {full, {.name = "D50", .spectrum = lamp("D50")}}}).front();
    EXPECT_EQ(both.text("tsuya:rgb.lamp"), "key=A, a fill.left=D50");
    EXPECT_NEAR(both.floats("adoptedNeutral").at(0), 0.4476, 1e-3);
}

TEST(SpectralLayout, EachLightGroupIsASpectralPartOfItsOwn) {
    const SpectralImage image = some_transport();
    for (const SampleType samples : {SampleType::half, SampleType::float32}) {
        const std::vector<PlainPart> parts = parts_of(image, {.samples = samples});
        ASSERT_EQ(parts.size(), 5u) << "picture, two groups, two AOVs";
        for (std::size_t g = 0; g < 2; ++g) {
            const PlainPart &part = parts[1 + g];
            EXPECT_EQ(part.text("name"), "transport." + image.groups[g]);
            EXPECT_EQ(part.text("spectralLayoutVersion"), "1.0");
            EXPECT_EQ(part.text("emissiveUnits"), "") << "transport is no radiance";
            EXPECT_TRUE(spectral_channels(part, "S0").empty());
            const auto channels = spectral_channels(part, "T");
            ASSERT_EQ(channels.size(), 16u);
            int k = 0;
            for (const auto &[nm, name] : channels) {
                EXPECT_NEAR(nm, 400 + 20 * k, 1e-9);
                EXPECT_EQ(part.pixel_type.at(name), samples == SampleType::half ? 1 : 2);
                for (const int pixel : {0, 300, 37 * 29 - 1}) {
                    const float t = image.pixel(g, pixel % 37, pixel / 37)[k];
                    const float read = part.values.at(name)[static_cast<std::size_t>(pixel)];
                    EXPECT_NEAR(read, t, samples == SampleType::half ? std::abs(t) / 2048 : 0);
                }
                ++k;
            }
        }
        EXPECT_EQ(parts[3].text("name"), "aov.coverage");
        EXPECT_EQ(parts[4].text("name"), "aov.normal");
        EXPECT_EQ(parts[4].pixel_type.at("x"), 2) << "AOVs are exact";
    }
}

// The wavelengths of the channels that renders have.
TEST(SpectralLayout, ChannelsOfRendersAreNamedByTheirNodes) {
    EXPECT_EQ(
        channel_names(SpectralBasis::of_renders(16), false),
        (std::vector<std::string>{"T.418,000nm", "T.436,000nm", "T.447,000nm", "T.464,000nm",
                                  "T.487,000nm", "T.511,000nm", "T.531,000nm", "T.544,000nm",
                                  "T.559,000nm", "T.576,000nm", "T.594,000nm", "T.613,000nm",
                                  "T.633,000nm", "T.650,000nm", "T.663,000nm", "T.699,000nm"}));
}

TEST(SpectralLayout, AllPartsHaveTheWindowOfThePicture) {
    SpectralImage image = some_transport();
    image.data_window = {5, 11, 30, 27};
    for (const PlainPart &part : parts_of(image)) {
        EXPECT_EQ(part.data_window, (std::array{5, 11, 29, 26}));
        EXPECT_EQ(part.display_window, (std::array{0, 0, 36, 28}));
    }
}

TEST(SpectralLayout, EqualPicturesAreEqualBytes) {
    const Folder folder;
    write_spectral_exr(folder / "a.exr", some_transport());
    write_spectral_exr(folder / "b.exr", some_transport());
    const std::string bytes = read_file(folder / "a.exr");
    EXPECT_EQ(bytes, read_file(folder / "b.exr"));
    for (const PlainPart &part : read_plain_exr(bytes))
        EXPECT_EQ(part.attribute.count("capDate"), 0u) << "the time of writing";
}

TEST(SpectralLayout, AFileThatCannotBeWrittenWholeLeavesTheOldOne) {
    const Folder folder;
    const SpectralImage image = some_transport();
    write_spectral_exr(folder / "t.exr", image);
    const std::string before = read_file(folder / "t.exr");
    for (const std::uint64_t bytes : {100u, 5000u}) {
        const FileSizeLimit limit(bytes);
        const Error error = error_of([&] { write_spectral_exr(folder / "t.exr", image); });
        EXPECT_EQ(error.problems().at(0).where, (folder / "t.exr").string()) << error.what();
    }
    EXPECT_EQ(read_file(folder / "t.exr"), before);
    EXPECT_EQ(folder.size(), 1);
}

// A half ends at 65504 and has steps of 6e-8 near 0.
TEST(SpectralLayout, WhatHalvesCannotHoldIsWrittenInFloats) {
    const Folder folder;
    for (const float scale : {1e5f, 1e30f, 1e-5f, 1e-30f}) {
        SpectralImage image = some_transport();
        for (float &t : image.transport)
            t *= scale;
        write_spectral_exr(folder / "t.exr", image);
        EXPECT_TRUE(same_bits(read_spectral_exr(folder / "t.exr").transport, image.transport))
            << scale;
    }
}

// All named dyes at brightnesses from 1/1000 to 1.5, in wavelengths and as depths of dye.
TEST(SpectralLayout, HalvesChangeColoursByLessThanIsSeen) {
    const Folder folder;
    const std::vector<std::string> names = dye_names();
    constexpr int kLevels = 24;
    for (const bool at_depths : {false, true}) {
        SpectralImage image = SpectralImage::make(static_cast<int>(names.size()), kLevels,
                                                  SpectralBasis::of_renders(16), {"key"});
        if (at_depths)
            image.depths = make_dye_depths(
                {{.name = "silk", .dye = dye("crimson"), .open = true, .highest = 0.98}}, 16);
        for (int y = 0; y < kLevels; ++y)
            for (int x = 0; x < image.width; ++x) {
                const std::vector<float> t =
                    project(dye(names[static_cast<std::size_t>(x)]), image.basis);
                const double level = 1.5 * std::pow(1500.0, -y / (kLevels - 1.0));
                for (std::size_t k = 0; k < 16; ++k) {
                    const double r = at_depths ? image.depths->node[k][0] : double(t[k]);
                    const double folds = 0.05 * x;
                    image.pixel(0, x, y)[k] = static_cast<float>(level * r / (1 - folds * r));
                }
            }
        write_spectral_exr(folder / "h.exr", image);
        const SpectralImage half = read_spectral_exr(folder / "h.exr");
        double mean = 0, most = 0;
        for (const char *const name : {"D65", "A", "FL11"}) {
            const glm::dvec3 white = white_of(lamp(name));
            const Image exact = relight(image, lamp(name)), rounded = relight(half, lamp(name));
            for (std::size_t i = 0; i < exact.data.size(); i += 3) {
                const auto lab = [&](const Image &xyz) {
                    return lab_of({xyz.data[i], xyz.data[i + 1], xyz.data[i + 2]}, white);
                };
                const double difference = ciede2000(lab(exact), lab(rounded));
                mean += difference / static_cast<double>(exact.data.size());
                most = std::max(most, difference);
            }
        }
        RecordProperty(at_depths ? "depths" : "wavelengths",
                       std::to_string(mean) + " " + std::to_string(most));
        EXPECT_LT(mean, 0.01) << at_depths;
        EXPECT_LT(most, 0.1) << at_depths;
        EXPECT_GT(most, 0) << "nothing was rounded";
    }
}

std::map<std::string, std::vector<float>> ramps(const std::vector<std::string> &names) {
    std::map<std::string, std::vector<float>> channels;
    for (std::size_t c = 0; c < names.size(); ++c)
        for (int i = 0; i < 6; ++i)
            channels[names[c]].push_back(static_cast<float>(c) + 0.125f * static_cast<float>(i));
    return channels;
}

TEST(SpectralLayout, ReflectancesOfOtherProgramsAreTransport) {
    const Folder folder;
    // Out of order, in other units; 500 THz is 599.585 nm
    const auto file = folder.write(
        "chart.exr", plain_exr(3, 2, ramps({"R", "T.4,5E2nm", "T.0,7um", "T.500,0THz", "T.520nm"}),
                               {{"spectralLayoutVersion", "1.0"}}));
    const SpectralImage image = read_spectral_exr(file);
    EXPECT_EQ(image.groups, std::vector<std::string>{"light"});
    EXPECT_FALSE(image.emissive);
    ASSERT_EQ(image.basis.kind, BasisKind::samples);
    const std::vector<double> nm{450, 520, 299792.458 / 500, 700};
    ASSERT_EQ(image.basis.node_nm.size(), nm.size());
    for (std::size_t k = 0; k < nm.size(); ++k)
        EXPECT_NEAR(image.basis.node_nm[k], nm[k], 1e-6);
    EXPECT_EQ(image.pixel(0, 2, 1)[0], 1 + 0.625f);
    EXPECT_EQ(image.pixel(0, 2, 1)[1], 4 + 0.625f);
    // What is read can be written, and is then exact
    write_spectral_exr(folder / "own.exr", image, {.samples = SampleType::float32});
    const SpectralImage back = read_spectral_exr(folder / "own.exr");
    EXPECT_EQ(back.basis, image.basis);
    EXPECT_EQ(back.transport, image.transport);
}

// A grey patch and a sloping one, as the sum at 1 nm has them.
TEST(SpectralLayout, SamplesOfOtherProgramsAreLinearBetween) {
    const Folder folder;
    const std::vector<float> low{0.5f, 0.25f}, high{0.5f, 1.0f};
    const auto file =
        folder.write("chart.exr", plain_exr(2, 1, {{"T.400nm", low}, {"T.700nm", high}}, {}));
    const Image xyz = relight(read_spectral_exr(file), lamp("A"));
    const glm::dvec3 sloping = xyz_of(lamp("A"), {{400, 700}, {0.25, 1.0}});
    EXPECT_NEAR(xyz.pixel(0, 0)[1], 0.5, 1e-6);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(xyz.pixel(1, 0)[c], sloping[c], 1e-6);
}

TEST(SpectralLayout, RadianceKeepsItsLamp) {
    const Folder folder;
    const auto file = folder.write(
        "lamp.exr", plain_exr(3, 2, ramps({"key.S0.450,0nm", "key.S0.600,0nm", "key.S1.450,0nm"}),
                              {{"emissiveUnits", "W.m^-2.sr^-1"}}));
    const SpectralImage image = read_spectral_exr(file);
    EXPECT_TRUE(image.emissive);
    EXPECT_EQ(image.groups, std::vector<std::string>{"key"});
    EXPECT_EQ(image.basis.count, 2) << "S1 is another component";
    EXPECT_NO_THROW(relight(image, lamp("E")));
    expect_problem([&] { relight(image, lamp("A")); }, "lamps", "expected the lamp E");
}

TEST(SpectralLayout, RefusesWhatHasNoOneMeaning) {
    const Folder folder;
    const auto refuse = [&](const std::vector<std::string> &channels, const std::string &says) {
        const auto file = folder.write("x.exr", plain_exr(3, 2, ramps(channels), {}));
        expect_problem([&] { read_spectral_exr(file); }, file.string(), says);
    };
    refuse({"R", "G", "B"}, "no spectral picture");
    refuse({"S1.400nm"}, "no spectral picture");
    refuse({"T.400nm", "S0.400nm"}, "radiance and reflectance");
    refuse({"T.400nm", "T.400nm.500nm"}, "between two wavelengths");
    refuse({"T.400nm", "T.0,4um"}, "repeats a wavelength");
    refuse({"T.0nm"}, "above 0");
    refuse({"a.T.400nm", "b.T.410nm"}, "different wavelengths");
}

TEST(SpectralLayout, FilesOfTheFirstLayoutAreRead) {
    const Folder folder;
    std::vector<std::string> names{"A", "aov.normal.X"};
    for (const char *const group : {"key", "fill"})
        for (const char *const nm : {"400,000", "550,000", "700,000"})
            names.push_back(std::string(group) + ".S0." + nm + "nm");
    const auto file = folder.write("old.exr", plain_exr(3, 2, ramps(names),
                                                        {{"tsuya:schema", "tsuya-spectral-1"},
                                                         {"tsuya:basis", "hat 3 400 700"},
                                                         {"tsuya:group.0", "key"},
                                                         {"tsuya:group.1", "fill"},
                                                         {"tsuya:alpha", "A"},
                                                         {"tsuya:aov.0", "normal"},
                                                         {"tsuya:aov.0.channel.0", "X"},
                                                         {"tsuya:meta:seed", "7"}}));
    const SpectralImage image = read_spectral_exr(file);
    EXPECT_EQ(image.basis, (SpectralBasis{.count = 3}));
    EXPECT_EQ(image.groups, (std::vector<std::string>{"key", "fill"}));
    EXPECT_EQ(image.pixel(0, 1, 1)[2], 4 + 0.5f);
    EXPECT_EQ(image.pixel(1, 1, 1)[0], 5 + 0.5f);
    EXPECT_EQ(*image.alpha->pixel(2, 0), 0.25f);
    EXPECT_EQ(image.aovs.at(0).pixel(0, 1)[0], 1 + 0.375f);
    EXPECT_EQ(image.metadata.at("seed"), "7");
}

} // namespace
} // namespace tsuya
