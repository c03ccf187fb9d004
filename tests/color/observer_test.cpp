#include "tsuya/color/observer.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/spectrum_file.h"

namespace tsuya {
namespace {

TEST(Observer, MatchesPublishedValues) {
    // [CIE015]: the 2-degree y has its peak of 1 at 555 nm, the 10-degree one at 557 nm.
    EXPECT_EQ(color_matching(Observer::cie1931, 555).y, 1.0);
    EXPECT_EQ(color_matching(Observer::cie1964, 557).y, 1.0);
    const glm::dvec3 blue = color_matching(Observer::cie1931, 450);
    EXPECT_NEAR(blue.x, 0.3362, 1e-12);
    EXPECT_NEAR(blue.y, 0.0380, 1e-12);
    EXPECT_NEAR(blue.z, 1.77211, 1e-12);
    EXPECT_EQ(color_matching(Observer::cie1931, 359), glm::dvec3(0.0));
    EXPECT_EQ(color_matching(Observer::cie1931, 831), glm::dvec3(0.0));
}

TEST(Observer, FunctionsHaveEqualAreas) {
    // Equal energy is white by definition: the three areas agree. [CIE015] gives 106.8566...
    for (const Observer observer : {Observer::cie1931, Observer::cie1964}) {
        glm::dvec3 sum(0.0);
        for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm)
            sum += color_matching(observer, nm);
        EXPECT_NEAR(sum.x / sum.y, 1.0, 5e-4);
        EXPECT_NEAR(sum.z / sum.y, 1.0, 5e-4);
    }
}

TEST(Observer, AgreesWithOutsideTables) {
    const auto folder = test::outside_data();
    if (folder.empty())
        GTEST_SKIP() << "TSUYA_TEST_DATA is not set";
    std::ifstream file(folder / "colorimetry/observers_1nm.csv");
    std::string line;
    std::getline(file, line);
    std::getline(file, line);
    int rows = 0;
    for (; std::getline(file, line); ++rows) {
        double v[7] = {};
        ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &v[0], &v[1], &v[2],
                              &v[3], &v[4], &v[5], &v[6]),
                  7);
        const int nm = static_cast<int>(v[0]);
        EXPECT_EQ(color_matching(Observer::cie1931, nm), glm::dvec3(v[1], v[2], v[3])) << nm;
        EXPECT_EQ(color_matching(Observer::cie1964, nm), glm::dvec3(v[4], v[5], v[6])) << nm;
    }
    EXPECT_EQ(rows, 471);
}

TEST(Observer, WhiteHasYOne) {
    for (const std::string &name : lamp_names())
        for (const Observer observer : {Observer::cie1931, Observer::cie1964})
            EXPECT_NEAR(white_of(lamp(name), observer).y, 1.0, 1e-12) << name;
    EXPECT_NEAR(xyz_of(lamp("HP4"), Spectrum::constant(0.25)).y, 0.25, 1e-12);
}

TEST(Observer, ChromaticityGoesBothWays) {
    const glm::dvec2 xy(0.3811, 0.3797);
    const glm::dvec2 back = chromaticity(0.37 * xyz_of_chromaticity(xy));
    EXPECT_NEAR(back.x, xy.x, 1e-12);
    EXPECT_NEAR(back.y, xy.y, 1e-12);
    EXPECT_EQ(chromaticity(glm::dvec3(0.0)), glm::dvec2(0.0));
}

TEST(Observer, WholeNanometresAreTheSumAt1Nm) {
    const Spectrum lit = lamp("HP4");
    for (const Observer observer : {Observer::cie1931, Observer::cie1964}) {
        glm::dvec3 sum(0.0);
        for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm)
            sum += lit.at(nm) * color_matching(observer, nm);
        const glm::dvec3 white = white_of(lit, observer);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(white[c], sum[c] / sum.y, 1e-14);
    }
}

TEST(Observer, LinesBetweenNanometresCountInFull) {
    // A wide line at 450 nm, and one of a tenth of a nanometre at 589.25 with the same energy.
    const Spectrum lines{{440, 450, 460, 589.2, 589.25, 589.3}, {0, 1, 0, 0, 200, 0}};
    const glm::dvec3 blue = color_matching(Observer::cie1931, 450);
    const glm::dvec3 yellow = glm::mix(color_matching(Observer::cie1931, 589),
                                       color_matching(Observer::cie1931, 590), 0.25);
    glm::dvec3 wide(0.0);
    for (int nm = 441; nm < 460; ++nm)
        wide += (1 - std::abs(nm - 450) / 10.0) * color_matching(Observer::cie1931, nm);
    const glm::dvec3 sum = wide + 10.0 * yellow, white = white_of(lines);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(white[c], sum[c] / sum.y, 2e-4) << blue[c];
    // The same at a tenth of a nanometre throughout, summed without the library.
    Spectrum fine{{}, {}};
    for (int i = 0; i <= 9400; ++i) {
        fine.wavelength_nm.push_back(360 + 0.05 * i);
        fine.value.push_back(lines.at(360 + 0.05 * i));
    }
    EXPECT_LT(glm::distance(white, white_of(fine)), 2e-4 * glm::length(white));
}

TEST(Observer, AnyUnitOfPowerWillDo) {
    const Spectrum lit = lamp("FL11");
    for (const double unit : {1e-305, 1e-150, 1e150, 1e305}) {
        Spectrum scaled = lit;
        for (double &v : scaled.value)
            v *= unit;
        EXPECT_LT(glm::distance(white_of(scaled), white_of(lit)), 1e-12) << unit;
    }
}

TEST(Observer, StepsOfAReflectanceAreMet) {
    // White beyond 560.5 nm, black below, within a hundredth of a nanometre.
    const Spectrum step{{560.495, 560.505}, {0, 1}};
    const Spectrum lit = lamp("E");
    double below = 0, all = 0;
    for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm) {
        const double y = color_matching(Observer::cie1931, nm).y;
        all += y;
        below += nm <= 560 ? y : 0;
    }
    EXPECT_NEAR(xyz_of(lit, step).y, 1 - below / all, 1e-4);
}

TEST(Observer, RefusesDarkLamp) {
    test::expect_problem([] { white_of(Spectrum::constant(0.0)); }, "lamp", "no visible power");
}

} // namespace
} // namespace tsuya
