#include "tsuya/sdk/accuracy.h"

#include <atomic>
#include <cmath>
#include <iostream>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::test {
namespace {

constexpr std::uint64_t kSeed = 20240919;

// A lobe about the mirror direction over a weak even light.
double lobe(const glm::dvec3 &to_light, const glm::dvec3 &to_viewer) {
    const glm::dvec3 mirror(-to_light.x, -to_light.y, to_light.z);
    return 0.02 + std::exp(8 * (glm::dot(mirror, to_viewer) - 1));
}

// Views of one light every so many degrees, from the pole to the horizon.
void add_light(ReflectanceTable &table, double theta_i, double phi_i, double theta_step = 5,
               double phi_step = 10) {
    for (double theta = 0; theta <= 90; theta += theta_step)
        for (double phi = 0; phi < 360; phi += phi_step)
            table.rows.push_back({theta_i * kDegree, phi_i * kDegree, theta * kDegree,
                                  phi * kDegree,
                                  lobe(direction(theta_i, phi_i), direction(theta, phi)), 0});
}

ReflectanceTable two_lights() {
    ReflectanceTable table{.symmetry = Symmetry::none};
    add_light(table, 30, 90);
    add_light(table, 0, 0);
    return table;
}

std::vector<glm::dvec3> even_views(double theta_step, double phi_step, double phi_range = 360) {
    std::vector<glm::dvec3> views;
    for (double theta = theta_step; theta <= 90; theta += theta_step)
        for (double phi = 0; phi < phi_range; phi += phi_step)
            views.push_back(direction(theta, phi));
    return views;
}

double total(const std::vector<double> &values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(SolidAngles, AreTheCellsOfAnEvenGrid) {
    const double step = 5 * kDegree;
    const std::vector<glm::dvec3> views = even_views(5, 5);
    const std::vector<double> area = solid_angles(views, {0, 0, 1}, Symmetry::none);
    EXPECT_NEAR(total(area), 2 * kPi, 1e-9);
    for (std::size_t i = 0; i < views.size(); ++i) {
        const double theta = std::acos(views[i].z);
        if (theta < 6 * kDegree) // shares the cap
            continue;
        const double ring = theta > 89 * kDegree ? step / 2 : step; // half above the horizon
        EXPECT_NEAR(area[i], std::sin(theta) * ring * step, 0.06 * std::sin(theta) * step * step)
            << theta / kDegree;
    }
    // Of a whole ring the counting grid has no error worth a name
    double ring = 0;
    for (std::size_t i = 0; i < views.size(); ++i)
        ring += std::abs(views[i].z - std::cos(45 * kDegree)) < 1e-9 ? area[i] : 0.0;
    EXPECT_NEAR(ring, 2 * kPi * (std::cos(42.5 * kDegree) - std::cos(47.5 * kDegree)), 2e-3);
}

TEST(SolidAngles, ShareWhatIsSeenTwice) {
    std::vector<glm::dvec3> views(19, direction(0, 0));
    views.push_back(direction(60, 0));
    const std::vector<double> area = solid_angles(views, {0, 0, 1}, Symmetry::none);
    for (std::size_t i = 1; i < 19; ++i)
        EXPECT_DOUBLE_EQ(area[i], area[0]);
    // The border is the great circle between the two: a lune of 90 - 30 degrees is the second's
    EXPECT_NEAR(area.back(), 2 * kPi * 60 / 180, 0.02);
    EXPECT_NEAR(total(area), 2 * kPi, 1e-9);
}

TEST(SolidAngles, MirrorsAsTheLightAllows) {
    const std::vector<glm::dvec3> quadrant = even_views(10, 10, 91);
    const std::vector<glm::dvec3> all = even_views(10, 10);
    const auto area = solid_angles(all, {0, 0, 1}, Symmetry::none);
    const auto mirrored = solid_angles(quadrant, {0, 0, 1}, Symmetry::orthotropic);
    for (std::size_t i = 0; i < quadrant.size(); ++i) {
        double sum = 0; // of all views that are mirror images of this one
        for (std::size_t j = 0; j < all.size(); ++j)
            if (glm::distance(glm::abs(all[j]), glm::abs(quadrant[i])) < 1e-6)
                sum += area[j];
        EXPECT_NEAR(mirrored[i], sum, 1e-4); // points on a border fall to either side
    }
    // A slanting light along the weft keeps one mirror only: what lies across is the edge's
    const auto slanting = solid_angles(quadrant, direction(45, 0), Symmetry::orthotropic);
    const auto none = solid_angles(quadrant, direction(45, 45), Symmetry::orthotropic);
    const auto at = [&](const std::vector<double> &w, double phi) {
        double sum = 0;
        for (std::size_t i = 0; i < quadrant.size(); ++i)
            if (std::abs(std::atan2(quadrant[i].y, quadrant[i].x) - phi) < 1e-9)
                sum += w[i];
        return sum;
    };
    EXPECT_GT(at(slanting, kPi / 2), 5 * at(slanting, kPi / 4));
    EXPECT_NEAR(at(slanting, 0), at(mirrored, 0) / 2, 1e-3); // no image behind the light
    EXPECT_GT(at(none, 0), 5 * at(none, kPi / 4));
}

TEST(Accuracy, IsExactForAPerfectModel) {
    const Accuracy accuracy = measure_accuracy(two_lights(), lobe);
    ASSERT_EQ(accuracy.directions.size(), 2u);
    EXPECT_EQ(accuracy.directions[0].theta_i, 0.0); // sorted
    EXPECT_NEAR(accuracy.directions[1].phi_i, 90 * kDegree, 1e-12);
    EXPECT_EQ(accuracy.directions[1].views, 19u * 36);
    for (const LightAccuracy &light : accuracy.directions) {
        EXPECT_LT(light.error.mean_over_peak.value(), 1e-15);
        EXPECT_LT(light.error.ring_over_peak.value(), 1e-15);
        EXPECT_LT(light.error.l2_cos.value(), 1e-15);
        EXPECT_NEAR(light.error.albedo_ratio.value(), 1, 1e-15);
        EXPECT_LT(light.error.log_p95.value(), 1e-15);
        EXPECT_FALSE(light.error.noise_floor); // no standard errors
    }
}

TEST(Accuracy, OfAModelTimesElevenTenths) {
    const Accuracy accuracy = measure_accuracy(
        two_lights(), [](const auto &l, const auto &v) { return 1.1 * lobe(l, v); });
    for (const ErrorMeasures &error :
         {accuracy.mean, accuracy.directions[0].error, accuracy.directions[1].error}) {
        EXPECT_NEAR(error.l2_cos.value(), 0.1, 1e-12);
        EXPECT_NEAR(error.albedo_ratio.value(), 1.1, 1e-12);
        EXPECT_NEAR(error.log_p95.value(), std::log10(1.1), 1e-12);
    }
}

// Four views in one ring, which own alike, one at the pole and one on the horizon.
TEST(Accuracy, OfAHandfulByHand) {
    ReflectanceTable table{.symmetry = Symmetry::none};
    const double values[] = {1.0, 2.0, 4.0, 0.003};
    for (int i = 0; i < 4; ++i)
        table.rows.push_back({0, 0, 60 * kDegree, i * kPi / 2, values[i], 0.5});
    table.rows.push_back({0, 1.0, 0, 0, 3.0, 0}); // the same light: theta_i is 0
    table.rows.push_back({0, 0, kPi / 2, 0, 50.0, 0});
    const Accuracy accuracy = measure_accuracy(table, [](const auto &, const auto &v) {
        return v.z > 0.9 ? 3.0 : v.z > 0.1 ? 2.0 : 9.0;
    });
    ASSERT_EQ(accuracy.directions.size(), 1u);
    const ErrorMeasures &error = accuracy.directions[0].error;
    const double differences = 1 + 0 + 2 + 1.997;
    // The largest measured value may be on the horizon; the view there has no other part
    EXPECT_NEAR(error.mean_over_peak.value(), differences / 5 / 50, 1e-12);
    EXPECT_NEAR(error.ring_over_peak.value(), differences / 4 / 50, 1e-12);
    // 0.003 is below 0.1 % of 50: of |log10| 0.301, 0, 0.301, 0 the 95th percentile is the largest
    EXPECT_NEAR(error.log_p95.value(), std::log10(2.0), 1e-12);

    table.rows.pop_back(); // now the ring is symmetric, but for the pole
    const auto area = [&] {
        std::vector<glm::dvec3> views;
        for (const ReflectanceRow &row : table.rows)
            views.push_back(direction(row.theta_r / kDegree, row.phi_r / kDegree));
        return solid_angles(views, {0, 0, 1}, Symmetry::none);
    }();
    const double ring = area[0], pole = area[4];
    EXPECT_NEAR(area[1], ring, 1e-9);
    EXPECT_NEAR(4 * ring + pole, 2 * kPi, 1e-9);
    const ErrorMeasures plain =
        measure_accuracy(table, [](const auto &, const auto &) { return 2.0; }).mean;
    // Ring: c = 1/2. Pole: f - m = -1, c = 1
    const double square = ring * (1 + 4 + 16 + 0.003 * 0.003) / 4 + pole * 9;
    const double difference = ring * (1 + 0 + 4 + 1.997 * 1.997) / 4 + pole * 1;
    EXPECT_NEAR(plain.l2_cos.value(), std::sqrt(difference / square), 1e-9);
    EXPECT_NEAR(plain.albedo_ratio.value(),
                (ring * 2 * 4 / 2 + pole * 2) / (ring * 7.003 / 2 + pole * 3), 1e-9);
    EXPECT_NEAR(plain.noise_floor.value(), std::sqrt(ring * 4 * 0.25 / 4 / square), 1e-9);
}

TEST(Accuracy, TellsWhatATableCannot) {
    ReflectanceTable table{.symmetry = Symmetry::none};
    add_light(table, 45, 0, 25, 30);                  // no ring near 60
    table.rows.push_back({kPi / 3, 0, 0, 0, 0.0, 0}); // a light under which nothing is seen
    const Accuracy accuracy =
        measure_accuracy(table, [](const auto &, const auto &) { return 0.0; });
    ASSERT_EQ(accuracy.directions.size(), 2u);
    EXPECT_FALSE(accuracy.directions[0].error.ring_over_peak);
    EXPECT_NEAR(accuracy.directions[0].error.l2_cos.value(), 1, 1e-12);
    EXPECT_EQ(accuracy.directions[0].error.albedo_ratio, 0.0);
    EXPECT_TRUE(std::isinf(accuracy.directions[0].error.log_p95.value()));
    for (const NamedMeasure &measure : error_measures())
        EXPECT_FALSE(accuracy.directions[1].error.*measure.value) << measure.name;
    EXPECT_NEAR(accuracy.mean.l2_cos.value(), 1, 1e-12); // the blind direction has no vote
    EXPECT_FALSE(accuracy.mean.ring_over_peak);
}

// Rings at 56 and 63 degrees: what is between them is four sevenths of the way.
TEST(Accuracy, InterpolatesTheRingAt60Degrees) {
    ReflectanceTable table{.symmetry = Symmetry::none};
    add_light(table, 45, 0, 7, 30);
    double sum = 0, peak = 0;
    for (const ReflectanceRow &row : table.rows)
        peak = std::max(peak, row.brdf_per_sr);
    for (double phi = 0; phi < 360; phi += 30) {
        const double below = lobe(direction(45, 0), direction(56, phi));
        const double above = lobe(direction(45, 0), direction(63, phi));
        sum += below * 3 / 7 + above * 4 / 7;
    }
    const auto black = [](const auto &, const auto &) { return 0.0; };
    const auto ring = [&] { return measure_accuracy(table, black).mean.ring_over_peak; };
    EXPECT_NEAR(ring().value(), sum / 12 / peak, 1e-12);
    EXPECT_LT(measure_accuracy(table, lobe).mean.ring_over_peak.value(), 1e-15);

    // Azimuths of the outer ring between those of the inner: linear in azimuth too
    for (ReflectanceRow &row : table.rows)
        row.brdf_per_sr = row.theta_r > kPi / 3 ? row.phi_r : 1;
    for (ReflectanceRow &row : table.rows)
        row.phi_r += row.theta_r > kPi / 3 ? 15 * kDegree : 0.0;
    double turned = 0;
    for (int i = 0; i < 12; ++i) // half way between neighbours, of the first and the last too
        turned += 3.0 / 7 + 4.0 / 7 * (i == 0 ? 165 : i * 30 - 15) * kDegree;
    EXPECT_NEAR(ring().value(), turned / 12 / (330 * kDegree), 1e-12);

    // A view within half a degree of 60 is on the ring
    table.rows.push_back({45 * kDegree, 0, 60.4 * kDegree, 0, 0.5, 0});
    EXPECT_NEAR(ring().value(), 0.5 / (330 * kDegree), 1e-12);
}

TEST(Accuracy, SaysWhereAllLightIsFromAbove) {
    ReflectanceTable table{.symmetry = Symmetry::none};
    add_light(table, 0.3, 20);
    EXPECT_TRUE(TableAccuracy(table).only_from_above());
    add_light(table, 30, 20);
    EXPECT_FALSE(TableAccuracy(table).only_from_above());
}

TEST(SolidAngles, AreThoseOfTheNearestViews) {
    // Views in clusters and voids, against a search through all of them
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<glm::dvec3> views;
    for (int i = 0; i < 60; ++i)
        views.push_back(direction(i % 3 ? 90 * uniform(random) : 88 + uniform(random),
                                  i % 2 ? 360 * uniform(random) : 10 * uniform(random)));
    std::vector<double> expected(views.size(), 0.0);
    constexpr int kRings = 150, kParts = 600;
    for (int i = 0; i < kRings; ++i)
        for (int j = 0; j < kParts; ++j) {
            const double cosine = (i + 0.5) / kRings;
            const glm::dvec3 d = direction(std::acos(cosine) / kDegree, 360 * (j + 0.5) / kParts);
            const auto nearest = std::max_element(views.begin(), views.end(),
                                                  [&](const glm::dvec3 &a, const glm::dvec3 &b) {
                                                      return glm::dot(a, d) < glm::dot(b, d);
                                                  });
            expected[static_cast<std::size_t>(nearest - views.begin())] +=
                2 * kPi / (kRings * kParts);
        }
    const std::vector<double> area = solid_angles(views, {0, 0, 1}, Symmetry::none);
    for (std::size_t i = 0; i < views.size(); ++i)
        EXPECT_NEAR(area[i], expected[i], 4e-3) << i;
}

TEST(Accuracy, RefusesWhatCannotBeCompared) {
    EXPECT_THROW(measure_accuracy({}, lobe), Error);
    for (const double wrong : {std::nan(""), -1.0, double(INFINITY)})
        try {
            measure_accuracy(two_lights(), [&](const auto &l, const auto &v) {
                return l.y > 0.1 && v.z < 0.5 ? wrong : 1.0;
            });
            ADD_FAILURE() << wrong;
        } catch (const Error &error) {
            EXPECT_NE(error.problems()[0].where.find("light (30.0"), std::string::npos)
                << error.what();
        }
}

TEST(Accuracy, Stops) {
    const std::atomic<bool> stop = true;
    EXPECT_THROW(measure_accuracy(two_lights(), lobe, {.stop = &stop}), Interrupted);
}

// The truth measured with noise of the stated sigma, some times over: root of the mean square of
// l2_cos over noise_floor, which is 1 if the sigmas tell the truth.
double noise_over_floor(double told) {
    std::mt19937_64 engine(kSeed);
    std::normal_distribution<double> normal;
    ReflectanceTable truth{.symmetry = Symmetry::none};
    add_light(truth, 30, 90, 10, 15);
    double sum = 0;
    constexpr int kTimes = 30;
    for (int i = 0; i < kTimes; ++i) {
        ReflectanceTable noisy = truth;
        for (ReflectanceRow &row : noisy.rows) {
            const double sigma = 0.02 * std::sqrt(row.brdf_per_sr);
            row.brdf_per_sr = std::max(0.0, row.brdf_per_sr + sigma * normal(engine));
            row.sigma_per_sr = told * sigma;
        }
        const ErrorMeasures error = measure_accuracy(noisy, lobe).mean;
        sum += std::pow(error.l2_cos.value() / error.noise_floor.value(), 2);
    }
    return std::sqrt(sum / kTimes);
}

TEST(Accuracy, NoiseFloorIsWhatNoiseMakes) {
    std::cout << "seed " << kSeed << "\n";
    EXPECT_NEAR(noise_over_floor(1), 1, 0.03);
    // Sigmas that are a tenth too small must be found out
    EXPECT_GT(noise_over_floor(0.9), 1.06);
}

} // namespace
} // namespace tsuya::test
