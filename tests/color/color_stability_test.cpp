// Random lamps and reflectances, and those at the ends of their ranges.

#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/adaptation.h"
#include "tsuya/color/color_rendering.h"
#include "tsuya/color/config.h"
#include "tsuya/color/difference.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/relight.h"
#include "tsuya/color/srgb.h"

namespace tsuya {
namespace {

/// How many times the usual number of samples: a million where TSUYA_TEST_EFFORT says 100.
int effort() {
    const char *text = std::getenv("TSUYA_TEST_EFFORT");
    return text ? std::max(1, std::atoi(text)) : 1;
}

constexpr int kSamples = 10'000;

/// Anything from a line of a hundredth of a nanometre to white noise, of any unit.
class RandomSpectra {
  public:
    explicit RandomSpectra(unsigned seed) : random_(seed) {}

    Spectrum lamp() {
        const double unit = std::pow(10, uniform(-300, 300));
        Spectrum s = uniform(0, 1) < 0.3 ? lines() : noise(2 + static_cast<int>(uniform(0, 60)));
        for (double &value : s.value)
            value *= unit;
        return s;
    }

    /// 0..1; some samples are exactly 0 or 1.
    Spectrum reflectance() { return noise(1 + static_cast<int>(uniform(0, 40))); }

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }

  private:
    Spectrum noise(int count) {
        Spectrum s{{}, {}};
        double nm = uniform(300, 420);
        for (int i = 0; i < count; ++i) {
            nm += uniform(0.01, 20);
            const double kind = uniform(0, 1);
            s.wavelength_nm.push_back(nm);
            s.value.push_back(kind < 0.1 ? 0 : kind > 0.9 ? 1 : uniform(0, 1));
        }
        return s;
    }

    Spectrum lines() {
        Spectrum s{{}, {}};
        double nm = 380;
        for (int i = 1 + static_cast<int>(uniform(0, 6)); i-- > 0;) {
            const double width = std::pow(10, uniform(-2, 1));
            nm += uniform(2 * width, 80);
            for (const double side : {-1.0, 0.0, 1.0}) {
                s.wavelength_nm.push_back(nm + side * width);
                s.value.push_back(side == 0 ? uniform(0.01, 1) : 0);
            }
            nm += width;
        }
        return s;
    }

