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
    test::expect_problem([] { parse_lamp("led.doc"); }, "lamp", "no lamp 'led.doc'");
}

TEST(Lamp, ReadsFile) {
    const test::Folder folder;
    folder.write("A.csv", "# two ends of a slope\nwavelength_nm,value\n400,1\n700,3\n");
    const NamedLamp read = find_lamp("A.csv", folder / "");
    EXPECT_NEAR(read.spectrum.at(550), 2.0, 1e-12);
    EXPECT_EQ(read.warnings.size(), 1u); // steps of 300 nm
    // Called by its own name, with its own colour temperature: it is not the standard A.
    EXPECT_EQ(read.caption, "A.csv: 3836 K");
    EXPECT_EQ(find_lamp("A").caption, "A: incandescent, 2856 K");
}

TEST(Lamp, TakesTheColumnThatIsNamed) {
    const test::Folder folder;
    folder.write("two.csv", "nm,D65,old\n400,1,3\n550,2,2\n700,3,1\n");
    EXPECT_EQ(find_lamp("two.csv:OLD", folder / "").spectrum.at(400), 3.0);
    EXPECT_EQ(find_lamp("two.csv", folder / "", "d65").spectrum.at(400), 1.0);
    test::expect_problem([&] { find_lamp("two.csv", folder / ""); }, (folder / "two.csv").string(),
                         "holds 2 spectra; expected one of: D65, old, as FILE:NAME");
}

} // namespace
} // namespace tsuya
