// The denoiser: on films of known noise, and in renders.

#include <cmath>
#include <filesystem>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "denoise.h"
#include "sdk/render_scenes.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

constexpr int kWidth = 80, kHeight = 48;
const Camera kCamera{.vertical_angle = 0.1, .height = 100};
constexpr std::size_t kNormalX = 0, kObject = 10; // of Film::features

using OfPixel = std::function<double(int x, int y)>;

// A film of two samples per pixel, as a render would leave it: groups of different strength and
// colour, on a flat object.
struct TestFilm {
    Scene scene = folded_satin(kWidth, kHeight);
    RenderSettings settings{.stop = {.samples_per_pixel = 2}, .channels = 8, .denoise = true};
    Film film;

    explicit TestFilm(int groups = 2) : film(with_groups(scene, groups), settings) {
        std::fill(film.done.begin(), film.done.end(), 2);
        for (std::size_t p = 0; p < std::size_t(kWidth * kHeight); ++p) {
            film.features[p * kFeatures + 2] = 2; // the normal's z, of two samples
            film.features[p * kFeatures + kObject] = 2;
        }
    }
    static float share(std::size_t group, int k) {
        return (group == 0 ? 1.0f : 0.3f) * (1 + 0.1f * float(k) * (group == 0 ? 1.0f : -0.5f));
    }
    // Adds to the samples of one half, in the shares of the groups.
    void add(int x, int y, bool odd, double value) {
        for (std::size_t g = 0; g < film.groups; ++g)
            for (int k = 0; k < film.channels; ++k) {
                const std::size_t at =
                    (film.at(x, y) * film.groups + g) * std::size_t(film.channels) + std::size_t(k);
                film.sum[at] += float(value) * share(g, k);
                if (odd)
                    film.odd_sum[at] += float(value) * share(g, k);
            }
    }
    void fill(const OfPixel &exact, const std::function<double()> &noise) {
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                for (const bool odd : {false, true})
                    add(x, y, odd, exact(x, y) + noise());
    }
    float &feature(std::size_t which, int x, int y) {
        return film.features[film.at(x, y) * kFeatures + which];
    }
    SpectralImage developed() const { return film.develop(scene, settings); }
    SpectralImage denoised() const {
        SpectralImage image = developed();
        EXPECT_TRUE(denoise(film, kCamera, image, {}));
        return image;
    }

  private:
    static const Scene &with_groups(Scene &scene, int groups) {
        if (groups == 1) {
            scene.light_groups = {"all"};
            std::get<RectangleLight>(scene.lights[0]).group = {0};
            scene.environment->group = {0};
        }
        return scene;
    }
};

// Normal noise of a deviation.
std::function<double()> noise(double deviation) {
    return [deviation, random = std::mt19937(7)]() mutable {
        return std::normal_distribution(0.0, deviation)(random);
    };
}
// Skewed noise of mean 0: many values a little low, few far above.
std::function<double()> skewed_noise(double deviation) {
    return [deviation, random = std::mt19937(7)]() mutable {
        return deviation * (std::exponential_distribution(1.0)(random) - 1);
    };
}

double value(const SpectralImage &image, int x, int y) {
    return *image.pixel(0, x, y); // the share of the first channel is 1
}
double rms(const SpectralImage &image, const OfPixel &exact) {
    double sum = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            sum += std::pow(value(image, x, y) - exact(x, y), 2);
    return std::sqrt(sum / (kWidth * kHeight));
}
double mean(const SpectralImage &image) {
    double sum = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            sum += value(image, x, y);
    return sum / (kWidth * kHeight);
}

const OfPixel half = [](int, int) { return 0.5; };

TEST(Denoise, ConstantStaysConstant) {
    TestFilm test;
    test.fill(half, [] { return 0.0; });
    const SpectralImage before = test.developed(), after = test.denoised();
    for (std::size_t i = 0; i < before.transport.size(); ++i)
        EXPECT_NEAR(after.transport[i], before.transport[i], 1e-5);
}

TEST(Denoise, NoiseGoesAndTheMeanStays) {
    TestFilm test;
    test.fill(half, noise(0.1));
    EXPECT_NEAR(rms(test.developed(), half), 0.1 / std::sqrt(2), 0.003);
    const SpectralImage after = test.denoised();
    EXPECT_LT(rms(after, half), 0.1 / std::sqrt(2) / 6);
    EXPECT_NEAR(mean(after), mean(test.developed()), 5e-4);
}

