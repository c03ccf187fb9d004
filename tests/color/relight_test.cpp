#include "tsuya/color/relight.h"

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <random>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "color_test.h"
#include "rows.h"
#include "tsuya/color/lamp.h"
#include "tsuya/sdk/detail/threads.h"

namespace tsuya {
namespace {

SpectralImage random_transport(int width, int height, SpectralBasis basis,
                               std::vector<std::string> groups) {
    SpectralImage image = SpectralImage::make(width, height, basis, std::move(groups));
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0f, 2.0f);
    for (float &t : image.transport)
        t = uniform(random);
    return image;
}

// The integral written out: hats drawn between their centres, no matrix, its own sums.
glm::dvec3 integrate(const float *t, const SpectralBasis &basis, const Spectrum &lit,
                     Observer observer) {
    glm::dvec3 sum(0.0);
    double white = 0;
    for (int nm = 360; nm <= 830; ++nm) {
        Spectrum curve{{}, {}};
        for (int k = 0; k < basis.count; ++k) {
            curve.wavelength_nm.push_back(basis.centre_nm(k));
            curve.value.push_back(static_cast<double>(t[k]));
        }
        sum += lit.at(nm) * curve.at(nm) * color_matching(observer, nm);
        white += lit.at(nm) * color_matching(observer, nm).y;
    }
    return sum / white;
}

// Every depth of the dye as light that dyed cloth reflects once or twice, under a lamp of lines.
TEST(Relight, DepthsOfDyeAreExactAtEveryWavelength) {
    const Spectrum steep{{420, 421, 588, 589, 590, 650}, {0.9, 0.02, 0.05, 0.97, 0.3, 0.6}};
    SpectralImage image = SpectralImage::make(1, 1, {.count = 8}, {"key"});
    image.depths = make_dye_depths({{.name = "silk", .dye = steep, .open = true}}, 8);
    const auto transport = [](double r) { return 0.1 + 0.7 * r + 0.2 * r * r; };
    for (std::size_t k = 0; k < 8; ++k)
        image.transport[k] = static_cast<float>(transport(image.depths->node[k][0]));
    for (const char *name : {"A", "FL11", "HP4"}) {
        const Spectrum lit = lamp(name);
        const Image xyz = relight(image, lit);
        glm::dvec3 sum(0.0);
        double white = 0;
        for (int nm = 360; nm <= 830; ++nm) {
            sum += lit.at(nm) * transport(steep.at(nm)) * color_matching(Observer::cie1931, nm);
            white += lit.at(nm) * color_matching(Observer::cie1931, nm).y;
        }
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(xyz.data[static_cast<std::size_t>(c)], (sum / white)[c], 1e-6) << name;
    }
}

/// The threads that take rows when so many are asked for. Each waits for the others, as a machine
/// that is busy may be slow to start them.
std::size_t threads_of_rows(int threads) {
    std::mutex mutex;
    std::condition_variable arrived;
    std::set<std::thread::id> ids;
    const auto wanted = static_cast<std::size_t>(threads);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    detail::run_with_threads(threads, [&] {
        for_rows(64, 1u << 17, [&](int, int) {
            std::unique_lock lock(mutex);
            ids.insert(std::this_thread::get_id());
            arrived.notify_all();
            arrived.wait_until(lock, end, [&] { return ids.size() >= wanted; });
        });
    });
    return ids.size();
}

TEST(Rows, RunOnTheThreadsThatAreAskedFor) {
    EXPECT_EQ(threads_of_rows(1), 1u);
    EXPECT_EQ(threads_of_rows(3), 3u);
}

TEST(Rows, EachIsTakenOnce) {
    for (const int height : {0, 1, 5, 1000})
        for (const std::size_t values : {std::size_t{1}, std::size_t{1} << 16}) {
            std::vector<int> taken(static_cast<std::size_t>(height));
            for_rows(height, values, [&](int first, int end) {
                for (int y = first; y < end; ++y)
                    ++taken[static_cast<std::size_t>(y)];
            });
            EXPECT_EQ(taken, std::vector<int>(static_cast<std::size_t>(height), 1));
        }
}

TEST(Relight, IsBitIdenticalForAnyNumberOfThreads) {
    const SpectralImage image = random_transport(300, 200, {.count = 16}, {"key", "fill"});
    std::vector<std::vector<float>> pictures;
    for (const int threads : {1, 2, 7})
        detail::run_with_threads(threads,
                                 [&] { pictures.push_back(relight(image, lamp("A")).data); });
    EXPECT_EQ(pictures[0], pictures[1]);
    EXPECT_EQ(pictures[0], pictures[2]);
}

TEST(Relight, AgreesWithIntegrationAtOneNanometre) {
    for (const int count : {1, 5, 8, 16, 31})
        for (const char *name : {"D65", "HP4", "A"})
            for (const Observer observer : {Observer::cie1931, Observer::cie1964}) {
                const SpectralImage image = random_transport(3, 2, {.count = count}, {"key"});
                const Image xyz = relight(image, lamp(name), {.observer = observer});
                ASSERT_EQ(xyz.channels, (std::vector<std::string>{"X", "Y", "Z"}));
                for (int y = 0; y < 2; ++y)
                    for (int x = 0; x < 3; ++x) {
                        const glm::dvec3 expected =
                            integrate(image.pixel(0, x, y), image.basis, lamp(name), observer);
                        for (int c = 0; c < 3; ++c)
                            EXPECT_NEAR(xyz.pixel(x, y)[c], expected[c], 2e-6) << name << count;
                    }
            }
}

TEST(Relight, MatrixGivesWhiteForOne) {
    for (const std::string &name : lamp_names()) {
        glm::dvec3 sum(0.0);
        for (const glm::dvec3 &xyz : lamp_matrix(lamp(name), {.count = 16}))
            sum += xyz;
        const glm::dvec3 white = white_of(lamp(name));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sum[c], white[c], 1e-12) << name;
    }
}

