// The small values of the sdk: frames, spectra, distributions, tables over the hemisphere, names.

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "sdk/hemisphere_quadrature.h"
#include "sdk/synthetic_table.h"
#include "tables/disk.h"
#include "tsuya/sdk/detail/albedo_table.h"
#include "tsuya/sdk/detail/disk_table.h"
#include "tsuya/sdk/detail/distribution.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/frame.h"
#include "tsuya/sdk/spectrum.h"
#include "tsuya/sdk/surface.h"

namespace tsuya::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

void expect_frame(const Frame &f, const glm::vec3 &normal) {
    EXPECT_EQ(f.normal, normal);
    for (const glm::vec3 &axis : {f.weft, f.warp, f.normal})
        EXPECT_NEAR(glm::length(axis), 1, 1e-6);
    EXPECT_NEAR(glm::dot(f.weft, f.warp), 0, 1e-6);
    EXPECT_NEAR(glm::dot(f.weft, f.normal), 0, 1e-6);
    EXPECT_NEAR(glm::dot(f.warp, f.normal), 0, 1e-6);
    EXPECT_LT(glm::length(glm::cross(f.weft, f.warp) - f.normal), 2e-6f);
}

glm::vec3 on_sphere(Random &random) {
    const glm::vec3 d = random.direction();
    return random.number() < 0.5f ? d : -d;
}

TEST(Frame, OrthonormalRightHandedAndTrueToTheWarp) {
    Random random(41);
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 normal = on_sphere(random), warp = on_sphere(random);
        const Frame f = make_frame(normal, warp);
        expect_frame(f, normal);
        EXPECT_GT(glm::dot(f.warp, warp), 0);
        EXPECT_NEAR(glm::dot(glm::cross(normal, warp), f.warp), 0, 1e-6) << "in their plane";
        expect_frame(make_frame(normal), normal);
        EXPECT_LT(glm::length(f.to_world(f.to_local(warp)) - warp), 2e-6f);
    }
}

TEST(Frame, DegenerateWarpsGiveAnyFrame) {
    Random random(42);
    for (int i = 0; i < 5000; ++i) {
        const glm::vec3 n = on_sphere(random), t = on_sphere(random);
        for (const glm::vec3 &warp : {glm::vec3(0), n, -3.0f * n, glm::vec3(kNan, 0, 0),
                                      glm::vec3(kInfinity, 1, 0), glm::vec3(1e30f), 1e-30f * t})
            expect_frame(make_frame(n, warp), n);
        // Nearly parallel: what is left of the warp is mostly rounding
        for (const float share : {1e-2f, 1e-4f, 1e-5f, 3e-6f, 1e-6f, 1e-7f})
            expect_frame(make_frame(n, n + share * t), n);
    }
}

TEST(Frame, PolesOfTheFrameWithoutWarp) {
    for (const glm::vec3 n : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1),
                              glm::vec3(0, 0, -0.0f) + glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)})
        expect_frame(make_frame(n), n);
}

TEST(Spectrum, LinearBetweenAndConstantBeyondItsSamples) {
    const Spectrum s{{400, 500, 700}, {0.2, 0.4, 0.0}};
    EXPECT_DOUBLE_EQ(s.at(300), 0.2);
    EXPECT_DOUBLE_EQ(s.at(400), 0.2);
    EXPECT_DOUBLE_EQ(s.at(450), 0.3);
    EXPECT_DOUBLE_EQ(s.at(650), 0.1);
    EXPECT_DOUBLE_EQ(s.at(900), 0.0);
    EXPECT_FALSE(s.is_constant());
    EXPECT_TRUE(Spectrum::constant(0.7).is_constant());
    EXPECT_DOUBLE_EQ(Spectrum::constant(0.7).at(123), 0.7);
}

TEST(Spectrum, BadOnesAreRefusedWithTheirPlace) {
    const auto expect_bad = [](const Spectrum &s) {
        try {
            check_spectrum(s, 0, 1, "satin.dye");
            ADD_FAILURE() << "expected an Error";
        } catch (const Error &error) {
            EXPECT_EQ(error.problems().at(0).where, "satin.dye");
            EXPECT_FALSE(error.problems()[0].accepted.empty());
        }
    };
    expect_bad({{}, {}});
    expect_bad({{400, 500}, {0.1}});
    expect_bad({{400, 400}, {0.1, 0.1}});
    expect_bad({{500, 400}, {0.1, 0.1}});
    expect_bad({{400, kNan}, {0.1, 0.1}});
    expect_bad({{kInfinity}, {0.1}});
    expect_bad({{400}, {kNan}});
    expect_bad({{400}, {1.1}});
    expect_bad({{400}, {-0.1}});
    EXPECT_NO_THROW(check_spectrum({{400, 500}, {0, 1}}, 0, 1, "satin.dye"));
}