    std::mt19937_64 random_;
};

bool finite(const glm::dvec3 &v) { return std::isfinite(v.x + v.y + v.z); }

TEST(ColorStability, ColoursAreFiniteAndWithinTheirWhite) {
    RandomSpectra random(1);
    int dark = 0;
    for (int i = 0; i < kSamples * effort(); ++i) {
        const Spectrum lit = random.lamp(), cloth = random.reflectance();
        glm::dvec3 white(0.0);
        try {
            white = white_of(lit);
        } catch (const Error &) {
            ++dark; // all its samples are 0 where the eye sees
            continue;
        }
        const glm::dvec3 xyz = xyz_of(lit, cloth);
        ASSERT_TRUE(finite(white) && finite(xyz)) << i;
        ASSERT_NEAR(white.y, 1, 1e-12) << i;
        glm::dvec3 most(0.0); // a white with the nodes of the cloth
        for (const ColorWeight &weight : color_weights(lit, Observer::cie1931, cloth.wavelength_nm))
            most += weight.xyz;
        for (int c = 0; c < 3; ++c) {
            ASSERT_GE(xyz[c], 0) << i; // no negative energy at all
            ASSERT_LE(xyz[c], most[c] * (1 + 1e-12)) << i;
        }
    }
    EXPECT_LT(dark, kSamples * effort() / 20);
}

TEST(ColorStability, GreysAreNeutralUnderEveryLampAdapted) {
    RandomSpectra random(2);
    int seen = 0;
    for (int i = 0; i < kSamples * effort() / 10; ++i) {
        const Spectrum lit = random.lamp();
        const double grey = i % 10 == 0 ? 1 : i % 10 == 1 ? 0 : random.uniform(0, 1);
        const SpectralBasis basis{.count =
                                      i % 3 == 0 ? 1 : 16}; // of one channel: a monochrome scene
        for (const Adaptation adapt : {Adaptation::bradford, Adaptation::cat02}) {
            glm::dvec3 white(0.0), xyz(0.0);
            try {
                white = white_of(lit);
            } catch (const Error &) {
                break;
            }
            if (!can_adapt(adapt, white))
                continue;
            ++seen;
            for (const glm::dvec3 &part : lamp_matrix(lit, basis)) {
                ASSERT_GE(std::min({part.x, part.y, part.z}), 0) << i;
                xyz += grey * part;
            }
            const glm::dvec3 to = srgb_white(), shown = adaptation_matrix(adapt, white, to) * xyz;
            ASSERT_TRUE(finite(shown)) << i;
            const glm::dvec3 lab = lab_of(shown, to);
            ASSERT_LT(ciede2000(lab, {lab.x, 0, 0}), 0.01) << i << " " << lab.y << " " << lab.z;
            ASSERT_NEAR(lab.x, lab_of(grey * to, to).x, 1e-6) << i;
        }
    }
    EXPECT_GT(seen, kSamples * effort() / 20);
}

TEST(ColorStability, FiguresOfLampsAreFinite) {
    RandomSpectra random(3);
    for (int i = 0; i < 300 * effort() / 10 + 20; ++i) {
        Spectrum lit = random.lamp();
        // Near a black body, so that most have a colour temperature
        const Spectrum body = black_body(std::pow(10, random.uniform(3.1, 4.4)));
        double peak = 0;
        for (const double value : lit.value)
            peak = std::max(peak, value);
        Spectrum mixed{body.wavelength_nm, {}};
        for (std::size_t k = 0; k < body.value.size(); ++k)
            mixed.value.push_back(body.value[k] +
                                  100 * (peak > 0 ? lit.at(body.wavelength_nm[k]) / peak : 0));
        const LampFigures f = lamp_figures(mixed);
        ASSERT_TRUE(std::isfinite(f.xy.x + f.xy.y));
        if (!f.temperature)
            continue;
        ASSERT_TRUE(std::isfinite(f.temperature->kelvin + f.temperature->duv)) << i;
        ASSERT_TRUE(std::isfinite(*f.ra + *f.rf + *f.rg)) << i;
        ASSERT_LE(*f.ra, 100.001) << i;
        ASSERT_GE(*f.rf, 0) << i;
        ASSERT_LE(*f.rf, 100.001) << i;
    }
}

TEST(ColorStability, PicturesOfAnyLampStayInTheirRange) {
    RandomSpectra random(4);
    for (int i = 0; i < 40; ++i) {
        const Spectrum lit = random.lamp();
        SpectralImage image = SpectralImage::make(4, 2, {.count = i % 2 == 0 ? 1 : 16}, {"key"});
        for (float &t : image.transport)
            t = static_cast<float>(random.uniform(0, 1) < 0.2 ? 0 : random.uniform(0, 2));
        glm::dvec3 white(0.0);
        try {
            white = white_of(lit);
        } catch (const Error &) {
            continue;
        }
        const Image xyz = relight(image, lit);
        for (const float value : xyz.data)
            ASSERT_TRUE(std::isfinite(value) && value >= 0) << i;
        const Image rgb = display(xyz, white, {.view = "Soft"});
        for (const float value : rgb.data)
            ASSERT_TRUE(value >= 0 && value <= 1) << i;
    }
}

TEST(ColorStability, DyesAtTheEndsOfTheirRange) {
    const Spectrum black = Spectrum::constant(0), white = Spectrum::constant(1);
    const Spectrum pale{{400, 550, 700}, {0.99, 1, 0.985}};
    for (const char *name : {"D65", "A", "HP1", "LED-RGB1"}) {
        const Spectrum lit = lamp(name);
        EXPECT_EQ(xyz_of(lit, black), glm::dvec3(0.0)) << name;
        EXPECT_EQ(xyz_of(lit, white), white_of(lit)) << name;
        EXPECT_GT(lab_of(xyz_of(lit, pale), white_of(lit)).x, 99.5) << name;
    }
    for (const Spectrum &end : {black, white, pale}) {
        const std::vector<DyeShare> bath{{end, 3}, {dye("crimson"), 0.5}};
        EXPECT_NO_THROW(check_spectrum(mix_dyes(bath), 0, 1, "mixture"));
        EXPECT_NO_THROW(check_spectrum(on_cloth(end), 0, 1, "cloth"));
    }
}

} // namespace
} // namespace tsuya
