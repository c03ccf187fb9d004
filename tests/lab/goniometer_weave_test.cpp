// What [Takeda] finds of satin and plain weave, and what holds for every weave.

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>

#include "lab/filament_samples.h"
#include "tsuya/lab/goniometer.h"
#include "tsuya/lab/weave_geometry.h"

namespace tsuya::lab {
namespace {

using std::numbers::pi;

/// The satin with filaments that are black, or let some light out again.
FilamentRepeat satin(double transmission = 0) {
    FilamentRepeat repeat = build_filaments(weave("black polyester satin"));
    for (FilamentOptics &optics : repeat.optics)
        optics.transmission = transmission;
    return repeat;
}

DirectionPair swapped(const DirectionPair &p) { return {p.theta_r, p.phi_r, p.theta_i, p.phi_i}; }

/// The same pairs of directions measured there and back.
struct ThereAndBack {
    ReflectanceTable there, back;

    explicit ThereAndBack(double transmission) {
        constexpr int kPairs = 30;
        std::mt19937 generator(11);
        std::uniform_real_distribution<double> unit;
        const auto theta = [&] { return std::acos(1 - 0.9 * unit(generator)); };
        Directions forth, reverse;
        for (int i = 0; i < kPairs; ++i) {
            forth.pairs.push_back(
                {theta(), 2 * pi * unit(generator), theta(), 2 * pi * unit(generator)});
            reverse.pairs.push_back(swapped(forth.pairs.back()));
        }
        GoniometerSettings settings{.photons = 1 << 18};
        const FilamentRepeat repeat = satin(transmission);
        there = measure(repeat, forth, settings).table;
        settings.seed = 2;
        back = measure(repeat, reverse, settings).table;
    }

