// Files of instruments, see spectrum_file.h.

#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/measured_spectrum.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/spectrum_file.h"

namespace tsuya {
namespace {

/// 31 values from 400 to 700 nm that rise from `low` by `step`.
std::string ramp(double low, double step, const std::string &separator) {
    std::string text;
    for (int i = 0; i < 31; ++i)
        text += (i == 0 ? "" : separator) + std::to_string(low + step * i);
    return text;
}

void expect_ramp(const Spectrum &s, double low, double step) {
    ASSERT_EQ(s.value.size(), 31u);
    for (int i = 0; i < 31; ++i)
        EXPECT_NEAR(s.at(400 + 10 * i), low + step * i, 1e-6) << i;
}

TEST(SpectrumFormats, Tm27) {
    const test::Folder folder;
    const auto text = [](const std::string &quantity, const std::string &value) {
        return R"(<?xml version="1.0"?><i:IESTM2714 xmlns:i="http://www.ies.org/iestm2714">
<i:SpectralDistribution><i:SpectralQuantity>)" +
               quantity + R"(</i:SpectralQuantity>
<i:SpectralData wavelength="700">3</i:SpectralData>
<i:SpectralData wavelength="550"> )" +
               value + R"( </i:SpectralData>
<i:SpectralData wavelength="400">1</i:SpectralData>
</i:SpectralDistribution></i:IESTM2714>)";
    };
    const auto path = folder.write("lamp.SPDX", text("relative", "2"));
    EXPECT_EQ(read_lamp_file(path).spectrum, (Spectrum{{400, 550, 700}, {1, 2, 3}}));
    test::expect_problem([&] { read_dye_file(path); }, path.string(), "the power of a lamp");
    folder.write("lamp.SPDX", text("reflectance", "2"));
    test::expect_problem([&] { read_lamp_file(path); }, path.string(), "a reflectance");
    folder.write("lamp.SPDX", text("flux", "zwei"));
    test::expect_problem([&] { read_lamp_file(path); }, path.string() + ":4",
                         "'zwei' is not a number");
    folder.write("lamp.SPDX", text("flux", "2").substr(0, 200));
    const Error cut = test::error_of([&] { read_lamp_file(path); });
    EXPECT_NE(std::string(cut.what()).find("the XML cannot be read"), std::string::npos);
    folder.write("lamp.SPDX", "<a/>");
    test::expect_problem([&] { read_lamp_file(path); }, path.string(), "no spectrum");
}

TEST(SpectrumFormats, Cxf3) {
    const test::Folder folder;
    const auto path = folder.write(
        "cloth.cxf",
        R"(<cc:CxF xmlns:cc="http://colorexchangeformat.com/CxF3-core"><cc:Resources>
<cc:ObjectCollection>
<cc:Object Name="navy" Id="c1"><cc:ColorValues>
<cc:ReflectanceSpectrum ColorSpecification="CS1">)" +
            ramp(0.1, 0.01, " ") + R"(</cc:ReflectanceSpectrum></cc:ColorValues></cc:Object>
<cc:Object Id="c2"><cc:ColorValues><cc:EmissiveSpectrum StartWL="400" Increment="10">)" +
            ramp(5, 1, "\n") + R"(</cc:EmissiveSpectrum></cc:ColorValues></cc:Object>
<cc:Object Name="none" Id="c3"><cc:ColorValues><cc:ColorCIELab/></cc:ColorValues></cc:Object>
</cc:ObjectCollection><cc:ColorSpecificationCollection><cc:ColorSpecification Id="CS1">
<cc:MeasurementSpec><cc:WavelengthRange StartWL="400" Increment="10"/></cc:MeasurementSpec>
</cc:ColorSpecification></cc:ColorSpecificationCollection></cc:Resources></cc:CxF>)");
    expect_ramp(read_dye_file(path, "NAVY").spectrum, 0.1, 0.01);
    expect_ramp(read_lamp_file(path, "c2").spectrum, 5, 1);
    test::expect_problem([&] { read_lamp_file(path, "navy"); }, path.string(), "a reflectance");
    test::expect_problem([&] { read_dye_file(path, "none"); }, path.string(),
                         "expected one of: navy, c2");
}

/// A CGATS table of 400, 550 and 700 nm.
std::string cgats(const std::string &keys, const std::string &names, const std::string &data) {
    return "CTI3\nDESCRIPTOR \"test\"\nKEYWORD \"MEAS_TYPE\"\n" + keys +
           "NUMBER_OF_FIELDS 4\nBEGIN_DATA_FORMAT\n" + names +
           "\nEND_DATA_FORMAT\nNUMBER_OF_SETS 2\nBEGIN_DATA\n" + data + "\nEND_DATA\n";
}

