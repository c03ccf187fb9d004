// Dye and surface of a table with channels, against made-up cloths of which both are known.

#include "tsuya/sdk/dye_separation.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::test {
namespace {

constexpr std::uint64_t kSeed = 20261128;

// Share of the light from `to_light` that passes the surface, by a sum over the hemisphere.
double passed(const Cloth &cloth, const glm::dvec3 &to_light) {
    constexpr int kRings = 45, kParts = 60;
    double sum = 0;
    for (int i = 0; i < kRings; ++i)
        for (int j = 0; j < kParts; ++j) {
            const double theta = 90 * (i + 0.5) / kRings;
            const glm::dvec3 v = direction(theta, 360 * (j + 0.5) / kParts);
            sum += reflectance(cloth, to_light, v) * v.z * std::sin(theta * kDegree);
        }
    return 1 - sum * (kPi / 2 / kRings) * (2 * kPi / kParts);
}

// Surface and, below it, a diffuser; one channel for each reflectance.
ReflectanceFile dyed(const Cloth &cloth, const std::vector<double> &body, double noise) {
    std::mt19937 random(kSeed);
    std::normal_distribution<double> normal(0, noise);
    const ReflectanceTable surface = normal_table(cloth, even_grid(10, 15));
    double mean_passed = 0;
    constexpr int kSteps = 10;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j)
            mean_passed +=
                passed(cloth, direction(std::asin(std::sqrt((i + 0.5) / kSteps)) / kDegree,
                                        360 * (j + 0.5) / kSteps)) /
                (kSteps * kSteps);
    ReflectanceFile file;
    for (const double r : body) {
        file.channels.push_back({.name = std::to_string(file.channels.size()), .table = surface});
        for (ReflectanceRow &row : file.channels.back().table.rows) {
            row.brdf_per_sr += r * passed(cloth, row.to_viewer()) / (kPi * mean_passed);
            row.brdf_per_sr *= 1 + normal(random);
        }
    }
    return file;
}

struct Dyed {
    std::vector<double> body;
    double noise = 0;
};

TEST(DyeSeparation, FindsBodyAndSurface) {
    const ReflectanceTable truth = normal_table(satin_cloth(), even_grid(10, 15));
    for (const Dyed &dye : {Dyed{{0.55, 0.05, 0.08}},
                            {{0.55, 0.05, 0.08}, 0.02},
                            {{0.8, 0.78, 0.7}},
                            {{0.02, 0.03, 0.02}}}) {
        const DyedCloth found = separate_dye(dyed(satin_cloth(), dye.body, dye.noise), "dyed.csv");
        const double slack = dye.noise > 0 ? 0.02 : 0.015;
        double mean = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(found.reflectance[c], dye.body[c], slack);
            mean += dye.body[c] / 3;
        }
        // The brighter the body, the less is known of the surface above it.
        double squares = 0;
        for (std::size_t i = 0; i < truth.rows.size(); ++i) {
            const double t = truth.rows[i].brdf_per_sr, f = found.surface.rows[i].brdf_per_sr;
            squares += (f - t) * (f - t) / static_cast<double>(truth.rows.size());
        }
        EXPECT_LT(std::sqrt(squares), 0.004 + 0.02 * mean / kPi) << dye.body[0];
    }
}

TEST(DyeSeparation, ABlackChannelHasNoBody) {
    // Channels that differ tell what is the body's even where none of them is free of it
    const DyedCloth found = separate_dye(dyed(satin_cloth(), {0.0, 0.3, 0.6}, 0), "dyed.csv");
    EXPECT_NEAR(found.reflectance[0], 0, 0.015);
    EXPECT_NEAR(found.reflectance[1] - found.reflectance[0], 0.3, 0.005);
    EXPECT_NEAR(found.reflectance[2] - found.reflectance[0], 0.6, 0.01);
}

TEST(DyeSeparation, RefusesWhatCannotBe) {
    ReflectanceFile file = dyed(satin_cloth(), {0.1, 0.2}, 0);
    for (TableChannel &channel : file.channels)
        for (ReflectanceRow &row : channel.table.rows)
            row.theta_i = 0.5;
    EXPECT_THROW(separate_dye(file, "dyed.csv"), Error);
    file = dyed(satin_cloth(), {0.1, 1.3}, 0);
    try {
        separate_dye(file, "dyed.csv");
        FAIL();
    } catch (const Error &error) {
        EXPECT_NE(error.problems().at(0).what.find("the body of channel 1 reflects 1."),
                  std::string::npos)
            << error.what();
        EXPECT_EQ(error.problems()[0].where, "dyed.csv");
    }
}

} // namespace
} // namespace tsuya::test
