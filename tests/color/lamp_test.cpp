#include "tsuya/color/lamp.h"

#include <cmath>
#include <utility>

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
    for (const Row &row : {Row{"D65", 0.3127, 0.3290},     Row{"A", 0.4476, 0.4074},
                           Row{"D50", 0.3457, 0.3585},     Row{"HP3", 0.4301, 0.4075},
                           Row{"HP4", 0.3811, 0.3797},     Row{"HP5", 0.3775, 0.3714},
                           Row{"MH-NIST", 0.3725, 0.3856}, Row{"E", 0.3333, 0.3333},
                           Row{"HP1", 0.5330, 0.4150},     Row{"HP2", 0.4778, 0.4158},
                           Row{"FL2", 0.3721, 0.3751},     Row{"FL11", 0.3805, 0.3769},
                           Row{"FL12", 0.4370, 0.4042},    Row{"LED-B3", 0.3756, 0.3723},
                           Row{"C", 0.3101, 0.3162},       Row{"FL1", 0.3131, 0.3371},
                           Row{"FL3", 0.4091, 0.3941},     Row{"FL4", 0.4402, 0.4031},
                           Row{"FL5", 0.3138, 0.3452},     Row{"FL6", 0.3779, 0.3882},
                           Row{"FL7", 0.3129, 0.3292},     Row{"FL8", 0.3458, 0.3586},
                           Row{"FL9", 0.3741, 0.3727},     Row{"FL10", 0.3458, 0.3588},
                           Row{"LED-B1", 0.4560, 0.4078},  Row{"LED-B2", 0.4357, 0.4012},
                           Row{"LED-B4", 0.3422, 0.3502},  Row{"LED-B5", 0.3118, 0.3236},
                           Row{"LED-BH1", 0.4474, 0.4066}, Row{"LED-RGB1", 0.4557, 0.4211},
                           Row{"LED-V1", 0.4548, 0.4044},  Row{"LED-V2", 0.3781, 0.3775}}) {
        const glm::dvec2 xy = chromaticity(white_of(lamp(row.name)));
        EXPECT_NEAR(xy.x, row.x, 0.0005) << row.name;
        EXPECT_NEAR(xy.y, row.y, 0.0005) << row.name;
    }
}

TEST(Lamp, EveryNameIsKnownAndDescribed) {
    EXPECT_EQ(lamp_names().size(), 34u);
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
    test::expect_problem([] { lamp_description("HP9"); }, "lamp", "expected one of: A, C, D50");
    test::expect_problem([] { lamp("TL94"); }, "lamp", "did you mean TL84?");
    for (const char *name :
         {"D39", "D35", "D3900", "D26000", "499K", "1e4K", "D", "K", "F13", "FL0"})
        EXPECT_THROW(lamp(name), Error) << name;
    test::expect_problem([] { lamp("D30"); }, "lamp", "3002 K; expected 4000 to 25000 K");
    test::expect_problem([] { parse_lamp("led.doc"); }, "lamp", "no lamp 'led.doc'");
}

TEST(Lamp, NamesOfTheTrade) {
    for (const auto &[name, of] : {std::pair{"tl84", "FL11"},
                                   {"CWF", "FL2"},
                                   {"u30", "FL12"},
                                   {"F7", "FL7"},
                                   {"f12", "FL12"},
                                   {"d65", "D65"},
                                   {"mh-nist", "MH-NIST"},
                                   {"led-b3", "LED-B3"},
                                   {"HORIZON", "2300k"}})
        EXPECT_EQ(lamp(name), lamp(of)) << name;
    EXPECT_EQ(lamp_description("TL84"), "three-band fluorescent, 4000 K, as FL11");
    EXPECT_EQ(find_lamp("3200K").caption, "3200K: black body, 3200 K");
    for (const LampAlias &alias : lamp_aliases())
        EXPECT_EQ(lamp(alias.name), lamp(alias.lamp)) << alias.name;
}

TEST(Lamp, DaylightByFormulaIsThatOfTheTables) {
    // [CIE015] rounds its weights to three decimals, and so its tables.
    for (const auto &[by_table, by_formula] : {std::pair{"D50", "D50.0"}, {"D65", "D65.0"}}) {
        const Spectrum table = lamp(by_table), formula = lamp(by_formula);
        for (int nm = 380; nm <= 780; nm += 5)
            EXPECT_NEAR(formula.at(nm) / formula.at(560), table.at(nm) / 100, 6e-4)
                << by_table << nm;
    }
    EXPECT_NEAR(chromaticity(white_of(lamp("D55"))).x, 0.3324, 1e-4);
    EXPECT_NEAR(chromaticity(white_of(lamp("D75"))).y, 0.3149, 1e-4);
    EXPECT_EQ(lamp_description("D6500"), "daylight, 6500 K");
    EXPECT_EQ(lamp_description("D60"), "daylight, 6003 K");
}

TEST(Lamp, MixturesAreSharesOfLuminousPower) {
    const NamedLamp mixed = find_lamp("0.7*A + 0.3*d65");
    EXPECT_NEAR(mixed.factor, 1, 1e-15);
    const glm::dvec3 a = white_of(lamp("A")), d65 = white_of(lamp("D65"));
    const glm::dvec3 white = white_of(mixed.spectrum);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(white[c], 0.7 * a[c] + 0.3 * d65[c], 1e-9);
    EXPECT_EQ(mixed.caption, "0.7*A + 0.3*d65: 3513 K");
    EXPECT_EQ(find_lamp("A*0.5").factor, 0.5);
    EXPECT_EQ(find_lamp("500lx*A").factor, 0.5);
    EXPECT_EQ(find_lamp("A * 500lx").spectrum, lamp("A"));
    EXPECT_EQ(find_lamp("0*A").factor, 0);
    EXPECT_EQ(find_lamp("A+D65").factor, 2);
    const test::Folder folder;
    folder.write("my+b.csv", "400,1\n700,1\n");
    EXPECT_EQ(find_lamp("my+b.csv", folder / "").spectrum.at(500), 1);
    for (const char *spec :
         {"-1*A", "x*A", "A*", "*A", "inf*A", "nan*A", "2*3", "0.5*A+B", "A+", "", "0.5*"})
        EXPECT_THROW(check_lamp_spec(spec), Error) << spec;
}

TEST(Lamp, SetsOfLightBoxes) {
    const std::vector<std::string> specs{"HP4", "LightBox-USA"};
    EXPECT_EQ(expand_lamp_sets(specs), (std::vector<std::string>{"HP4", "D65", "CWF", "U30", "A"}));
    for (const LampSet &set : lamp_sets())
        for (const std::string &name : set.lamps)
            EXPECT_NO_THROW(check_lamp_spec(name));
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