// Patches weighed by the noise that they average: what is low is like more pixels than what is
// high. [Rousselle2012]
SpectralImage denoised_by_own_noise(const SpectralImage &image, double variance) {
    SpectralImage result = image;
    const auto at = [&](int x, int y) {
        return value(image, std::clamp(x, 0, kWidth - 1), std::clamp(y, 0, kHeight - 1));
    };
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            double sum = 0, weights = 0;
            for (int i = -5; i <= 5; ++i)
                for (int j = -5; j <= 5; ++j) {
                    double distance = 0;
                    for (int u = -1; u <= 1; ++u)
                        for (int v = -1; v <= 1; ++v)
                            distance += (std::pow(at(x + u, y + v) - at(x + i + u, y + j + v), 2) -
                                         2 * variance) /
                                        (0.45 * 0.45 * 2 * variance) / 9;
                    const double w = std::exp(-std::max(0.0, distance));
                    sum += w * at(x + i, y + j);
                    weights += w;
                }
            *result.pixel(0, x, y) = float(sum / weights);
        }
    return result;
}

TEST(Denoise, SkewedNoiseKeepsTheMean) {
    TestFilm test;
    test.fill(half, skewed_noise(0.1));
    const SpectralImage before = test.developed();
    EXPECT_NEAR(mean(test.denoised()) / mean(before), 1, 0.004);
    // Negative control
    EXPECT_LT(mean(denoised_by_own_noise(before, 0.1 * 0.1 / 2)) / mean(before), 1 - 0.006);
}

// A step that noise hides stays sharp where a feature tells of it, and else does not.
TEST(Denoise, EdgesOfObjectsAndNormalsStaySharp) {
    constexpr double kStep = 0.03;
    const OfPixel step = [](int x, int) { return x < kWidth / 2 ? 0.5 : 0.5 + kStep; };
    const auto share_left = [&](std::size_t feature, float beyond) {
        TestFilm test;
        test.fill(step, noise(0.1));
        for (int y = 0; y < kHeight; ++y)
            for (int x = kWidth / 2; x < kWidth; ++x)
                test.feature(feature, x, y) += beyond;
        const SpectralImage image = test.denoised();
        double sum = 0;
        for (int y = 0; y < kHeight; ++y)
            for (int i = 0; i < 3; ++i)
                sum += value(image, kWidth / 2 + i, y) - value(image, kWidth / 2 - 1 - i, y);
        return sum / (3 * kHeight * kStep);
    };
    EXPECT_NEAR(share_left(kObject, 2), 1, 0.15);
    EXPECT_NEAR(share_left(kNormalX, 2), 1, 0.15);
    EXPECT_LT(share_left(kObject, 0), 0.6);
}

// What both halves have is no noise.
TEST(Denoise, PatternsOfAPrintStaySharp) {
    const OfPixel checks = [](int x, int y) { return (x / 3 + y / 3) % 2 == 0 ? 0.3 : 0.6; };
    TestFilm test;
    test.fill(checks, noise(0.03));
    EXPECT_LT(rms(test.denoised(), checks), 0.5 * rms(test.developed(), checks));
}

TEST(Denoise, SpecksOfOneHalfGo) {
    TestFilm test;
    test.fill(half, noise(0.02));
    test.add(30, 20, false, 20);
    test.add(60, 20, true, 20);
    test.add(45, 30, false, 2); // in both: it is there
    test.add(45, 30, true, 2);
    const SpectralImage after = test.denoised();
    EXPECT_GT(value(after, 45, 30), 2);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            if (x != 45 || y != 30) {
                EXPECT_NEAR(value(after, x, y), 0.5, 0.03) << x << " " << y;
            }
}

TEST(Denoise, GroupsHaveTheSameWeights) {
    TestFilm two(2), one(1);
    two.fill(half, noise(0.1));
    for (std::size_t p = 0; p < std::size_t(kWidth * kHeight); ++p)
        for (std::size_t k = 0; k < 8; ++k)
            for (std::vector<float> Film::*sums : {&Film::sum, &Film::odd_sum})
                (one.film.*sums)[p * 8 + k] =
                    (two.film.*sums)[p * 16 + k] + (two.film.*sums)[p * 16 + 8 + k];
    const SpectralImage apart = two.denoised(), together = one.denoised();
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int k = 0; k < 8; ++k)
                EXPECT_NEAR(apart.pixel(0, x, y)[k] + apart.pixel(1, x, y)[k],
                            together.pixel(0, x, y)[k], 1e-5);
}