TEST(SpectrumFormats, CgatsOfArgyllAndOthers) {
    const test::Folder folder;
    const std::string names = "SAMPLE_ID SPEC_400 SPEC_550 SPEC_700";
    const auto path = folder.write(
        "cloth.ti3", cgats("SPECTRAL_BANDS \"3\"\nSPECTRAL_START_NM \"400.000000\"\n"
                           "SPECTRAL_END_NM \"700.000000\"\nSPECTRAL_NORM \"100.000000\"\n"
                           "MEAS_TYPE \"REFLECTIVE\"\n",
                           names, "A1 10 20 30\nA2 40 50 60"));
    EXPECT_EQ(read_dye_file(path, "a2").spectrum, (Spectrum{{400, 550, 700}, {0.4, 0.5, 0.6}}));
    EXPECT_THROW(read_lamp_file(path, "A2"), Error);
    const auto lamp_path =
        folder.write("lamp.sp", cgats("MEAS_TYPE \"EMISSION\"\n", names, "1 10 20 30\n2 40 50 60"));
    EXPECT_EQ(read_lamp_file(lamp_path, "1").spectrum.value, (std::vector<double>{10, 20, 30}));
    // The same under a name that says less.
    const auto text = folder.write(
        "cloth.txt", cgats("", "SAMPLE_NAME SPECTRAL_NM700 SPECTRAL_NM550 SPECTRAL_NM400",
                           "\"a b\" .6 .5 .4\nc .3 .2 .1"));
    EXPECT_EQ(read_dye_file(text, "a b").spectrum.value, (std::vector<double>{0.4, 0.5, 0.6}));
    for (const char *bad : {"", "CTI3\n", "nonsense {}", "CTI3\nBEGIN_DATA_FORMAT\nX\n"}) {
        const auto wrong = folder.write("wrong.ti3", bad);
        EXPECT_EQ(test::error_of([&] { read_spectrum_file(wrong); }).problems()[0].where,
                  wrong.string())
            << bad;
    }
    const auto word = folder.write("word.ti3", cgats("", names, "1 10 x 30\n2 40 50 60"));
    test::expect_problem([&] { read_spectrum_file(word); }, word.string() + ": set 1, 550 nm",
                         "'x' is not a number");
}

TEST(SpectrumFormats, QtxIsPercent) {
    const test::Folder folder;
    const auto path = folder.write(
        "cloth.qtx", "[STANDARD_DATA 0]\r\nSTD_NAME=navy\r\nSTD_REFLPOINTS=31,\r\n"
                     "STD_REFLINTERVAL=10\r\nSTD_REFLLOW=400\r\nSTD_R=" +
                         ramp(0.5, 0.1, ",") +
                         ",\r\n[BATCH_DATA 0]\r\nBAT_NAME=lot 7\r\nBAT_REFLPOINTS=31\r\n"
                         "BAT_REFLINTERVAL=10\r\nBAT_REFLLOW=400\r\nBAT_R=" +
                         ramp(1, 2, ",") +
                         "\r\nSTD_DATUM_START\r\nSTD_NAME=short\r\nSTD_R=400,10,31," +
                         ramp(3, 0, ",") + "\r\nSTD_DATUM_END\r\n");
    expect_ramp(read_dye_file(path, "navy").spectrum, 0.005, 0.001);
    expect_ramp(read_dye_file(path, "lot 7").spectrum, 0.01, 0.02);
    expect_ramp(read_dye_file(path, "short").spectrum, 0.03, 0);
    const auto refuse = [&](const std::string &text, const std::string &where,
                            const std::string &part) {
        const auto bad = folder.write("bad.qtx", text);
        test::expect_problem([&] { read_spectrum_file(bad); }, bad.string() + where, part);
    };
    refuse("STD_NAME=a\n", "", "no spectrum");
    refuse("STD_R=1,2,3\n", ":1", "the wavelengths of the values are missing");
    refuse("STD_R=x\n", ":1", "'x' is not a number");
    refuse("STD_REFLLOW=400\nSTD_REFLINTERVAL=10\nSTD_REFLPOINTS=4\nSTD_R=1,2,3\n", ":4",
           "there are 3 values");
}

TEST(SpectrumFormats, MifHasThirtyOneValues) {
    const test::Folder folder;
    const std::string head = "[FILE INFO]\nVERSION=2000\n[STANDARD]\nCUST=XR\nNAME=SingleBlue\n"
                             "[MEASUREMENT]\nTYPE=S\nANGL=45\n";
    const auto path = folder.write("ink.mif", head + ramp(10, 1, " ") + "\n");
    EXPECT_EQ(read_spectrum_file(path).samples.at(0).name, "SingleBlue");
    expect_ramp(read_dye_file(path).spectrum, 0.1, 0.01);
    folder.write("ink.mif", head + "1 2 3\n");
    test::expect_problem([&] { read_spectrum_file(path); }, path.string() + ":9",
                         "there are 3 values; expected 31");
}

TEST(SpectrumFormats, ReadsOutsideCases) {
    if (test::outside_cases().empty())
        GTEST_SKIP() << "TSUYA_TEST_CASES is not set";
    const auto folder = test::outside_cases() / "colour";
    const glm::dvec2 hp4 = chromaticity(white_of(lamp("HP4")));
    for (const char *name : {"lamp.spdx", "lamp.cxf"}) {
        const glm::dvec2 xy = chromaticity(white_of(read_lamp_file(folder / name).spectrum));
        EXPECT_NEAR(xy.x, hp4.x, 2e-4) << name;
        EXPECT_NEAR(xy.y, hp4.y, 2e-4) << name;
    }
    EXPECT_NEAR(read_dye_file(folder / "dye.qtx", "navy").spectrum.at(550), 0.05, 1e-12);
}

} // namespace
} // namespace tsuya
