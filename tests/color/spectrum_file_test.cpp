#include "tsuya/color/spectrum_file.h"

#include <gtest/gtest.h>

#include "color_test.h"

namespace tsuya {
namespace {

Spectrum only_spectrum(const std::filesystem::path &path) {
    const SpectrumFile file = read_spectrum_file(path);
    EXPECT_EQ(file.samples.size(), 1u);
    return file.samples.front().spectrum;
}

Spectrum spectrum_of_text(const std::string &text, const std::string &name = "s.csv") {
    const test::Folder folder;
    return only_spectrum(folder.write(name, text));
}

const Spectrum kThree{{400, 500, 600}, {0.1, 0.5, 0.25}};

TEST(SpectrumFile, ReadsCommentsHeaderAndWindowsLines) {
    EXPECT_EQ(spectrum_of_text("\xEF\xBB\xBF# lamp: HP4\r\n\r\nnm , W\r\n 400 , 1e-1\r\n"
                               "# inside\r\n500,0.5\r\n600,.25\r\n"),
              kThree);
}

TEST(SpectrumFile, ReadsLoneReturns) {
    const Spectrum s = spectrum_of_text("# 45\xB0\r400,0.5\r500,1\r");
    EXPECT_EQ(s.wavelength_nm, (std::vector<double>{400, 500}));
}

TEST(SpectrumFile, ReadsWhatSpreadsheetsAndInstrumentsWrite) {
    for (const char *text :
         {"400;0,1\n500;0,5\n600;0,25\n",                           // decimal comma
          "Wellenl\xC3\xA4nge;Wert\n400;0,1\n500;0,5\n600;0,25;\n", // and a separator too many
          "400\t0,1\n500\t0,5\n600\t0,25\n",                        // tabs
          "400 0.1\n500   0.5\n600 0.25\n",                         // blanks
          "400 0,1\n500 0,5\n600 0,25\n",                           // and a decimal comma
          "\"400\",\"0.1\"\n\"500\",\"0.5\"\n\"600\",\"0.25\"\n",   // quotes
          "\"400\",\"0,1\"\n\"500\",\"0,5\"\n\"600\",\"0,25\"\n",
          "600,0.25\n500,0.5\n400,0.1\n",                        // falling
          "Value,Wavelength (nm)\n0.1,400\n0.5,500\n0.25,600\n", // other order
          "Instrument: X\nDate: 2020-01-01\nSerial;1\nTime,10:30\nGain,4\nwavelength,value\n"
          "400,0.1\n500,0.5\n600,0.25\n",                                        // a preamble
          "Wavelength,Irradiance\nnm,W/m2\n400,0.1\n500,0.5\n600,0.25\n[end]\n", // two header lines
          "wavelength [\xC2\xB5m];W\n0,4;0,1\n0,5;0,5\n0,6;0,25\n", // unit in the header
          "lambda_angstrom,W\n4000,0.1\n5000,0.5\n6000,0.25\n",
          "name,flag,400,500,600,700,800\n" // a row of a sample
          "x,y,0.1,0.5,0.25,0.25,0.25\n"}) {
        const Spectrum s = spectrum_of_text(text);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(s.at(400 + 100 * i), kThree.value[static_cast<std::size_t>(i)], 1e-12)
                << text;
        EXPECT_NEAR(s.wavelength_nm.front(), 400, 1e-9) << text;
    }
    std::string wide("\xFF\xFE");
    for (const char c : std::string("400\t0,1\r\n500\t0,5\r\n600\t0,25\r\n"))
        wide += {c, '\0'};
    EXPECT_EQ(spectrum_of_text(wide, "S.TXT"), kThree);
}

TEST(SpectrumFile, HasAllColumnsByName) {
    const test::Folder folder;
    const auto path =
        folder.write("many.csv", "nm,Front %,flag,Back %\n400,10,ok,30\n500,20,ok,40\n");
    const SpectrumFile file = read_spectrum_file(path);
    ASSERT_EQ(file.samples.size(), 2u);
    EXPECT_TRUE(file.samples[0].percent);
    EXPECT_EQ(find_sample(file, "BACK %", "x").spectrum.value, (std::vector<double>{30, 40}));
    test::expect_problem([&] { find_sample(file, "", "x"); }, "x",
                         "holds 2 spectra; expected one of: Front %, Back %, as FILE:NAME");
    test::expect_problem([&] { find_sample(file, "Bach %", "x"); }, "x", "did you mean Back %?");
    const SpectrumFile bare = read_spectrum_file(folder.write("bare.csv", "400,1,2\n500,3,4\n"));
    EXPECT_EQ(find_sample(bare, "3", "x").spectrum.value, (std::vector<double>{2, 4}));
}

TEST(SpectrumFile, HasRowsOfSamples) {
    const test::Folder folder;
    const SpectrumFile file = read_spectrum_file(
        folder.write("chart.csv", "No;SAMPLE_NAME;L*;R700;R600;R500;R450;R400\n"
                                  "1;navy;20;0,1;0,2;0,3;0,4;0,5\n2;red;40;0,9;0,8;0,7;0,6;0,5\n"));
    ASSERT_EQ(file.samples.size(), 2u);
    EXPECT_EQ(file.samples[0].name, "navy");
    EXPECT_EQ(file.samples[1].spectrum.wavelength_nm,
              (std::vector<double>{400, 450, 500, 600, 700}));
    EXPECT_EQ(file.samples[1].spectrum.value, (std::vector<double>{0.5, 0.6, 0.7, 0.8, 0.9}));
    EXPECT_EQ(file.samples[1].where[0], (folder / "chart.csv").string() + ":3:26");
}

TEST(SpectrumFile, SpecsNameAFileAndASample) {
    EXPECT_FALSE(parse_spectrum_file_spec("D65"));
    EXPECT_FALSE(parse_spectrum_file_spec("x.csv.doc"));
    EXPECT_EQ(parse_spectrum_file_spec("a/X.CSV")->path, "a/X.CSV");
    const auto spec = parse_spectrum_file_spec("a:b/x.csv:navy 2");
    ASSERT_TRUE(spec);
    EXPECT_EQ(spec->path, "a:b/x.csv");
    EXPECT_EQ(spec->sample, "navy 2");
}

TEST(SpectrumFile, RoundTripIsExact) {
    const test::Folder folder;
    const Spectrum s{{380.1, 1e3 / 3, 780}, {0.1, 2.0 / 3, 1e-17}};
    // The middle wavelength is too short: sorted first.
    const Spectrum sorted{{1e3 / 3, 380.1, 780}, {2.0 / 3, 0.1, 1e-17}};
    test::expect_problem([&] { write_spectrum_csv(folder / "s.csv", s); },
                         (folder / "s.csv").string(), "do not increase");
    EXPECT_EQ(folder.size(), 0);
    write_spectrum_csv(folder / "s.csv", sorted, "two\nlines");
    EXPECT_EQ(only_spectrum(folder / "s.csv"), sorted);
    EXPECT_EQ(folder.size(), 1);
}

TEST(SpectrumFile, CollectsProblemsWithPlaces) {
    const test::Folder folder;
    const auto path = folder.write("bad.csv", "wavelength_nm,value\n400,0.1\n410, 2wei\n420\n"
                                              "405,0.2\n390,0.2\n-3,1\n510,nan\n520,1,2\n530,\n");
    const Error error = test::error_of([&] { read_spectrum_file(path); });
    std::vector<std::string> where;
    for (const Problem &p : error.problems())
        where.push_back(p.where.substr(path.string().size()));
    // Lines that were wrong do not count in the order: 405 is good.
    EXPECT_EQ(where,
              (std::vector<std::string>{":3:6", ":4:1", ":6:1", ":7:1", ":8:5", ":9:1", ":10:1"}));
    EXPECT_NE(std::string(error.what()).find("'2wei' is not a number"), std::string::npos);
    // A first row that is wrong is no header.
    const auto first = folder.write("first.csv", "nm,W\n40x,1\n410,1\n420,1\n");
    test::expect_problem([&] { read_spectrum_file(first); }, first.string() + ":2:1",
                         "'40x' is not a number");
    const auto mixed = folder.write("mixed.csv", "400;1,5\n410;1.5\n");
    test::expect_problem([&] { read_spectrum_file(mixed); }, mixed.string() + ":2:5",
                         "another decimal mark");
}

TEST(SpectrumFile, StopsAfterTwentyProblems) {
    const test::Folder folder;
    std::string text = "1,1\n";
    for (int i = 0; i < 50; ++i)
        text += "1x,2y,3z\n";
    const auto path = folder.write("bad.csv", text);
    EXPECT_EQ(test::error_of([&] { read_spectrum_file(path); }).problems().size(), kMaxProblems);
}

TEST(SpectrumFile, RefusesAbsentEmptyAndFolder) {
    const test::Folder folder;
    const auto absent = folder / "absent.csv";
    test::expect_problem([&] { read_spectrum_file(absent); }, absent.string(), "cannot be opened");
    for (const char *text : {"", "# nothing\nwavelength_nm,value\n", "one line of words\n",
                             "name,400,410,420,430,440\n"}) {
        const auto empty = folder.write("empty.csv", text);
        test::expect_problem([&] { read_spectrum_file(empty); }, empty.string(), "no spectrum");
    }
    const auto inside = folder / "no/where.csv";
    test::expect_problem([&] { write_spectrum_csv(inside, Spectrum{}); }, inside.string(),
                         "folder");
    test::expect_problem([&] { read_spectrum_file(folder / "s.xls"); }, (folder / "s.xls").string(),
                         "expected one of: .csv");
    std::filesystem::create_directory(folder / "folder.csv");
    test::expect_problem([&] { read_spectrum_file(folder / "folder.csv"); },
                         (folder / "folder.csv").string(), "it is a folder");
}

} // namespace
} // namespace tsuya
