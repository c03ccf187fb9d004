// The rough boundary of a filament: reciprocal, and sampled as it is evaluated.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lab/filament_samples.h"
#include "rough_dielectric.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::lab {
namespace {

constexpr double kIndex = 1.55;
using Normals = RoughDielectric::Normals;

RoughDielectric boundary(double slope, Normals normals = Normals::visible) {
    const FilamentOptics optics{
        .refractive_index = kIndex, .surface_roughness = slope, .transmission = 1};
    return {optics, RoughSurface(optics), normals};
}

TEST(RoughDielectric, IsReciprocal) {
    const RoughDielectric b = boundary(0.1);
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> unit;
    double largest = 0, without = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 from = direction_of(1.3 * unit(generator), 6.28 * unit(generator));
        glm::vec3 to = b.refracted(from, Side::outside);
        to += 0.1f * glm::vec3(direction_of(3.14 * unit(generator), 6.28 * unit(generator)));
        to = glm::normalize(to);
        if (to.z > -0.01f)
            continue;
        // Seen from the other side the normal points the other way
        const double there = b.through_per_sr(from, to, Side::outside) * from.z;
        const double back = b.through_per_sr(-to, -from, Side::inside) * -to.z * kIndex * kIndex;
        largest = std::max(largest, std::abs(there - back) / (there + back + 1e-2));
        without = std::max(without, std::abs(there - back / kIndex) / (there + back + 1e-2));
    }
    EXPECT_LT(largest, 1e-4);
    EXPECT_GT(without, 0.1) << "control";
}

/// Largest |z| of counts of what passes, in bins of the cosine and the turn, against densities.
double passage_z(double theta, double slope, Side side, Normals normals) {
    const RoughDielectric b = boundary(slope, normals), right = boundary(slope);
    const glm::vec3 from = direction_of(theta, 0.4);
    constexpr int kRows = 8, kColumns = 12, kCount = 400000, kFine = 40;
    constexpr double kPi2 = 2 * kPi;
    const Side other = side == Side::inside ? Side::outside : Side::inside;
    std::vector<double> count(kRows * kColumns), expected(count.size());
    Random random(5, 6, 7);
    for (int i = 0; i < kCount; ++i) {
        const RoughDielectric::Passage p = b.sample(from, side, random);
        if (!p.through)
            continue;
        const glm::vec3 d = p.direction;
        const int row = std::min(kRows - 1, static_cast<int>(-d.z * kRows));
        const int column = std::min(
            kColumns - 1, static_cast<int>((std::atan2(d.y, d.x) / kPi2 + 0.5) * kColumns));
        count[static_cast<std::size_t>(row * kColumns + column)] += 1;
    }
    for (int i = 0; i < kRows * kFine; ++i)
        for (int j = 0; j < kColumns * kFine; ++j) {
            const double mu = (i + 0.5) / (kRows * kFine), s = std::sqrt(1 - mu * mu);
            const double phi = kPi2 * ((j + 0.5) / (kColumns * kFine) - 0.5);
            const glm::vec3 to(s * std::cos(phi), s * std::sin(phi), -mu);
            double p = right.through_per_sr(from, to, side);
            p += right.even_per_sr(from.z, side, mu, other);
            expected[static_cast<std::size_t>(i / kFine * kColumns + j / kFine)] +=
                p * kPi2 / (kRows * kFine) / (kColumns * kFine);
        }
    double largest = 0;
    for (std::size_t k = 0; k < count.size(); ++k) {
        const double share = count[k] / kCount;
        // 2e-5: of the sum over the bin
        const double sigma = std::sqrt(share / kCount) + 2e-5;
        largest = std::max(largest, std::abs(share - expected[k]) / sigma);
    }
    return largest;
}

TEST(RoughDielectric, SamplesWhatItEvaluates) {
    for (const double theta : {20.0, 30.0, 40.0, 50.0})
        EXPECT_LT(passage_z(theta * kDegree, 0.15, Side::inside, Normals::visible), sidak_bound(96))
            << theta;
    for (const double theta : {35.0, 55.0, 75.0})
        EXPECT_LT(passage_z(theta * kDegree, 0.15, Side::outside, Normals::visible),
                  sidak_bound(96))
            << theta;
    for (const Side side : {Side::inside, Side::outside})
        EXPECT_GT(passage_z(side == Side::inside ? 0.6 : 1.3, 0.15, side, Normals::all),
                  sidak_bound(96))
            << "control";
}

} // namespace
} // namespace tsuya::lab
