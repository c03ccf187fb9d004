#include "tsuya/color/lamp.h"

#include <cmath>

#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/observer.h"

namespace tsuya {
namespace {

TEST(Lamp, HasPublishedChromaticity) {
    // [CIE015] chromaticities of the illuminants, 2-degree observer; MH-NIST from its own spectrum.
    struct Row {
        const char *name;
        double x, y;
    };
    for (const Row &row :
         {Row{"D65", 0.3127, 0.3290}, Row{"A", 0.4476, 0.4074}, Row{"D50", 0.3457, 0.3585},
          Row{"HP3", 0.4301, 0.4075}, Row{"HP4", 0.3811, 0.3797}, Row{"HP5", 0.3775, 0.3714},
          Row{"MH-NIST", 0.3725, 0.3856}, Row{"E", 0.3333, 0.3333}, Row{"HP1", 0.5330, 0.4150},
          Row{"HP2", 0.4778, 0.4158}, Row{"FL2", 0.3721, 0.3751}, Row{"FL11", 0.3805, 0.3769},
          Row{"FL12", 0.4370, 0.4042}, Row{"LED-B3", 0.3756, 0.3723}}) {
        const glm::dvec2 xy = chromaticity(white_of(lamp(row.name)));
        EXPECT_NEAR(xy.x, row.x, 0.0005) << row.name;
        EXPECT_NEAR(xy.y, row.y, 0.0005) << row.name;
    }
}

TEST(Lamp, EveryNameIsKnownAndDescribed) {
    EXPECT_EQ(lamp_names().size(), 14u);
    for (const std::string &name : lamp_names()) {
        EXPECT_FALSE(lamp_description(name).empty());
        EXPECT_NO_THROW(check_spectrum(lamp(name), 0, 1e6, name));
        EXPECT_EQ(parse_lamp(name).value, lamp(name).value);
    }
}

TEST(Lamp, PlanckAgreesWithTableOfIlluminantA) {
    // [CIE015] illuminant A: 100 at 560 nm, 9.7951 at 380, 241.675 at 780.
    const Spectrum a = lamp("A");
    EXPECT_NEAR(a.at(560), 100.0, 1e-9);
    EXPECT_NEAR(a.at(380), 9.7951, 1e-3);
    EXPECT_NEAR(a.at(780), 241.675, 1e-2);
}

TEST(Lamp, IsConstantBeyondItsTable) {
    const Spectrum s = lamp("HP4");
    EXPECT_EQ(s.at(360), s.at(380));
    EXPECT_EQ(s.at(830), s.at(780));
    // What is beyond holds at most 0.1 % of Y, as the header says.
    for (const std::string &name : lamp_names()) {
        const Spectrum lit = lamp(name);
        double inside = 0, outside = 0;
        for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm)
            (nm < 380 || nm > 780 ? outside : inside) +=
                lit.at(nm) * color_matching(Observer::cie1931, nm).y;
        EXPECT_LT(outside, 1e-3 * inside) << name;
    }
}

TEST(Lamp, RefusesUnknownNameWithSuggestion) {
    test::expect_problem([] { lamp("D66"); }, "lamp", "did you mean D65?");
    test::expect_problem([] { lamp_description("HP9"); }, "lamp", "expected one of: A, D50");
    test::expect_problem([] { parse_lamp("led.txt"); }, "lamp", "no lamp 'led.txt'");
}

TEST(Lamp, ReadsFile) {
    const test::Folder folder;
    folder.write("mine.csv", "# a lamp of two lines\nwavelength_nm,value\n500,1\n600,3\n");
    EXPECT_NEAR(parse_lamp("mine.csv", folder / "").at(550), 2.0, 1e-12);
    const auto dark = folder.write("dark.csv", "400,0\n700,0\n");
    test::expect_problem([&] { parse_lamp(dark.string()); }, dark.string(), "no visible power");
}

} // namespace
} // namespace tsuya
