#include "tsuya/color/color_rendering.h"

#include <gtest/gtest.h>

#include "tsuya/color/lamp.h"

namespace tsuya {
namespace {

TEST(ColorRendering, GeneralIndexIsThePublishedOne) {
    // [CIE015] general colour rendering indices of its fluorescent illuminants, whole numbers.
    struct Row {
        const char *name;
        double ra;
    };
    for (const Row &row : {Row{"FL1", 76}, Row{"FL2", 64}, Row{"FL3", 57}, Row{"FL4", 51},
                           Row{"FL5", 72}, Row{"FL6", 59}, Row{"FL7", 90}, Row{"FL8", 96},
                           Row{"FL9", 90}, Row{"FL10", 81}, Row{"FL11", 83}, Row{"FL12", 83}})
        EXPECT_NEAR(lamp_figures(lamp(row.name)).ra.value_or(0), row.ra, 0.6) << row.name;
}

TEST(ColorRendering, FidelityAndGamutAreThoseOfTheSpreadsheet) {
    // [TM30] calculator of the IES for FL2: 4225 K, Rf 70, Rg 86; [CIE224] calculator: FL1 80.6,
    // FL2 70.1.
    const LampFigures fl2 = lamp_figures(lamp("FL2"));
    EXPECT_NEAR(fl2.temperature->kelvin, 4225, 1);
    EXPECT_NEAR(fl2.temperature->duv, 0.0019, 1e-4);
    EXPECT_NEAR(fl2.rf.value_or(0), 70.1, 0.15);
    EXPECT_NEAR(fl2.rg.value_or(0), 86, 0.5);
    EXPECT_NEAR(lamp_figures(lamp("FL1")).rf.value_or(0), 80.6, 0.15);
}

TEST(ColorRendering, ReferencesAreFaultless) {
    // Between 4000 and 5000 K the reference of Rf is a mixture that is no single lamp.
    for (const char *name : {"A", "2000K", "3900K", "D5050", "D65", "D90", "D20000"}) {
        const LampFigures figures = lamp_figures(lamp(name));
        EXPECT_NEAR(figures.ra.value_or(0), 100, 0.2) << name;
        EXPECT_NEAR(figures.rf.value_or(0), 100, 0.2) << name;
        EXPECT_NEAR(figures.rg.value_or(0), 100, 0.2) << name;
    }
    EXPECT_GT(lamp_figures(lamp("4500K")).rf.value_or(0), 97);
    EXPECT_LT(lamp_figures(lamp("HP1")).rf.value_or(100), 40);
}

TEST(ColorRendering, WithoutAColourTemperatureThereIsNone) {
    const LampFigures red = lamp_figures({{649, 650, 651}, {0, 1, 0}});
    EXPECT_NEAR(red.xy.x, 0.726, 0.001);
    EXPECT_FALSE(red.temperature || red.ra || red.rf || red.rg);
}

} // namespace
} // namespace tsuya