TEST(Denoise, StopsAndTellsHowFarItIs) {
    TestFilm test;
    test.fill(half, noise(0.1));
    SpectralImage image = test.developed();
    std::atomic<bool> stop = true;
    EXPECT_FALSE(denoise(test.film, kCamera, image, {.stop = &stop}));
    double last = -1;
    EXPECT_TRUE(
        denoise(test.film, kCamera, image, {.report = [&](std::string_view stage, double done) {
                    EXPECT_EQ(stage, "denoise");
                    last = done;
                }}));
    EXPECT_GT(last, 0.5);
}

RenderSettings denoising(int samples) {
    RenderSettings settings = quick(samples);
    settings.denoise = true;
    return settings;
}

TEST(DenoisedRender, IsNearerTheTruthAndTellsWhatItChanged) {
    const Scene scene = folded_satin(40, 40);
    const SpectralImage exact = render(scene, quick(512)).image;
    RenderSettings settings = quick(16);
    settings.stop.relative_error = 1e-9; // the same samples
    const RenderResult plain = render(scene, settings);
    settings.denoise = true;
    const RenderResult result = render(scene, settings);
    const auto error = [&](const SpectralImage &image) {
        double sum = 0;
        for (std::size_t i = 0; i < exact.transport.size(); ++i)
            sum += std::pow(image.transport[i] - exact.transport[i], 2);
        return sum;
    };
    EXPECT_LT(error(result.image), 0.6 * error(plain.image));
    EXPECT_FALSE(plain.stats.denoise_change);
    EXPECT_EQ(plain.image.metadata.count("denoised"), 0u);
    ASSERT_TRUE(result.stats.denoise_change);
    EXPECT_LT(std::abs(*result.stats.denoise_change), 0.003);
    EXPECT_EQ(result.image.metadata.count("denoised"), 1u);
    EXPECT_EQ(result.stats.relative_error, plain.stats.relative_error);
}

TEST(DenoisedRender, IsTheSameForAnyThreadsAndAfterAStop) {
    const Scene scene = folded_satin(50, 40);
    RenderSettings settings = denoising(16);
    settings.threads = 1;
    const RenderResult whole = render(scene, settings);
    settings.threads = 3;
    EXPECT_EQ(render(scene, settings).image.transport, whole.image.transport);

    settings.checkpoint = std::filesystem::path(testing::TempDir()) /
                          ("tsuya-denoise-" + std::to_string(getpid()) + ".checkpoint");
    settings.resume = true;
    // Of the filter's reports only the first is sure to come before its end
    struct Place {
        std::string_view stage;
        double done;
    };
    for (const Place &place : {Place{"render", 0.4}, Place{"denoise", 0}}) {
        std::atomic<bool> stop = false;
        const RenderResult part =
            render(scene, settings,
                   {.report =
                        [&](std::string_view stage, double done) {
                            stop = stop || (stage == place.stage && done >= place.done);
                        },
                    .stop = &stop});
        EXPECT_TRUE(part.stats.interrupted) << place.stage;
        EXPECT_FALSE(part.stats.denoise_change) << place.stage;
        EXPECT_EQ(part.image.metadata.count("denoised"), 0u);
    }
    EXPECT_EQ(render(scene, settings).image.transport, whole.image.transport);
    std::filesystem::remove(settings.checkpoint);
}

TEST(DenoisedRender, OfACropKnowsOnlyTheCrop) {
    const Scene scene = folded_satin(64, 48);
    RenderSettings settings = denoising(16);
    settings.crop = {13, 5, 50, 44};
    const RenderResult result = render(scene, settings);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            const bool inside = x >= 13 && x < 50 && y >= 5 && y < 44;
            EXPECT_EQ(*result.image.pixel(1, x, y) > 0, inside) << x << " " << y;
            EXPECT_TRUE(std::isfinite(*result.image.pixel(0, x, y)));
        }
}

TEST(DenoisedRender, NeedsTwoSamples) {
    try {
        render(folded_satin(8, 8), denoising(1));
        FAIL();
    } catch (const Error &error) {
        EXPECT_EQ(error.problems().at(0).where, "spp");
    }
    EXPECT_TRUE(render(folded_satin(8, 8), denoising(2)).stats.denoise_change);
}

} // namespace
