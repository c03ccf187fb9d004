#include "tsuya/color/dye.h"

#include <cmath>

#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/difference.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/srgb.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

glm::dvec3 lab_under(const Spectrum &lit, const Spectrum &reflectance) {
    return lab_of(xyz_of(lit, reflectance), white_of(lit));
}

double hue_deg(const glm::dvec3 &lab) {
    const double h = std::atan2(lab.z, lab.y) / kDegree;
    return h < 0 ? h + 360 : h;
}

TEST(Dye, EveryNameIsAReflectance) {
    EXPECT_GE(dye_names().size(), 13u);
    for (const std::string &name : dye_names()) {
        const Spectrum s = dye(name);
        EXPECT_NO_THROW(check_spectrum(s, 0.005, 0.85, name));
        EXPECT_FALSE(dye_description(name).empty());
        for (std::size_t i = 1; i < s.value.size(); ++i) // smooth: the K hats can follow
            EXPECT_LT(std::abs(s.value[i] - s.value[i - 1]), 0.13) << name;
        EXPECT_EQ(parse_dye(name).value, s.value);
    }
}

TEST(Dye, WhiteIsNearlyFlat) {
    const Spectrum white = dye("white");
    EXPECT_NEAR(white.at(560), 0.80, 0.005);
    EXPECT_LT(white.at(400), white.at(560));
    EXPECT_GT(white.at(400), 0.70);
}

TEST(Dye, LooksLikeItsName) {
    struct Row {
        const char *name;
        double low_deg, high_deg, low_l, high_l; ///< hue angle and lightness in CIELAB under D65
    };
    const Spectrum d65 = lamp("D65");
    for (const Row &row : {Row{"gold", 65, 90, 65, 80}, Row{"vermilion", 25, 50, 40, 55},
                           Row{"madder", 15, 40, 35, 50}, Row{"crimson", 5, 25, 25, 40},
                           Row{"violet", 280, 310, 30, 50}, Row{"indigo", 265, 295, 20, 40},
                           Row{"turquoise", 195, 235, 60, 75}, Row{"emerald", 140, 175, 45, 60}}) {
        const glm::dvec3 lab = lab_under(d65, dye(row.name));
        EXPECT_GT(hue_deg(lab), row.low_deg) << row.name;
        EXPECT_LT(hue_deg(lab), row.high_deg) << row.name;
        EXPECT_GT(lab.x, row.low_l) << row.name;
        EXPECT_LT(lab.x, row.high_l) << row.name;
    }
    EXPECT_LT(lab_under(d65, dye("black")).x, 20);
    EXPECT_GT(lab_under(d65, dye("ivory")).z, 5);
}

TEST(Dye, ColoursDifferUnderMetalHalideAndTungsten) {
    for (const char *name : {"gold", "vermilion", "crimson", "rose", "turquoise", "emerald"})
        EXPECT_GT(ciede2000(lab_under(lamp("HP4"), dye(name)), lab_under(lamp("A"), dye(name))), 3)
            << name;
    EXPECT_LT(ciede2000(lab_under(lamp("HP4"), dye("silver")), lab_under(lamp("A"), dye("silver"))),
              1.5);
}

TEST(Dye, ParsesNamesFilesAndColours) {
    const test::Folder folder;
    folder.write("silk.csv", "400,0.2\n700,0.6\n");
    EXPECT_NEAR(parse_dye("silk.csv", folder / "").at(550), 0.4, 1e-12);
    const glm::dvec3 xyz = xyz_of(lamp("D65"), parse_dye("#c04020"));
    const glm::dvec3 rgb = srgb_from_xyz() * xyz;
    EXPECT_NEAR(255 * srgb_encode(rgb.x), 0xc0, 0.1);
    EXPECT_NEAR(255 * srgb_encode(rgb.y), 0x40, 0.1);
    EXPECT_NEAR(255 * srgb_encode(rgb.z), 0x20, 0.1);
}

