#include "tsuya/color/spectrum_file.h"

#include <gtest/gtest.h>

#include "color_test.h"

namespace tsuya {
namespace {

TEST(SpectrumFile, ReadsCommentsHeaderAndWindowsLines) {
    const test::Folder folder;
    const auto path =
        folder.write("s.csv", "\xEF\xBB\xBF# lamp: HP4\r\n\r\nnm , W\r\n 400 , 1e-1\r\n"
                              "# inside\r\n500,0.5\r\n");
    const Spectrum s = read_spectrum_csv(path);
    EXPECT_EQ(s.wavelength_nm, (std::vector<double>{400, 500}));
    EXPECT_EQ(s.value, (std::vector<double>{0.1, 0.5}));
}

TEST(SpectrumFile, ReadsLoneReturns) {
    const test::Folder folder;
    const Spectrum s = read_spectrum_csv(folder.write("s.csv", "# 45\xB0\r400,0.5\r500,1\r"));
    EXPECT_EQ(s.wavelength_nm, (std::vector<double>{400, 500}));
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
    const Spectrum back = read_spectrum_csv(folder / "s.csv");
    EXPECT_EQ(back.wavelength_nm, sorted.wavelength_nm);
    EXPECT_EQ(back.value, sorted.value);
    EXPECT_EQ(folder.size(), 1);
}

TEST(SpectrumFile, CollectsProblemsWithPlaces) {
    const test::Folder folder;
    const auto path = folder.write("bad.csv", "wavelength_nm,value\n400,0.1\n410, zwei\n420\n"
                                              "405,0.2\n390,0.2\n-3,1\n500,1.5\n510,nan\n520,-1\n");
    const Error error = test::error_of([&] { read_spectrum_csv(path, {.low = 0, .high = 1}); });
    std::vector<std::string> where;
    for (const Problem &p : error.problems())
        where.push_back(p.where.substr(path.string().size()));
    // 405 is good: the lines before it that were wrong do not count.
    EXPECT_EQ(where,
              (std::vector<std::string>{":3:6", ":4:1", ":6:1", ":7:1", ":8:5", ":9:5", ":10:5"}));
    EXPECT_NE(std::string(error.what()).find("'zwei' is not a number"), std::string::npos);
}

TEST(SpectrumFile, StopsAfterTwentyProblems) {
    const test::Folder folder;
    std::string text = "1,1\n";
    for (int i = 0; i < 50; ++i)
        text += "x,y,z\n";
    const auto path = folder.write("bad.csv", text);
    EXPECT_EQ(test::error_of([&] { read_spectrum_csv(path); }).problems().size(), kMaxProblems);
}

TEST(SpectrumFile, RefusesAbsentEmptyAndFolder) {
    const test::Folder folder;
    const auto absent = folder / "absent.csv";
    test::expect_problem([&] { read_spectrum_csv(absent); }, absent.string(), "cannot be opened");
    const auto empty = folder.write("empty.csv", "# nothing\nwavelength_nm,value\n");
    test::expect_problem([&] { read_spectrum_csv(empty); }, empty.string(), "no spectrum");
    const auto inside = folder / "no/where.csv";
    test::expect_problem([&] { write_spectrum_csv(inside, Spectrum{}); }, inside.string(),
                         "folder");
    test::expect_problem([&] { read_spectrum_csv(folder / ""); }, (folder / "").string(),
                         "it is a folder");
}

} // namespace
} // namespace tsuya
