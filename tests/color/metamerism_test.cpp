#include "tsuya/color/metamerism.h"

#include <cmath>

#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/adaptation.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/srgb.h"

namespace tsuya {
namespace {

// The worked pair of [ISO18314], D65 to A for 10 degrees, as colour-science 0.4.7 has it in the
// tests of its metamerism indices: tristimulus values, CIELAB, and reflectances at 10 nm.
const ClothPair kReferenceXyz{{7.6576, 10.7116, 5.0731}, {7.6933, 10.5616, 5.54474}};
const ClothPair kTestXyz{{8.96442, 10.1878, 1.6663}, {8.56438, 10.0324, 1.9315}};
const ClothPair kReferenceLab{{39.0908, -21.3269, 22.6657}, {38.83253, -19.8787, 20.0453}};
const ClothPair kTestLab{{38.17781, -17.4939, 21.0618}, {37.9013, -19.56327, 16.9346}};

Spectrum at_10_nm(std::vector<double> values) {
    Spectrum spectrum{{}, std::move(values)};
    for (std::size_t i = 0; i < spectrum.value.size(); ++i)
        spectrum.wavelength_nm.push_back(400.0 + 10.0 * static_cast<double>(i));
    return spectrum;
}

Spectrum worked_standard() {
    return at_10_nm({0.0990, 0.1244, 0.0933, 0.0596, 0.0405, 0.0322, 0.0299, 0.0316,
                     0.0377, 0.0507, 0.0681, 0.0968, 0.1522, 0.2014, 0.1991, 0.1590,
                     0.1162, 0.0843, 0.0655, 0.0570, 0.0553, 0.0582, 0.0638, 0.0716,
                     0.0818, 0.0959, 0.1131, 0.1317, 0.1490, 0.1656, 0.1832});
}

Spectrum worked_sample() {
    return at_10_nm({0.0379, 0.0403, 0.0415, 0.0427, 0.0450, 0.0483, 0.0521, 0.0572,
                     0.0624, 0.0673, 0.0777, 0.1026, 0.1307, 0.1450, 0.1484, 0.1455,
                     0.1375, 0.1254, 0.1099, 0.0908, 0.0698, 0.0526, 0.0423, 0.0368,
                     0.0331, 0.0306, 0.0297, 0.0311, 0.0340, 0.0380, 0.0421});
}

TEST(Metamerism, HitsTheWorkedPairOfTheStandard) {
    const glm::dvec3 white(111.144, 100, 35.200); // of A for 10 degrees in [E308]
    EXPECT_NEAR(metamerism_multiplicative(kReferenceXyz, kTestXyz, white, DifferenceFormula::cie76),
                3.7907, 5e-5);
    EXPECT_NEAR(metamerism_additive(kReferenceLab, kTestLab, DifferenceFormula::cie76), 3.8268,
                5e-5);
}

TEST(Metamerism, HitsTheWorkedPairFromItsSpectra) {
    const Spectrum d65 = lamp("D65"), a = lamp("A"), standard = worked_standard(),
                   sample = worked_sample();
    const auto index = [&](MetamerismCorrection correction) {
        return metamerism_index(standard, sample, d65, a,
                                {.observer = Observer::cie1964,
                                 .correction = correction,
                                 .formula = DifferenceFormula::cie76});
    };
    // Sums at 1 nm over straight lines between the samples differ from those at 10 nm by 1.5 %
    EXPECT_NEAR(index(MetamerismCorrection::multiplicative), 3.7907, 0.06);
    EXPECT_NEAR(index(MetamerismCorrection::additive), 3.8268, 0.06);
    EXPECT_NEAR(index(MetamerismCorrection::spectral), 3.4767, 0.03);
}

TEST(Metamerism, NothingIsLeftUnderTheReference) {
    const Spectrum d65 = lamp("D65");
    for (const MetamerismCorrection correction :
         {MetamerismCorrection::multiplicative, MetamerismCorrection::additive,
          MetamerismCorrection::spectral})
        for (const Observer observer : {Observer::cie1931, Observer::cie1964})
            EXPECT_NEAR(metamerism_index(dye("rose"), dye("gold"), d65, d65,
                                         {.observer = observer, .correction = correction}),
                        0.0, 1e-9)
                << static_cast<int>(correction);
    // A black cloth has nothing that a factor could scale.
    const Spectrum black = Spectrum::constant(0);
    EXPECT_GT(metamerism_index(dye("rose"), black, d65, lamp("A"),
                               {.correction = MetamerismCorrection::additive}),
              0.1);
    EXPECT_GT(metamerism_index(dye("rose"), black, d65, lamp("A"),
                               {.correction = MetamerismCorrection::spectral}),
              0.1);
}

TEST(Metamerism, IsZeroForEqualAndScaledOutUnderReference) {
    const Spectrum d65 = lamp("D65"), a = lamp("A");
    EXPECT_EQ(metamerism_index(dye("rose"), dye("rose"), d65, a), 0.0);
    // Under the reference itself no difference is left, whatever the two are.
    EXPECT_NEAR(metamerism_index(dye("rose"), dye("gold"), d65, d65), 0.0, 1e-9);
    // A colour made smooth matches the dye under D65, not under tungsten.
    const glm::dvec3 rgb = srgb_from_xyz() * xyz_of(d65, dye("rose"));
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x",
                  static_cast<unsigned>(std::lround(255 * srgb_encode(rgb.x))) & 255u,
                  static_cast<unsigned>(std::lround(255 * srgb_encode(rgb.y))) & 255u,
                  static_cast<unsigned>(std::lround(255 * srgb_encode(rgb.z))) & 255u);
    const double index = metamerism_index(dye("rose"), parse_dye(text), d65, a);
    EXPECT_GT(index, 0.3);
    EXPECT_LT(index, 6.0);
    test::expect_problem([&] { metamerism_index(dye("rose"), Spectrum::constant(0), d65, a); },
                         "reflectance", "black");
}

TEST(Inconstancy, IsZeroForGreyAndCmcOfTheAdapted) {
    const glm::dvec3 d65 = white_of(lamp("D65"), Observer::cie1964),
                     a = white_of(lamp("A"), Observer::cie1964);
    EXPECT_NEAR(color_inconstancy(0.2 * d65, d65, 0.2 * a, a), 0.0, 1e-9);
    // CIELAB of a cloth that looks redder under A: CAT02 of its white is that of D65, so a colour
    // that is scaled in the cones alike is the same; here X alone is a tenth more.
    const glm::dvec3 cloth(0.2, 0.15, 0.1);
    const glm::dvec3 corresponding =
        adaptation_matrix(Adaptation::cat02, d65, a) * glm::dvec3(0.22, 0.15, 0.1);
    EXPECT_NEAR(color_inconstancy(cloth, d65, corresponding, a),
                cmc(lab_of(cloth, d65), lab_of({0.22, 0.15, 0.1}, d65)), 1e-9);
    const glm::dvec3 line = xyz_of_chromaticity({0.72, 0.28});
    test::expect_problem([&] { color_inconstancy(cloth, d65, cloth, line); }, "adapt",
                         "no eye can adapt");
}

} // namespace
} // namespace tsuya