TEST(Dye, LabIsMetUnderItsLamp) {
    const auto lab_of_spec = [](const std::string &spec, const char *lit, Observer observer) {
        const Spectrum l = lamp(lit);
        return lab_of(xyz_of(l, parse_dye(spec), observer), white_of(l, observer));
    };
    const auto expect_lab = [](const glm::dvec3 &got, const glm::dvec3 &wanted) {
        EXPECT_LT(ciede2000(got, wanted), 0.01) << got.x << " " << got.y << " " << got.z;
    };
    expect_lab(lab_of_spec("lab(50 20 -30)", "D65", Observer::cie1964), {50, 20, -30});
    expect_lab(lab_of_spec("LAB( 50 20 -30 A/2 )", "A", Observer::cie1931), {50, 20, -30});
    // Far outside sRGB, and still a reflectance.
    expect_lab(lab_of_spec("lab(55 -75 10)", "D65", Observer::cie1964), {55, -75, 10});
    EXPECT_TRUE(parse_dye("lab(50 0 0 HP4/2)").is_constant());
    EXPECT_EQ(parse_dye("lab(0 0 0)").at(550), 0);
    EXPECT_NEAR(parse_dye("lab(100 0 0)").at(550), 1, 1e-12);
}

TEST(Dye, MixturesAddAbsorption) {
    EXPECT_NEAR(parse_dye("indigo 0%").at(450), dye("white").at(450), 1e-12);
    const Spectrum one = parse_dye("indigo 1%"), indigo = dye("indigo");
    for (const double nm : {400.0, 500.0, 600.0, 700.0})
        EXPECT_NEAR(one.at(nm), indigo.at(nm), 1e-12);
    // K/S by hand at 600 nm.
    const auto k_over_s = [](double r) { return (1 - r) * (1 - r) / (2 * r); };
    const double ground = k_over_s(dye("white").at(600));
    const double sum = ground + 2 * (k_over_s(dye("indigo").at(600)) - ground) +
                       0.5 * (k_over_s(dye("madder").at(600)) - ground);
    const Spectrum mixed = parse_dye("Indigo 2% + madder 0.5%");
    EXPECT_NEAR(k_over_s(mixed.at(600)), sum, 1e-9 * sum);
    const test::Folder folder;
    folder.write("range.csv", "name,400,500,600,700,750\nred 2,0.1,0,0.5,0.6,1\n");
    const Spectrum own = parse_dye("range.csv:red 2 0.5% + white 3%", folder / "");
    EXPECT_NO_THROW(check_spectrum(own, 0, 1, "mixture"));
    EXPECT_GT(own.at(600), 0.5);
    EXPECT_LT(own.at(500), 0.001);
}

TEST(Dye, ClothHasItsOwnWhiteAndBlack) {
    EXPECT_EQ(parse_dye("cloth(#ffffff)").value, dye("white").value);
    EXPECT_NEAR(parse_dye("cloth(#000000)").at(550), dye("black").at(550), 1e-12);
    const glm::dvec3 grey = lab_under(lamp("D65"), parse_dye("cloth(#808080)"));
    EXPECT_LT(std::hypot(grey.y, grey.z), 2);
    EXPECT_NO_THROW(check_dye_spec("cloth(any.csv)"));
}

TEST(Dye, RefusesWrongSpecs) {
    test::expect_problem([] { dye("crimsom"); }, "dye", "did you mean crimson?");
    test::expect_problem([] { dye_description("blue"); }, "dye", "expected one of: white");
    test::expect_problem([] { parse_dye("blue", {}, "fabrics.satin.dye"); }, "fabrics.satin.dye",
                         "#rrggbb");
    test::expect_problem([] { parse_dye("#12", {}, "fabrics.satin.dye"); }, "fabrics.satin.dye",
                         "not an sRGB colour");
    for (const char *spec : {"lab(50 20)",
                             "lab(50 20 x)",
                             "lab(50 20 -30 D65)",
                             "lab(50 20 -30 D65/5)",
                             "lab(101 0 0)",
                             "lab(50 20 -30 D99/2)",
                             "lab(50 150 0)",
                             "lab()",
                             "indigo -1%",
                             "indigo 101%",
                             "indigo %",
                             "blue 2%",
                             "indigo 1% + madder",
                             "indigo nan%",
                             "2%",
                             "cloth()",
                             "cloth(blue)",
                             "cloth(#fff",
                             "",
                             "%"})
        EXPECT_THROW(check_dye_spec(spec), Error) << spec;
    test::expect_problem([] { parse_dye("lab(50 20)", {}, "here"); }, "here",
                         "expected such as lab(50 20 -30)");
    test::expect_problem([] { mix_dyes({}); }, "dye", "no dye");
    const test::Folder folder;
    const auto path = folder.write("bright.csv", "400,0.2\n700,600\n");
    test::expect_problem([&] { parse_dye(path.string()); }, path.string() + ":2:5",
                         "the value is 600; expected 0 to 100 percent");
}

} // namespace
} // namespace tsuya
