#include "tsuya/color/measured_spectrum.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/spectrum_file.h"

namespace tsuya {
namespace {

/// FL2 as a file of wavelengths w(nm).
std::string lamp_text(const std::function<double(double)> &wavelength, double low_nm = 380,
                      double high_nm = 780) {
    std::string text;
    const Spectrum s = lamp("FL2");
    for (std::size_t i = 0; i < s.value.size(); ++i)
        if (const double nm = s.wavelength_nm[i]; nm >= low_nm && nm <= high_nm)
            text += std::to_string(wavelength(nm)) + "," + std::to_string(s.value[i]) + "\n";
    return text;
}

TEST(MeasuredLamp, OfAnotherUnitIsRefusedWithItsName) {
    const test::Folder folder;
    struct Row {
        const char *unit;
        std::function<double(double)> of_nm;
    };
    for (const Row &row : {Row{"micrometres", [](double nm) { return nm / 1000; }},
                           Row{"angstrom", [](double nm) { return nm * 10; }},
                           Row{"electron volts", [](double nm) { return 1239.84 / nm; }},
                           Row{"wavenumbers", [](double nm) { return 1e7 / nm; }}}) {
        const auto path = folder.write("lamp.csv", lamp_text(row.of_nm));
        test::expect_problem([&] { read_lamp_file(path); }, path.string(), row.unit);
        test::expect_problem([&] { read_dye_file(path); }, path.string(), row.unit);
    }
}

TEST(MeasuredLamp, HasToCoverTheVisibleRange) {
    const test::Folder folder;
    const auto refuse = [&](const std::string &text, const std::string &part) {
        const auto path = folder.write("lamp.csv", text);
        test::expect_problem([&] { read_lamp_file(path); }, path.string(), part);
    };
    refuse("589,1\n", "one row, at 589 nm");
    refuse("200,1\n250,2\n300,1\n", "none is visible");
    refuse("900,1\n1000,2\n", "none is visible");
    refuse(lamp_text([](double nm) { return nm; }, 430), "known from 430 to 780 nm only");
    refuse(lamp_text([](double nm) { return nm; }, 380, 650), "known from 380 to 650 nm only");
    refuse("400,0\n550,0\n700,0\n", "no visible power");
    refuse("300,5\n350,0\n700,0\n", "no visible power");
    EXPECT_NO_THROW(read_lamp_file(
        folder.write("lamp.csv", lamp_text([](double nm) { return nm; }, 410, 690))));
}

TEST(MeasuredLamp, ALineNeedsOnlyItsOwnSamples) {
    const test::Folder folder;
    for (const char *text : {"649,0\n650,1000\n651,0\n", "588.9,0\n588.95,1\n589.0,0\n"}) {
        const auto path = folder.write("line.csv", text);
        const MeasuredSpectrum line = read_lamp_file(path);
        EXPECT_TRUE(line.warnings.empty());
        EXPECT_NEAR(white_of(line.spectrum).y, 1, 1e-12);
        EXPECT_EQ(line.spectrum.at(500), 0);
    }
    // What is left at its ends is not continued.
    const MeasuredSpectrum led =
        read_lamp_file(folder.write("led.csv", "600,0.005\n610,0.4\n620,1\n630,0.4\n640,0.005\n"));
    EXPECT_EQ(led.spectrum.at(500), 0);
    EXPECT_EQ(led.spectrum.at(700), 0);
    EXPECT_EQ(led.spectrum.at(600), 0.005);
}

TEST(MeasuredLamp, NoiseIsCountedAndNonsenseRefused) {
    const test::Folder folder;
    const auto path = folder.write("lamp.csv", "400,-0.001\n410,0.5\n420,-0.002\n430,1\n700,1\n");
    const MeasuredSpectrum read = read_lamp_file(path);
    ASSERT_EQ(read.warnings.size(), 2u);
    EXPECT_EQ(read.warnings[0], path.string() + ": 2 values below 0, down to -0.002, counted as 0");
    EXPECT_NE(read.warnings[1].find("steps of 270 nm"), std::string::npos);
    EXPECT_EQ(read.spectrum.at(420), 0);
    const auto refuse = [&](const std::string &text, const std::string &where,
                            const std::string &part) {
        folder.write("lamp.csv", text);
        test::expect_problem([&] { read_lamp_file(path); }, path.string() + where, part);
    };
    refuse("400,1\n550,-0.5\n700,1\n", ":2:5", "the value is -0.5; expected 0 or more");
    refuse("400,1\n550,1e308\n700,1\n", ":2:5", "expected a relative power up to 1e30");
    refuse("400,-1\n700,0\n", ":1:5", "the value is -1");
}

TEST(MeasuredDye, SharesPercentAndNoise) {
    const test::Folder folder;
    const auto read = [&](const std::string &text) {
        return read_dye_file(folder.write("dye.csv", text));
    };
    const std::string dye = (folder / "dye.csv").string();
    const std::string steps = ": steps of 300 nm between samples; values between them are linear";
    EXPECT_EQ(read("400,0.2\n700,0.6\n").warnings, std::vector<std::string>{dye + steps});
    EXPECT_EQ(read("nm,R%\n400,0.2\n700,0.6\n").spectrum.value,
              (std::vector<double>{0.002, 0.006}));
    const MeasuredSpectrum percent = read("400,20\n700,60\n");
    EXPECT_EQ(percent.spectrum.value, (std::vector<double>{0.2, 0.6}));
    EXPECT_EQ(percent.warnings[0], dye + ": values up to 60 are read as percent");
    const MeasuredSpectrum noisy = read("400,-0.004\n700,1.02\n");
    EXPECT_EQ(noisy.spectrum.value, (std::vector<double>{0, 1}));
    EXPECT_EQ(noisy.warnings[0], dye + ": 1 value below 0, down to -0.004, counted as 0");
    EXPECT_EQ(noisy.warnings[1], dye + ": 1 value above 1, up to 1.02, counted as 1");
    for (const char *text : {"400,0.5\n700,1.2\n", "400,-0.2\n700,0.5\n", "400,50\n700,160\n"})
        test::expect_problem([&] { read(text); },
                             dye + (text[6] == '2' || text[4] == '-' ? ":1:5" : ":2:5"),
                             "the value is");
    test::expect_problem([&] { read("450,0.2\n700,0.6\n"); }, dye, "known from 450 to 700 nm only");
    test::expect_problem([&] { read("560,0.2\n"); }, dye, "one row");
}

TEST(MeasuredSpectrum, ReadsOutsideCases) {
    if (test::outside_cases().empty())
        GTEST_SKIP() << "TSUYA_TEST_CASES is not set";
    const auto folder = test::outside_cases() / "colour";
    for (const char *name : {"um.csv", "sodium1row.csv"})
        EXPECT_THROW(read_lamp_file(folder / name), Error) << name;
    const glm::dvec2 hp4 = chromaticity(white_of(lamp("HP4")));
    for (const char *name : {"A.csv", "desc.csv", "semi.csv", "instr.csv", "noise.csv"}) {
        const glm::dvec2 xy = chromaticity(white_of(read_lamp_file(folder / name).spectrum));
        EXPECT_NEAR(xy.x, hp4.x, 2e-4) << name;
        EXPECT_NEAR(xy.y, hp4.y, 2e-4) << name;
    }
    EXPECT_NEAR(read_dye_file(folder / "colorchecker.csv", "navy").spectrum.at(550), 0.05, 1e-12);
    test::expect_problem([&] { read_lamp_file(folder / "colorchecker.csv", "navy"); },
                         (folder / "colorchecker.csv").string(), "a row of samples");
    for (const char *name : {"narrow.csv", "laser650.csv"})
        EXPECT_NO_THROW(white_of(read_lamp_file(folder / name).spectrum)) << name;
}

} // namespace
} // namespace tsuya
