#include "tsuya/color/color_temperature.h"

#include <gtest/gtest.h>

#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"

namespace tsuya {
namespace {

std::optional<ColorTemperature> of_lamp(const char *name) {
    return color_temperature(chromaticity(white_of(lamp(name))));
}

TEST(ColorTemperature, OfPublishedIlluminants) {
    // [CIE015] correlated colour temperatures of its illuminants.
    struct Row {
        const char *name;
        double kelvin;
    };
    for (const Row &row :
         {Row{"A", 2856}, Row{"D50", 5003}, Row{"D65", 6504}, Row{"FL2", 4230}, Row{"FL11", 4000},
          Row{"FL12", 3000}, Row{"HP1", 1959}, Row{"HP2", 2506}, Row{"HP3", 3144}, Row{"HP4", 4002},
          Row{"HP5", 4039}, Row{"LED-B3", 4103}}) {
        const auto t = of_lamp(row.name);
        ASSERT_TRUE(t) << row.name;
        EXPECT_NEAR(t->kelvin, row.kelvin, 0.002 * row.kelvin) << row.name;
    }
    EXPECT_NEAR(of_lamp("D65")->duv, 0.0032, 0.0001); // daylight is above the locus
    EXPECT_NEAR(of_lamp("FL2")->duv, 0.0019, 0.0003); // [TM30] 0.0019
    EXPECT_LT(of_lamp("HP5")->duv, 0);
}

TEST(ColorTemperature, OfBlackBodiesIsTheirOwn) {
    for (const double kelvin : {1100.0, 2300.0, 3200.0, 5600.0, 12'000.0, 60'000.0}) {
        const auto t = color_temperature(chromaticity(white_of(black_body(kelvin))));
        ASSERT_TRUE(t) << kelvin;
        EXPECT_NEAR(t->kelvin, kelvin, 1e-3 * kelvin);
        EXPECT_NEAR(t->duv, 0, 1e-6);
    }
}

TEST(ColorTemperature, FarFromTheLocusThereIsNone) {
    EXPECT_FALSE(color_temperature({0.17, 0.75})); // green
    EXPECT_FALSE(color_temperature({0.16, 0.02})); // violet
    EXPECT_FALSE(color_temperature({0.72, 0.27})); // a line at 650 nm
}

} // namespace
} // namespace tsuya