    /// Largest |z| of the differences, with the values of the way back times `factor`.
    double largest_z(double factor) const {
        double largest = 0;
        for (std::size_t i = 0; i < there.rows.size(); ++i) {
            const ReflectanceRow &a = there.rows[i], &b = back.rows[i];
            const double sigma = std::hypot(a.sigma_per_sr, factor * b.sigma_per_sr);
            if (sigma > 0)
                largest =
                    std::max(largest, std::abs(a.brdf_per_sr - factor * b.brdf_per_sr) / sigma);
        }
        return largest;
    }
};

TEST(Satin, IsReciprocal) {
    for (const double transmission : {0.0, 0.6}) {
        const ThereAndBack pairs(transmission);
        EXPECT_LT(pairs.largest_z(1), sidak_bound(30)) << transmission;
        EXPECT_GT(pairs.largest_z(1.3), sidak_bound(30)) << "control";
    }
}

/// Moments of the reflected energy about the plane of incidence.
struct Spread {
    double energy = 0, reported = 0; ///< shares of the light that arrives
    double across = 0;               ///< mean component of the view across the plane
    double across_rms = 0;           ///< its root mean square
};

Spread spread(const FilamentRepeat &repeat, double theta_i_deg, double phi_i_deg) {
    const ViewGrid grid(theta_i_deg, phi_i_deg, 5);
    const Measurement m = measure(repeat, {.pairs = grid.pairs}, {.photons = 1 << 18, .seed = 3});
    Spread s;
    s.reported = m.lights[0].reflected;
    for (std::size_t i = 0; i < grid.pairs.size(); ++i) {
        const ReflectanceRow &row = m.table.rows[i];
        const double weight = row.brdf_per_sr * std::cos(row.theta_r) * grid.solid_angle[i];
        const double across = std::sin(row.theta_r) * std::sin(row.phi_r - row.phi_i);
        s.energy += weight;
        s.across += weight * across;
        s.across_rms += weight * across * across;
    }
    s.across /= s.energy;
    s.across_rms = std::sqrt(s.across_rms / s.energy);
    return s;
}

/// The cloth seen from its back, where the weft floats: a control for what its face shows.
FilamentRepeat turned_over(FilamentRepeat repeat) {
    for (Filament &f : repeat.filaments)
        for (glm::vec3 &p : f.point)
            p = {-p.x, p.y, -p.z};
    for (Filament &f : repeat.filaments)
        if (f.system == 1)
            std::reverse(f.point.begin(), f.point.end());
    return repeat;
}

/// Bounds of Spread::across: less where the cloth is symmetric, more where it is lopsided.
constexpr double kEven = 0.02, kLopsided = 0.06;

/// Reflectance for light at 60 degrees in the warp plane over that at 15 degrees.
double rise(const FilamentRepeat &repeat) {
    return spread(repeat, 60, 90).reported / spread(repeat, 15, 90).reported;
}
constexpr double kRise = 1.5;

TEST(Satin, ReflectsAsThePaperFinds) {
    const FilamentRepeat repeat = satin();
    double last = 0;
    for (const double theta : {15.0, 30.0, 45.0, 60.0}) {
        const Spread weft = spread(repeat, theta, 0), bias = spread(repeat, theta, 45);
        const Spread warp = spread(repeat, theta, 90);
        // Lit along the weft, across the warp's floats, the light stays in the plane of incidence
        EXPECT_LT(weft.across_rms, 0.8 * warp.across_rms) << theta;
        EXPECT_NEAR(weft.across, 0, kEven) << theta;
        // On the bias it is lopsided, along the warp symmetric
        EXPECT_LT(bias.across, -kLopsided) << theta;
        EXPECT_NEAR(warp.across, 0, kEven) << theta;
        // The reflectance rises with theta_i
        EXPECT_GT(warp.energy, last) << theta;
        last = warp.energy;
        // What the views see is what leaves
        for (const Spread &s : {weft, bias, warp})
            EXPECT_NEAR(s.energy / s.reported, 1, 0.03) << theta;
    }
    EXPECT_GT(rise(repeat), kRise);
}

TEST(Satin, FindingsOfThePaperFailElsewhere) {
    // On the back the weft floats: along and across change places
    const FilamentRepeat back = turned_over(satin());
    const Spread weft = spread(back, 45, 0), bias = spread(back, 45, 45);
    const Spread warp = spread(back, 45, 90);
    EXPECT_GT(weft.across_rms, 0.8 * warp.across_rms);
    EXPECT_GT(bias.across, kLopsided);
    // Out of the planes of the yarns nothing is symmetric
    EXPECT_GT(std::abs(spread(satin(), 45, 75).across), kEven);
    // Where most light comes out of the filaments again the reflectance hardly rises
    EXPECT_LT(rise(satin(0.9)), kRise);
}

/// Degrees from the mirror direction to the peak of brdf x cos theta_r in the warp plane, away from
/// the normal: the top of a parabola through the logarithms about the largest value.
double peak_offset_deg(const FilamentRepeat &repeat, double theta_i_deg) {
    constexpr int kReach = 16, kAbout = 4; // degrees
    Directions directions;
    for (int offset = -kReach; offset <= kReach; ++offset) {
        const double theta = theta_i_deg + offset;
        if (theta < 89)
            directions.pairs.push_back({theta_i_deg * kDegree, 90 * kDegree,
                                        std::abs(theta) * kDegree,
                                        (theta >= 0 ? 270 : 90) * kDegree});
    }
    const Measurement m = measure(repeat, directions, {.photons = 1 << 20});
    std::vector<double> value;
    for (const ReflectanceRow &row : m.table.rows)
        value.push_back(row.brdf_per_sr * std::cos(row.theta_r));
    const int count = static_cast<int>(value.size());
    const int top = static_cast<int>(std::max_element(value.begin(), value.end()) - value.begin());
    const int middle = std::clamp(top, kAbout, count - 1 - kAbout);
    // Least squares on evenly spaced places: the odd and the even part decouple
    double odd = 0, even = 0, squares = 0, fourths = 0, sum = 0;
    for (int k = -kAbout; k <= kAbout; ++k) {
        const double y = std::log(value[static_cast<std::size_t>(middle + k)]);
        odd += k * y;
        even += k * k * y;
        sum += y;
        squares += k * k;
        fourths += k * k * k * k;
    }
    const double n = 2 * kAbout + 1;
    const double slope = odd / squares;
    const double bend = (even - squares * sum / n) / (fourths - squares * squares / n);
    return bend < 0 ? middle - kReach - slope / (2 * bend) : top - kReach;
}

TEST(Satin, HasItsLobeAtTheMirrorDirectionUpTo45Degrees) {
    for (const double theta : {0.0, 15.0, 30.0, 45.0})
        EXPECT_NEAR(peak_offset_deg(satin(), theta), 0, 2) << theta;
    for (const double theta : {60.0, 70.0, 75.0})
        std::cout << "off-specular shift at " << theta
                  << " degrees: " << peak_offset_deg(satin(), theta) << " degrees\n";
    // Control: with all yarns pulled alike the floats bulge, and with rough filaments the lobe of
    // the flat ones does not stand out of theirs
    Weave slack = weave("black polyester satin");
    slack.weft.tension = slack.warp.tension;
    slack.warp.surface_roughness = slack.weft.surface_roughness = 0.12;
    EXPECT_GT(std::abs(peak_offset_deg(build_filaments(slack), 45)), 2);
}

TEST(PlainWeave, IsSymmetricAlongBothYarns) {
    const FilamentRepeat repeat = build_filaments(weave("polyester taffeta"));
    for (const double theta : {30.0, 60.0}) {
        EXPECT_NEAR(spread(repeat, theta, 0).across, 0, kEven) << theta;
        EXPECT_NEAR(spread(repeat, theta, 90).across, 0, kEven) << theta;
    }
    // Control: a satin on the bias is not
    EXPECT_GT(std::abs(spread(satin(), 45, 45).across), 1.5 * kEven);
}

/// Reflected energy of the light at 60 degrees in the warp plane.
LightReport reflected(const FilamentRepeat &repeat, const GoniometerSettings &settings) {
    return measure(repeat, {.pairs = {{60 * kDegree, pi / 2, 0.5, 0}}}, settings).lights[0];
}

TEST(Satin, ConvergesWithBouncesAndTessellation) {
    const FilamentRepeat repeat = satin(0.6);
    GoniometerSettings settings{.photons = 1 << 17};
    const LightReport all = reflected(repeat, settings);
    double last = 1;
    for (const int bounces : {1, 4, 16}) {
        settings.max_bounces = bounces;
        const double missing = all.reflected - reflected(repeat, settings).reflected;
        EXPECT_LT(missing, last) << bounces;
        last = missing;
    }
    EXPECT_LT(std::abs(last), 4 * all.reflected_sigma);
    settings.max_bounces = 0;
    const auto z = [&](const LightReport &other) {
        return std::abs(other.reflected - all.reflected) /
               std::hypot(other.reflected_sigma, all.reflected_sigma);
    };
    settings.turn_per_segment = 0.005;
    EXPECT_LT(z(reflected(repeat, settings)), 4);
    settings.turn_per_segment = 0.02;
    settings.energy_bound = 0.02; // the roulette takes nothing away
    EXPECT_LT(z(reflected(repeat, settings)), 4);
    settings.energy_bound = 0.5;
    settings.max_bounces = 1; // control
    EXPECT_GT(z(reflected(repeat, settings)), 4);
}

} // namespace
} // namespace tsuya::lab
