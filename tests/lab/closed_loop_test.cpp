// From a cloth whose reflectance is known through pictures with noise and faults back to the cloth.

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "lab/virtual_session.h"
#include "samples/scratch.h"
#include "tsuya/lab/measure_session.h"
#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/model.h"
#include "tsuya/sdk/reflectance_file.h"

namespace tsuya::lab {
namespace {

using scene::Scratch, test::VirtualSession;

const ReflectanceTable &satin() {
    static const ReflectanceTable table =
        read_reflectance_table(TSUYA_FABRICS "/black_satin.csv").normal_incidence();
    return table;
}

VirtualSession satin_session(std::uint32_t seed) {
    VirtualSession session{.directions = directions_of(satin())};
    session.scene.cloth = test::looked_up(satin());
    session.camera.seed = seed;
    session.glint_view = 100;
    session.missing_views = {200};
    return session;
}

/// What a fabric of a fitted surface is worth against the truth.
ErrorMeasures error_of(const Bard &bard) {
    const Fabric fabric{.name = "measured",
                        .specular = CarriedViews{.bard = bard, .model = ViewModel::takeda}};
    return measure_accuracy(satin(), make_model("takeda", fabric, "measured")).mean;
}

ErrorMeasures fitted(const ReflectanceTable &table) {
    return error_of(Bard::fit(table, "measured"));
}

std::string text_of(const ErrorMeasures &error) {
    char text[100];
    std::snprintf(text, sizeof text, "l2_cos %.4f albedo_ratio %.4f log_p95 %.4f", *error.l2_cos,
                  *error.albedo_ratio, *error.log_p95);
    return text;
}

bool passes(const ErrorMeasures &error) {
    return *error.l2_cos <= 0.010 && std::abs(*error.albedo_ratio - 1) <= 0.004 &&
           *error.log_p95 <= 0.020;
}

std::string named(const SessionMeasurement &measured) {
    std::string text;
    for (const LeftOutView &view : measured.left_out)
        text += std::to_string(view.view) + " " + name_of(view.reason) + ": " + view.detail + "\n";
    return text;
}

class ClosedLoop : public testing::TestWithParam<std::uint32_t> {};

TEST_P(ClosedLoop, FindsTheSatinAgainAndNotWithACorrectionOff) {
    const Scratch folder;
    const VirtualSession made = satin_session(GetParam());
    const Session session = make_virtual_session(folder / "s", made);
    const MeasureSettings settings{.repeat_mm = made.scene.repeat_mm};
    const SessionMeasurement measured = measure_session(session, settings);
    ASSERT_EQ(measured.left_out.size(), 2u) << named(measured);
    EXPECT_EQ(measured.left_out[0].reason, LeftOutReason::saturated);
    EXPECT_EQ(measured.left_out[0].view, test::plan_view(session.plan, 100));
    EXPECT_EQ(measured.left_out[1].reason, LeftOutReason::missing);
    EXPECT_EQ(measured.left_out[1].view, test::plan_view(session.plan, 200));

    const Bard bard = Bard::fit(measured.channels[0].table, "measured");
    const ErrorMeasures error = error_of(bard);
    std::printf("seed %u: %s\n", GetParam(), text_of(error).c_str());
    EXPECT_TRUE(passes(error)) << text_of(error);
    // The fit depends on the errors that the table tells and on the smoothness that it finds: two
    // supports of its kernel leave nearly the same residuals, 0.007 of log_p95 lie between them,
    // and noise decides. What the exact truth with the same errors and smoothness gives is not the
    // measuring's fault.
    ReflectanceTable exact = measured.channels[0].table;
    for (ReflectanceRow &row : exact.rows)
        row.brdf_per_sr = made.scene.cloth({row.theta_i, row.phi_i, row.theta_r, row.phi_r});
    const ErrorMeasures of_exact = error_of(Bard::fit(exact, bard.smoothness(), "exact"));
    std::printf("seed %u exact truth: %s, of another smoothness: %s\n", GetParam(),
                text_of(of_exact).c_str(), text_of(fitted(exact)).c_str());
    EXPECT_LT(*error.log_p95, *of_exact.log_p95 + 0.005);
    for (const auto &[name, corrections] :
         {std::pair<const char *, Corrections>{"drift", {.drift = false}},
          {"trap", {.trap = false}},
          {"black", {.black = false}}}) {
        const SessionMeasurement without = measure_session(
            session, {.repeat_mm = made.scene.repeat_mm, .corrections = corrections});
        const ErrorMeasures worse = fitted(without.channels[0].table);
        std::printf("seed %u without %s: %s\n", GetParam(), name, text_of(worse).c_str());
        EXPECT_FALSE(passes(worse)) << "the negative control: " << name;
    }
}

/// Share of the views that lie within twice their sigma of the truth.
double within_two_sigma(const ChannelMeasurement &channel, const VirtualScene &scene) {
    double count = 0;
    for (const MeasuredView &view : channel.views)
        if (std::abs(view.brdf_per_sr - scene.cloth(view.directions)) <= 2 * view.sigma_per_sr())
            ++count;
    return count / static_cast<double>(channel.views.size());
}

// A texture without a period: the mean over a patch depends on the place, and sigma has to say so.
TEST_P(ClosedLoop, SigmaHoldsTheTextureOfIndependentPixels) {
    const Scratch folder;
    VirtualSession made = satin_session(GetParam());
    made.scene.repeat_mm = {0, 0};
    const SessionMeasurement measured = measure_session(make_virtual_session(folder / "s", made));
    ASSERT_EQ(measured.left_out.size(), 2u) << named(measured);
    ChannelMeasurement channel = measured.channels[0];
    const double share = within_two_sigma(channel, made.scene);
    std::printf("seed %u: %.3f within two sigma\n", GetParam(), share);
    EXPECT_GE(share, 0.90);
    EXPECT_LE(share, 0.98);
    for (MeasuredView &view : channel.views)
        view.texture = 0;
    EXPECT_LT(within_two_sigma(channel, made.scene), 0.75) << "the negative control";
}

/// Facets of a smooth dielectric: 5 /sr at the top, and 20000 times less far from it.
double glossy(const DirectionPair &at) {
    constexpr double kAlpha2 = 0.05 / (4 * kPi * 5);
    const glm::dvec3 half = glm::normalize(at.to_light() + at.to_viewer());
    const double slope2 = (1 - half.z * half.z) / (half.z * half.z);
    const double top = std::pow(kAlpha2 / (kAlpha2 + slope2), 2);
    return 5 * top + 2.5e-4;
}

/// Largest errors of a table of `glossy`.
struct Misses {
    double bright = 0; ///< relative, of views above 0.01 /sr
    double sigmas = 0;
};

Misses misses_of(const SessionMeasurement &measured) {
    Misses misses;
    for (const MeasuredView &view : measured.channels[0].views) {
        const double off = std::abs(view.brdf_per_sr - glossy(view.directions));
        misses.sigmas = std::max(misses.sigmas, off / view.sigma_per_sr());
        if (view.brdf_per_sr > 0.01)
            misses.bright = std::max(misses.bright, off / glossy(view.directions));
    }
    return misses;
}

TEST_P(ClosedLoop, BracketsHoldANarrowLobeUnderAnyLight) {
    const Scratch folder;
    VirtualSession made;
    for (const double theta_i : {0.0, 45.0, 75.0})
        for (const double theta_r :
             {0.0, 5.0, 10.0, 20.0, 30.0, 40.0, 45.0, 50.0, 60.0, 70.0, 75.0, 80.0})
            for (const double phi_r : {0.0, 90.0, 170.0, 180.0})
                if (theta_r > 0 || phi_r == 0)
                    made.directions.pairs.push_back(
                        {theta_i * kDegree, 0, theta_r * kDegree, phi_r * kDegree});
    made.directions.symmetry = Symmetry::none;
    made.scene.cloth = glossy;
    made.white_every = 8;
    made.camera_lines = "exposures_s = [0.003, 0.03, 0.3, 3, 10]\n";
    made.camera.seed = GetParam();
    made.camera.black_shift = 20; // the sensor is warmer than when the rig file was written
    const Session session = make_virtual_session(folder / "s", made);
    const MeasureSettings settings{.repeat_mm = made.scene.repeat_mm};
    const SessionMeasurement measured = measure_session(session, settings);
    EXPECT_EQ(measured.left_out.size(), 0u) << named(measured);
    const Misses misses = misses_of(measured);
    std::printf("seed %u: worst bright view %.4f, worst of all %.1f sigma\n", GetParam(),
                misses.bright, misses.sigmas);
    EXPECT_LT(misses.bright, 0.03);
    EXPECT_LT(misses.sigmas, 4.5);
    EXPECT_GT(within_two_sigma(measured.channels[0], made.scene), 0.90);
    // What the sensor adds to each frame weighs most in the shortest ones. In views that use the
    // trap's exposures the trap takes it off, so that the dark frames are not missed there.
    const Misses no_dark = misses_of(measure_session(
        session, {.repeat_mm = made.scene.repeat_mm, .corrections = {.dark = false}}));
    std::printf("seed %u without dark: worst bright view %.4f, worst of all %.1f sigma\n",
                GetParam(), no_dark.bright, no_dark.sigmas);
    EXPECT_GT(no_dark.sigmas, 4.5) << "the negative control";
    // One exposure cannot hold the range.
    Session single = session;
    std::erase_if(single.frames, [](const CountedFrame &frame) {
        return frame.planned.kind == FrameKind::cloth && frame.planned.exposure_s < 10;
    });
    EXPECT_GT(measure_session(single, settings).left_out.size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ClosedLoop, testing::Values(1u, 2u, 3u, 4u, 5u, 6u));

} // namespace
} // namespace tsuya::lab
