#include "tsuya/lab/patch_window.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "tsuya/sdk/angle.h"

namespace tsuya::lab {
namespace {

/// The mean over a window of a texture with the weave's period: pixels are means over their area.
double weighted_texture(const PatchWindow &window, int side, const PictureLattice &lattice,
                        int order_weft, int order_warp, double phase) {
    const double determinant = lattice.weft.x * lattice.warp.y - lattice.weft.y * lattice.warp.x;
    double sum = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (int i = 0; i < 16; ++i) {
                const glm::dvec2 p(x + (i % 4 + 0.5) / 4, y + (i / 4 + 0.5) / 4);
                const double a = (p.x * lattice.warp.y - p.y * lattice.warp.x) / determinant,
                             b = (lattice.weft.x * p.y - lattice.weft.y * p.x) / determinant;
                sum += window.weights[static_cast<std::size_t>(y * side + x)] / 16 *
                       std::cos(2 * kPi * (order_weft * a + order_warp * b) + phase);
            }
    return sum;
}

double worst_texture(const PatchWindow &window, int side, const PictureLattice &lattice) {
    double worst = 0;
    for (const double phase : {0.0, 0.9, 2.1})
        for (const auto &[m, n] : {std::pair{1, 0}, {0, 1}, {1, 1}, {2, -1}})
            worst = std::max(worst, std::abs(weighted_texture(window, side, lattice, m, n, phase)));
    return worst;
}

TEST(PictureLattice, IsTurnedByTheStageAndForeshortened) {
    const PictureLattice above = lattice_in_picture({0.4, 0.8}, 0.05, {});
    EXPECT_NEAR(glm::length(above.weft - glm::dvec2(0, 8)), 0, 1e-12) << "along the plane of view";
    EXPECT_NEAR(glm::length(above.warp - glm::dvec2(16, 0)), 0, 1e-12);
    const PictureLattice turned =
        lattice_in_picture({0.4, 0.8}, 0.05, {.theta_r = 60 * kDegree, .phi_r = 90 * kDegree});
    EXPECT_NEAR(glm::length(turned.weft - glm::dvec2(-8, 0)), 0, 1e-12);
    EXPECT_NEAR(glm::length(turned.warp - glm::dvec2(0, 8)), 0, 1e-12);
}

TEST(PatchWindow, WeightsSumToOne) {
    const PictureLattice large{.weft = {0, 7}, .warp = {9, 0}},
        small{.weft = {0, 3}, .warp = {3, 1}}, huge{.weft = {0, 17}, .warp = {9, 0}};
    for (const PictureLattice &lattice : {large, small, huge}) {
        const PatchWindow window = repeat_window(16, lattice);
        EXPECT_EQ(window.weights.size(), 256u);
        EXPECT_NEAR(std::accumulate(window.weights.begin(), window.weights.end(), 0.0), 1, 1e-12);
        EXPECT_EQ(window.whole_repeats, lattice.weft != huge.weft);
    }
    EXPECT_EQ(repeat_window(16, huge).weights, even_window(16).weights);
}

// Of a texture of contrast 1 a window of whole repeats leaves little, at any turn of the cloth; an
// even patch leaves a tenth and more.
TEST(PatchWindow, RemovesThePeriodOfTheWeave) {
    double worst_even = 0;
    for (const double phi_deg : {0.0, 5.0, 20.0, 45.0, 70.0, 90.0})
        for (const double theta_deg : {0.0, 30.0, 60.0, 75.0}) {
            const DirectionPair view{.theta_r = theta_deg * kDegree, .phi_r = phi_deg * kDegree};
            for (const auto &[side, repeat_mm] : {std::pair{24, 0.5}, {40, 0.45}}) {
                const PictureLattice lattice =
                    lattice_in_picture({repeat_mm, repeat_mm * 1.1}, 0.05, view);
                const PatchWindow window = repeat_window(side, lattice);
                ASSERT_TRUE(window.whole_repeats);
                EXPECT_LT(worst_texture(window, side, lattice), 0.03)
                    << phi_deg << " " << theta_deg << " " << side;
                worst_even = std::max(worst_even, worst_texture(even_window(side), side, lattice));
            }
        }
    EXPECT_GT(worst_even, 0.1) << "the negative control";
}

TEST(PatchWindow, IsExactWhereRepeatsAreWholePixels) {
    const PictureLattice lattice{.weft = {0, 5}, .warp = {7, 0}};
    EXPECT_LT(worst_texture(repeat_window(16, lattice), 16, lattice), 1e-3);
    const PatchWindow window = repeat_window(16, lattice); // 2 x 3 repeats: 14 x 15 pixels
    EXPECT_NEAR(window.weights[16 * 8 + 8], 1.0 / 210, 1e-12);
    EXPECT_EQ(window.weights[16 * 8], 0);
}

} // namespace
} // namespace tsuya::lab
