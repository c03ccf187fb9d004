#include "tsuya/color/srgb.h"

#include <gtest/gtest.h>

#include "color_test.h"

namespace tsuya {
namespace {

TEST(Srgb, MatrixHasPublishedValues) {
    // [IEC61966] the rounded matrix of the standard, rows X, Y, Z.
    const double rows[3][3] = {
        {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
    const glm::dmat3 m = xyz_from_srgb();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            EXPECT_NEAR(m[column][row], rows[row][column], 5e-5);
    const glm::dvec3 white = srgb_from_xyz() * srgb_white();
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(white[c], 1.0, 1e-12);
}

TEST(Srgb, CurveGoesBothWays) {
    EXPECT_NEAR(srgb_encode(0.18), 0.46135612950044164, 1e-12);
    EXPECT_NEAR(srgb_encode(0.001), 0.01292, 1e-12);
    for (double v = -1; v <= 2; v += 0.01)
        EXPECT_NEAR(srgb_decode(srgb_encode(v)), v, 1e-6) << v;
}

TEST(Srgb, ParsesHexadecimal) {
    EXPECT_EQ(parse_srgb("#fff"), glm::dvec3(1.0));
    const glm::dvec3 rgb = parse_srgb("#Ff8000");
    EXPECT_EQ(rgb.x, 1.0);
    EXPECT_NEAR(rgb.y, srgb_decode(128 / 255.0), 1e-15);
    EXPECT_EQ(rgb.z, 0.0);
    for (const char *bad : {"", "#", "fff", "#ff", "#gg0000", "#ff00000"})
        test::expect_problem([&] { parse_srgb(bad, "dye"); }, "dye", "expected #rrggbb");
}

} // namespace
} // namespace tsuya
