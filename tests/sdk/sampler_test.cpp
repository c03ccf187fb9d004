// Random numbers of the path tracer: how evenly they lie, and what is independent of what.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "sampler.h"

namespace tsuya::test {
namespace {

constexpr std::uint32_t kPoints = 256;
constexpr Purpose kPurposes[] = {Purpose::pixel, Purpose::light_point, Purpose::lobe_and_strategy,
                                 Purpose::direction};

// Mean of f(sampler) over the first points of a pixel.
template <class F> double mean(std::uint32_t seed, F &&f) {
    double sum = 0;
    for (std::uint32_t i = 0; i < kPoints; ++i)
        sum += f(Sampler(seed, i));
    return sum / kPoints;
}

// Root mean square over many pixels of the mean of f, which is 0 in truth.
template <class F> double error(F &&f) {
    constexpr std::uint32_t kSeeds = 200;
    double squares = 0;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed)
        squares += std::pow(mean(seed, f), 2) / kSeeds;
    return std::sqrt(squares);
}

// Each dimension has one of the first 2^n points in each of 2^n parts of its range, at every
// vertex.
TEST(Sampler, EveryDimensionIsStratified) {
    for (const std::uint32_t vertex : {0u, 1u, 7u})
        for (const Purpose purpose : kPurposes)
            for (const int axis : {0, 1}) {
                std::vector<int> count(kPoints);
                for (std::uint32_t i = 0; i < kPoints; ++i) {
                    Sampler sampler(99, i);
                    sampler.go_to(vertex);
                    const float u = sampler.pair(purpose, 3)[axis];
                    ASSERT_GE(u, 0);
                    ASSERT_LT(u, 1);
                    ++count[static_cast<std::size_t>(u * kPoints)];
                }
                EXPECT_EQ(count, std::vector<int>(kPoints, 1));
            }
}

TEST(Sampler, FurtherDimensionsAreStratified) {
    for (const int axis : {0, 1}) {
        std::vector<int> count(kPoints);
        for (std::uint32_t i = 0; i < kPoints; ++i)
            ++count[static_cast<std::size_t>(Sampler(99, i).further_pair()[axis] * kPoints)];
        EXPECT_EQ(count, std::vector<int>(kPoints, 1));
    }
}

TEST(Sampler, PairsAreDistributedJointly) {
    const auto product = [](glm::vec2 a, glm::vec2 b) {
        return double(a.x - 0.5f) * double(b.x - 0.5f) + double(a.y - 0.5f) * double(b.y - 0.5f);
    };
    const auto joint = [&](const Sampler &s) {
        return product(s.pair(Purpose::pixel), s.pair(Purpose::light_point));
    };
    const auto other = [&](const Sampler &s) {
        return product(s.pair(Purpose::light_point, 2), s.pair(Purpose::direction));
    };
    const auto further = [&](const Sampler &s) {
        return product(s.pair(Purpose::pixel), s.further_pair());
    };
    const auto apart = [&](const Sampler &s) { // negative control
        return product(s.pair(Purpose::pixel), s.lone_pair(5));
    };
    const double random = std::sqrt(2.0) / 12 / std::sqrt(double(kPoints));
    EXPECT_LT(error(joint), 0.2 * random);
    EXPECT_LT(error(other), 0.2 * random);
    EXPECT_LT(error(further), 0.2 * random);
    EXPECT_NEAR(error(apart), random, 0.3 * random);
}

TEST(Sampler, VerticesAreIndependent) {
    const double random = 1 / 12.0 / std::sqrt(double(kPoints));
    const double e = error([](Sampler s) {
        const float first = s.pair(Purpose::direction).x;
        s.go_to(1);
        return double(first - 0.5f) * double(s.pair(Purpose::direction).x - 0.5f);
    });
    EXPECT_NEAR(e, random, 0.3 * random);
}

// Lights add up: so do the variances of what each of them gives.
TEST(Sampler, SumsOfWhatIsDoneSeveralTimesAreUncorrelated) {
    const auto curve = [](float u) { return std::exp(2 * double(u)) - 0.5 * (std::exp(2.0) - 1); };
    double products = 0, squares = 0;
    for (std::uint32_t seed = 1; seed <= 400; ++seed) {
        const auto sum = [&](std::uint32_t which) {
            return mean(seed, [&](const Sampler &s) {
                return curve(s.pair(Purpose::light_point, which).x);
            });
        };
        products += sum(0) * sum(1);
        squares += sum(0) * sum(0);
    }
    EXPECT_LT(std::abs(products), 0.2 * squares);
}

} // namespace
} // namespace tsuya::test
