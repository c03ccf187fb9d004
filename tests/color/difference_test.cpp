#include "tsuya/color/difference.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tsuya {
namespace {

// [Sharma] Table 1: L*, a*, b* of both colours and their CIEDE2000.
constexpr double kPairs[34][7] = {
    {50.0000, 2.6772, -79.7751, 50.0000, 0.0000, -82.7485, 2.0425},
    {50.0000, 3.1571, -77.2803, 50.0000, 0.0000, -82.7485, 2.8615},
    {50.0000, 2.8361, -74.0200, 50.0000, 0.0000, -82.7485, 3.4412},
    {50.0000, -1.3802, -84.2814, 50.0000, 0.0000, -82.7485, 1.0000},
    {50.0000, -1.1848, -84.8006, 50.0000, 0.0000, -82.7485, 1.0000},
    {50.0000, -0.9009, -85.5211, 50.0000, 0.0000, -82.7485, 1.0000},
    {50.0000, 0.0000, 0.0000, 50.0000, -1.0000, 2.0000, 2.3669},
    {50.0000, -1.0000, 2.0000, 50.0000, 0.0000, 0.0000, 2.3669},
    {50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0009, 7.1792},
    {50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0010, 7.1792},
    {50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0011, 7.2195},
    {50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0012, 7.2195},
    {50.0000, -0.0010, 2.4900, 50.0000, 0.0009, -2.4900, 4.8045},
    {50.0000, -0.0010, 2.4900, 50.0000, 0.0010, -2.4900, 4.8045},
    {50.0000, -0.0010, 2.4900, 50.0000, 0.0011, -2.4900, 4.7461},
    {50.0000, 2.5000, 0.0000, 50.0000, 0.0000, -2.5000, 4.3065},
    {50.0000, 2.5000, 0.0000, 73.0000, 25.0000, -18.0000, 27.1492},
    {50.0000, 2.5000, 0.0000, 61.0000, -5.0000, 29.0000, 22.8977},
    {50.0000, 2.5000, 0.0000, 56.0000, -27.0000, -3.0000, 31.9030},
    {50.0000, 2.5000, 0.0000, 58.0000, 24.0000, 15.0000, 19.4535},
    {50.0000, 2.5000, 0.0000, 50.0000, 3.1736, 0.5854, 1.0000},
    {50.0000, 2.5000, 0.0000, 50.0000, 3.2972, 0.0000, 1.0000},
    {50.0000, 2.5000, 0.0000, 50.0000, 1.8634, 0.5757, 1.0000},
    {50.0000, 2.5000, 0.0000, 50.0000, 3.2592, 0.3350, 1.0000},
    {60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387, 1.2644},
    {63.0109, -31.0961, -5.8663, 62.8187, -29.7946, -4.0864, 1.2630},
    {61.2901, 3.7196, -5.3901, 61.4292, 2.2480, -4.9620, 1.8731},
    {35.0831, -44.1164, 3.7933, 35.0232, -40.0716, 1.5901, 1.8645},
    {22.7233, 20.0904, -46.6940, 23.0331, 14.9730, -42.5619, 2.0373},
    {36.4612, 47.8580, 18.3852, 36.2715, 50.5065, 21.2231, 1.4146},
    {90.8027, -2.0831, 1.4410, 91.1528, -1.6435, 0.0447, 1.4441},
    {90.9257, -0.5406, -0.9208, 88.6381, -0.8985, -0.7239, 1.5381},
    {6.7747, -0.2908, -2.4247, 5.8714, -0.0985, -2.2286, 0.6377},
    {2.0776, 0.0795, -1.1350, 0.9033, -0.0636, -0.5514, 0.9082},
};

TEST(Difference, MatchesAllPairsOfSharma) {
    for (const auto &p : kPairs) {
        const glm::dvec3 a(p[0], p[1], p[2]), b(p[3], p[4], p[5]);
        EXPECT_NEAR(ciede2000(a, b), p[6], 1e-4) << p[1] << ' ' << p[2] << ' ' << p[4];
        EXPECT_NEAR(ciede2000(b, a), p[6], 1e-4) << p[1] << ' ' << p[2] << ' ' << p[4];
        EXPECT_EQ(ciede2000(a, a), 0.0);
    }
}

// Pairs with their CMC(2:1), from the tests of colour-science 0.4.7: hues below, within and above
// 164 to 345 degrees, at chromas far beyond those of cloth.
TEST(Difference, CmcHitsPublishedPairs) {
    const glm::dvec3 standard(100, 21.57210357, 272.22819350);
    EXPECT_NEAR(cmc(standard, {100, 426.67945353, 72.39590835}), 172.70477, 5e-6);
    EXPECT_NEAR(cmc(standard, {100, 74.05216981, 276.45318193}), 20.59733, 5e-6);
    EXPECT_NEAR(cmc(standard, {100, 8.32281957, -73.58297716}), 121.71842, 1e-5);
}

// [ISO105J03] by hand at L* = 50, C* = 20, h = 90: S_L = 0.040975 x 50 / 1.8825,
// S_C = 1.276 / 1.262 + 0.638, and below L* = 16 S_L = 0.511.
TEST(Difference, CmcWeighsLightnessChromaAndHue) {
    const glm::dvec3 standard(50, 0, 20);
    EXPECT_NEAR(cmc(standard, {52, 0, 20}), 2 / (2 * 1.088313413), 1e-9);
    EXPECT_NEAR(cmc(standard, {52, 0, 20}, 1, 1), 2 / 1.088313413, 1e-8);
    EXPECT_NEAR(cmc(standard, {50, 0, 22}), 2 / 1.649093502, 1e-8);
    EXPECT_NEAR(cmc(standard, {50, 0, 22}, 2, 2), 1 / 1.649093502, 1e-8);
    EXPECT_NEAR(cmc({10, 0, 0}, {12, 0, 0}), 2 / (2 * 0.511), 1e-12);
    // Blue, 270 degrees: T = 0.56 + |0.2 cos 78|; the hue circle turned a little
    const double t = 0.56 + 0.2 * 0.2079116908, f = std::sqrt(160000.0 / 161900.0);
    const double turn = 0.01, chroma = 20;
    const glm::dvec3 blue(50, 0, -chroma);
    EXPECT_NEAR(cmc(blue, {50, chroma * std::sin(turn), -chroma * std::cos(turn)}),
                2 * chroma * std::sin(turn / 2) / (1.649093502 * (f * t + 1 - f)), 1e-7);
}

TEST(Difference, FormulaeByName) {
    const glm::dvec3 a(50, 10, 20), b(52, 12, 17);
    EXPECT_EQ(color_difference(DifferenceFormula::cmc, a, b), cmc(a, b));
    EXPECT_EQ(color_difference(DifferenceFormula::ciede2000, a, b), ciede2000(a, b));
    EXPECT_NEAR(color_difference(DifferenceFormula::cie76, a, b), std::sqrt(17.0), 1e-12);
    EXPECT_EQ(to_string(DifferenceFormula::cmc), "CMC(2:1)");
}

TEST(Difference, LabOfWhiteGreyAndDark) {
    const glm::dvec3 white(0.9505, 1.0, 1.089);
    EXPECT_EQ(lab_of(white, white), glm::dvec3(100, 0, 0));
    // [CIE015] Y/Yn = 0.184187 is L* = 50; below 0.008856 the slope is 903.3.
    EXPECT_NEAR(lab_of(0.18418651851244416 * white, white).x, 50.0, 1e-9);
    EXPECT_NEAR(lab_of(0.001 * white, white).x, 0.9032962962962963, 1e-9);
    // sRGB red beside D65: L* 53.24, a* 80.09, b* 67.20.
    const glm::dvec3 red = lab_of({0.41246, 0.21267, 0.01933}, {0.95047, 1.0, 1.08883});
    EXPECT_NEAR(red.x, 53.24, 0.01);
    EXPECT_NEAR(red.y, 80.09, 0.01);
    EXPECT_NEAR(red.z, 67.20, 0.01);
}

} // namespace
} // namespace tsuya