TEST(Names, TheNearestIsSuggestedOnlyIfItIsNear) {
    const std::vector<std::string> known = {"theta_deg", "phi_deg", "brdf_per_sr"};
    EXPECT_EQ(nearest_name("theta_dge", known), "theta_deg");
    EXPECT_EQ(nearest_name("brdf", known), "");
    EXPECT_EQ(nearest_name("phi_dag", known), "phi_deg");
    EXPECT_EQ(nearest_name("x", known), "");
    EXPECT_EQ(nearest_name("", {}), "");
    EXPECT_EQ(accepted_names("phi_degs", known),
              "expected one of: theta_deg, phi_deg, brdf_per_sr; did you mean phi_deg?");
    EXPECT_EQ(accepted_names("symmetry", known),
              "expected one of: theta_deg, phi_deg, brdf_per_sr");
}

TEST(Distribution2D, DensityIsNormalisedAndMeetsItsWeights) {
    const std::vector<double> weights = {0, 1, 2, 3, 4, 0, 0, 0, 0, 5, 0.001, 7};
    const Distribution2D d(weights, 3, 4);
    double sum = 0;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) {
            const glm::vec2 centre((static_cast<float>(column) + 0.5f) / 4,
                                   (static_cast<float>(row) + 0.5f) / 3);
            const double w = weights[static_cast<std::size_t>(4 * row + column)];
            EXPECT_NEAR(d.density(centre), w / 22.001 * 12, 1e-5);
            sum += d.density(centre) / 12;
        }
    EXPECT_NEAR(sum, 1, 1e-6);
}

TEST(Distribution2D, DrawsFollowTheDensity) {
    const std::vector<double> weights = {0, 1, 2, 3, 4, 0, 0, 0, 0, 5, 0.001, 7};
    const Distribution2D d(weights, 3, 4);
    constexpr int kDraws = 100000, kParts = 2; // each cell is also even inside
    std::vector<double> observed(weights.size() * kParts * kParts), expected(observed.size());
    const int columns = 4 * kParts, rows = 3 * kParts;
    Random random(43);
    for (int i = 0; i < kDraws; ++i) {
        const auto s = d.sample({random.number(), random.number()});
        ASSERT_TRUE(s.point.x >= 0 && s.point.x < 1 && s.point.y >= 0 && s.point.y < 1);
        EXPECT_FLOAT_EQ(s.density, d.density(s.point));
        const int column = static_cast<int>(s.point.x * static_cast<float>(columns));
        const int row = static_cast<int>(s.point.y * static_cast<float>(rows));
        observed[static_cast<std::size_t>(row * columns + column)] += 1;
    }
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            expected[static_cast<std::size_t>(row * columns + column)] =
                kDraws * weights[static_cast<std::size_t>(row / kParts * 4 + column / kParts)] /
                22.001 / (kParts * kParts);
    EXPECT_GT(chi_square_p_value(observed, expected), sidak_threshold(1));
    std::rotate(expected.begin(), expected.begin() + 1, expected.end());
    EXPECT_LT(chi_square_p_value(observed, expected), 1e-6) << "a wrong expectation must fail";
}

TEST(Distribution2D, NoWeightCountsAsEven) {
    const Distribution2D d(std::vector<double>(6, 0.0), 2, 3);
    for (const float x : {0.1f, 0.5f, 0.9f})
        EXPECT_NEAR(d.density({x, 0.7f}), 1, 1e-5);
    const auto edge = d.sample({0, 0.99999994f});
    EXPECT_TRUE(edge.point.x >= 0 && edge.point.y < 1);
}

TEST(Disk, MapsInvert) {
    Random random(44);
    for (int i = 0; i < 20000; ++i) {
        const glm::vec2 u(random.number(), random.number());
        EXPECT_LT(glm::length(square_of_disk(disk_of_square(u)) - u), 2e-6f);
        const glm::vec3 d = random.direction();
        EXPECT_LT(glm::length(direction_of_disk(disk_of_direction(d)) - d), 2e-6f);
    }
    EXPECT_EQ(square_of_disk({0, 0}), glm::vec2(0.5f));
}