TEST(Relight, OneLampAGroup) {
    const SpectralImage both = random_transport(5, 4, {.count = 8}, {"key", "fill"});
    SpectralImage key = SpectralImage::make(5, 4, both.basis, {"key"}), fill = key;
    const auto half = static_cast<std::ptrdiff_t>(key.transport.size());
    std::copy_n(both.transport.begin(), half, key.transport.begin());
    std::copy_n(both.transport.begin() + half, half, fill.transport.begin());

    const std::vector<Spectrum> lamps{lamp("HP4"), lamp("A")};
    const Image sum = relight(both, lamps, {.group_scale = {1.0, 0.5}});
    const Image a = relight(key, lamps[0]), b = relight(fill, lamps[1]);
    for (std::size_t i = 0; i < sum.data.size(); ++i)
        EXPECT_NEAR(sum.data[i], a.data[i] + 0.5f * b.data[i], 2e-6f);
    // One lamp for all is that lamp for each.
    EXPECT_EQ(relight(both, lamps[0]).data,
              relight(both, std::vector<Spectrum>{lamps[0], lamps[0]}).data);
}

TEST(Relight, ThreadsDoNotChangeThePicture) {
    // Large enough for many parts; every row is compared with a picture of that row alone.
    const SpectralImage image = random_transport(257, 211, {.count = 16}, {"key"});
    const Image all = relight(image, lamp("HP3"));
    for (int y = 0; y < image.height; y += 7) {
        SpectralImage row = SpectralImage::make(image.width, 1, image.basis, {"key"});
        std::copy_n(image.pixel(0, 0, y), row.transport.size(), row.transport.begin());
        const Image one = relight(row, lamp("HP3"));
        EXPECT_TRUE(std::equal(one.data.begin(), one.data.end(), all.pixel(0, y))) << y;
    }
}

TEST(Relight, RefusesWrongCounts) {
    const SpectralImage image = random_transport(2, 2, {.count = 4}, {"a", "b", "c"});
    const std::vector<Spectrum> two(2, lamp("D65"));
    test::expect_problem([&] { relight(image, two); }, "lamps", "2 lamps for 3 light groups");
    test::expect_problem([&] { relight(image, lamp("D65"), {.group_scale = {1}}); }, "group_scale",
                         "1 scale for 3");
    test::expect_problem(
        [&] {
            relight(image, lamp("D65"), {.group_scale = {1, -2, 1}});
        },
        "group_scale.b", "expected 0 or more");
    test::expect_problem([&] { relight(image, Spectrum::constant(0)); }, "lamp",
                         "no visible power");
}

} // namespace
} // namespace tsuya
