#include "tsuya/color/adaptation.h"

#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/srgb.h"

namespace tsuya {
namespace {

TEST(Adaptation, MapsWhiteOnWhite) {
    for (const std::string &name : lamp_names())
        for (const Adaptation a : {Adaptation::bradford, Adaptation::cat02}) {
            const glm::dvec3 white = white_of(lamp(name));
            const glm::dvec3 seen = adaptation_matrix(a, white, srgb_white()) * white;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(seen[c], srgb_white()[c], 1e-12) << name;
        }
}

TEST(Adaptation, BradfordHasPublishedValues) {
    // D65 to D50 (rows) as Lindbloom publishes it for the whites of ASTM E308.
    const double rows[3][3] = {{1.0478112, 0.0228866, -0.0501270},
                               {0.0295424, 0.9904844, -0.0170491},
                               {-0.0092345, 0.0150436, 0.7521316}};
    const glm::dmat3 m =
        adaptation_matrix(Adaptation::bradford, {0.95047, 1.0, 1.08883}, {0.96422, 1.0, 0.82521});
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            EXPECT_NEAR(m[column][row], rows[row][column], 1e-6);
}

TEST(Adaptation, Cat02HasPublishedCones) {
    // [CIE159] the cones of a white come out by the printed matrix: scaling blue alone moves only
    // the third cone, so column sums of the matrix show in the adapted colour.
    const glm::dvec3 e(1.0), blue(1.0, 1.0, 2.0);
    const glm::dmat3 m = adaptation_matrix(Adaptation::cat02, blue, e);
    // Cones of (1,1,2): 0.8376, 1.0061, 1.9834; of (1,1,1): 1, 1, 1 (rows sum to 1).
    const glm::dvec3 cones_x(0.7328, -0.7036, 0.0030);
    const glm::dvec3 expected(cones_x.x / 0.8376, cones_x.y / 1.0061, cones_x.z / 1.9834);
    const glm::dvec3 x = m * glm::dvec3(1, 0, 0);
    EXPECT_NEAR(0.7328 * x.x + 0.4296 * x.y - 0.1624 * x.z, expected.x, 1e-9);
    EXPECT_NEAR(-0.7036 * x.x + 1.6975 * x.y + 0.0061 * x.z, expected.y, 1e-9);
    EXPECT_NEAR(0.0030 * x.x + 0.0136 * x.y + 0.9834 * x.z, expected.z, 1e-9);
}

TEST(Adaptation, NoneIsIdentity) {
    EXPECT_EQ(adaptation_matrix(Adaptation::none, white_of(lamp("A")), srgb_white()),
              glm::dmat3(1.0));
}

TEST(Adaptation, NamesGoBothWays) {
    for (const std::string &name : adaptation_names())
        EXPECT_EQ(to_string(parse_adaptation(name)), name);
    test::expect_problem([] { parse_adaptation("bradfort"); }, "adapt", "did you mean bradford?");
}

TEST(Adaptation, RefusesNarrowLamp) {
    const glm::dvec3 violet = xyz_of_chromaticity({0.1741, 0.0050}); // 380 nm alone
    test::expect_problem([&] { adaptation_matrix(Adaptation::bradford, violet, srgb_white()); },
                         "adapt", "not positive");
    EXPECT_FALSE(can_adapt(Adaptation::bradford, violet));
    EXPECT_TRUE(can_adapt(Adaptation::none, violet));
    EXPECT_TRUE(can_adapt(Adaptation::cat02, white_of(lamp("A"))));
}

} // namespace
} // namespace tsuya