TEST(Disk, MapsKeepArea) {
    Random random(45);
    constexpr int kDraws = 100000, kBins = 10;
    std::vector<double> heights(kBins), expected(kBins, double(kDraws) / kBins);
    for (int i = 0; i < kDraws; ++i) {
        const glm::vec3 d = direction_of_disk(disk_of_square({random.number(), random.number()}));
        heights[static_cast<std::size_t>(std::min(9, static_cast<int>(d.z * kBins)))] += 1;
    }
    EXPECT_GT(chi_square_p_value(heights, expected), sidak_threshold(1));
}

TEST(DiskTable, MeetsASmoothFunction) {
    const auto mirrored = [](const glm::vec3 &d) { return 1 + d.x * d.x + 0.5f * d.z; };
    const auto free = [](const glm::vec3 &d) { return 1 + d.x * d.y + 0.3f * d.y + 0.5f * d.z; };
    const DiskTable quadrant(65, true, mirrored), whole(129, false, free);
    Random random(46);
    for (int i = 0; i < 5000; ++i) {
        const glm::vec3 d = random.direction();
        EXPECT_NEAR(quadrant.at(d), mirrored(d), 0.01);
        EXPECT_NEAR(whole.at(d), free(d), 0.01);
    }
}

TEST(AlbedoTable, MeetsAFunctionThatIsSteepAtGrazingUnderEverySymmetry) {
    const auto steep = [](const glm::vec3 &d) { return 1 - std::sqrt(d.z); };
    const auto mirrored = [=](const glm::vec3 &d) { return steep(d) * (1 + d.x * d.x); };
    const auto turned = [=](const glm::vec3 &d) { return steep(d) * (1 + 0.5f * d.x * d.y); };
    const auto free = [=](const glm::vec3 &d) { return steep(d) * (1 + 0.5f * d.x + 0.3f * d.y); };
    const AlbedoTable a(Symmetry::orthotropic, mirrored), b(Symmetry::half_turn, turned),
        c(Symmetry::none, free);
    Random random(47);
    for (int i = 0; i < 5000; ++i) {
        const glm::vec3 d =
            i % 2 ? random.direction()
                  : glm::vec3(direction(85 + 5 * random.number(), 360 * random.number()));
        EXPECT_NEAR(a.at(d), mirrored(d), 0.015);
        EXPECT_NEAR(b.at(d), turned(d), 0.015);
        EXPECT_NEAR(c.at(d), free(d), 0.015);
    }
    EXPECT_EQ(a.at({0, 0, 1}), 0);
    EXPECT_NEAR(a.at({1, 0, 0}), 2, 0.03);
    EXPECT_NEAR(a.maximum(), 2, 0.03);
    EXPECT_EQ(a.cosine_above(3), 0);
    EXPECT_GT(a.cosine_above(-1), 1);
    for (const float value : {0.1f, 0.5f, 1.0f, 1.5f}) {
        const float cosine = a.cosine_above(value);
        const float sine = std::sqrt(1 - cosine * cosine);
        EXPECT_LE(a.at({sine, 0, cosine}), value);
        EXPECT_GT(a.at({std::sqrt(1 - 0.7f * cosine * 0.7f * cosine), 0, 0.7f * cosine}), value);
    }
}

TEST(Surface, BrokenOnesAreRefusedWithTheirPlace) {
    const Surface good{.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                       .normal = std::vector<glm::vec3>(3, {0, 0, 1}),
                       .triangle = {{0, 1, 2}}};
    EXPECT_NO_THROW(check_surface(good, "dress"));
    const auto expect_bad = [&](const auto &spoil) {
        Surface s = good;
        spoil(s);
        try {
            check_surface(s, "dress");
            ADD_FAILURE() << "expected an Error";
        } catch (const Error &error) {
            EXPECT_EQ(error.problems().at(0).where, "dress");
        }
    };
    expect_bad([](Surface &s) { s.triangle.clear(); });
    expect_bad([](Surface &s) { s.triangle[0].z = 3; });
    expect_bad([](Surface &s) { s.position[1].x = kNan; });
    expect_bad([](Surface &s) { s.normal.pop_back(); });
    expect_bad([](Surface &s) { s.normal[2] = {0, 0, 2}; });
    expect_bad([](Surface &s) { s.normal[2] = glm::vec3(kNan); });
    expect_bad([](Surface &s) { s.normal.clear(); });
    expect_bad([](Surface &s) { s.warp = {{0, 1, 0}}; });
    expect_bad([](Surface &s) { s.uv = {{0, 1}}; });
    expect_bad([](Surface &s) { s.panel = {0, 0}; });
}

} // namespace
} // namespace tsuya::test
