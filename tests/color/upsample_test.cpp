#include "tsuya/color/upsample.h"

#include <cmath>

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/srgb.h"

namespace tsuya {
namespace {

TEST(Upsample, GivesTheColourBack) {
    const Spectrum d65 = lamp("D65");
    const glm::dvec3 to_srgb = srgb_white() / white_of(d65);
    for (int code = 0; code < 6 * 6 * 6; ++code) {
        glm::dvec3 rgb(0.0);
        for (int c = 0, rest = code; c < 3; ++c, rest /= 6)
            rgb[c] = srgb_decode(rest % 6 / 5.0);
        const Spectrum s = reflectance_of_srgb(rgb);
        EXPECT_NO_THROW(check_spectrum(s, 0, 1, "reflectance"));
        const glm::dvec3 back = srgb_from_xyz() * (to_srgb * xyz_of(d65, s));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(back[c], rgb[c], 1e-8) << code;
    }
}

TEST(Upsample, GreyIsConstant) {
    for (const double level : {0.0, 0.25, 1.0}) {
        const Spectrum s = reflectance_of_srgb(glm::dvec3(level));
        EXPECT_TRUE(s.is_constant());
        EXPECT_EQ(s.at(500), level);
    }
}

// The sum that the fit makes least, in artanh(2 R - 1).
double slope(const Spectrum &s) {
    double sum = 0;
    for (std::size_t i = 1; i < s.value.size(); ++i) {
        const double d = std::atanh(2 * s.value[i] - 1) - std::atanh(2 * s.value[i - 1] - 1);
        sum += d * d;
    }
    return sum;
}

TEST(Upsample, NoMetamerIsSmoother) {
    const Spectrum s = reflectance_of_srgb(parse_srgb("#b05878"));
    const Spectrum d65 = lamp("D65");
    const glm::dvec3 xyz = xyz_of(d65, s);
    int metamers = 0;
    for (std::size_t i = 2; i + 5 < s.value.size(); ++i)
        for (const double step : {-0.01, 0.01}) {
            Spectrum other = s;
            // A metamer: one node moved, and three more that undo what that does to XYZ.
            const std::size_t undo[3] = {5, 15, 25};
            if (i == 5 || i == 15 || i == 25)
                continue;
            other.value[i] += step;
            glm::dmat3 effect(1.0);
            for (int n = 0; n < 3; ++n) {
                Spectrum probe = s;
                probe.value[undo[n]] += 1;
                effect[n] = xyz_of(d65, probe) - xyz;
            }
            const glm::dvec3 back = glm::inverse(effect) * (xyz_of(d65, other) - xyz);
            for (int n = 0; n < 3; ++n)
                other.value[undo[n]] -= back[n];
            ASSERT_NEAR(xyz_of(d65, other).y, xyz.y, 1e-9);
            EXPECT_GT(slope(other), slope(s)) << i;
            ++metamers;
        }
    EXPECT_GT(metamers, 40);
}

TEST(Upsample, RefusesImpossibleColour) {
    test::expect_problem([] { reflectance_of_srgb({1.2, 0, 0}, "dye"); }, "dye", "expected 0 to 1");
    test::expect_problem(
        [] {
            reflectance_of_srgb({0.2, NAN, 0}, "dye");
        },
        "dye", "expected 0 to 1");
}

} // namespace
} // namespace tsuya
