// From a cloth through pictures that the renderer makes of it, once for each direction, back to the
// cloth: what geometry and transport do to a value, without noise.

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "lab/rendered_patch.h"
#include "lab/virtual_session.h"
#include "samples/scratch.h"
#include "tsuya/lab/measure_session.h"
#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/model.h"

namespace tsuya::lab {
namespace {

using scene::Scratch;

struct RenderedLoop : testing::Test {
    const Fabric satin = with_model(read_fabric(TSUYA_FABRICS "/black_satin.fabric.toml"), "takeda",
                                    "black_satin.fabric.toml");
    const Scratch folder{};

    /// Views under one light, measured through rendered pictures.
    SessionMeasurement measured(const Directions &directions, double lamp_angle) const {
        const auto patch = std::make_shared<test::RenderedPatch>();
        patch->cloth = satin;
        patch->lamp_angle = lamp_angle;
        test::VirtualSession made{.directions = directions};
        made.scene.drift = made.scene.flicker = made.scene.stray = 0;
        // A picture serves all exposures of its view.
        made.scene.picture = [patch, last = std::pair(SIZE_MAX, Image())](
                                 const PlannedFrame &frame, int width, int height) mutable {
            if (last.first != frame.view)
                last = {frame.view, patch->render(frame, width, height)};
            return last.second;
        };
        made.camera.dark_e_per_s = 0;
        made.camera_lines = "exposures_s = [0.1, 1, 10]\n";
        made.dark_frames = 1;
        made.white_every = 1000;
        made.e_per_dn = 1e3;
        made.read_noise_e = 0;
        return measure_session(make_virtual_session(folder / std::to_string(lamp_angle), made));
    }

    /// Of the table against what the cloth is.
    double l2_cos(const SessionMeasurement &measurement) const {
        return *measure_accuracy(measurement.channels[0].table,
                                 make_model("takeda", satin, "black_satin"))
                    .mean.l2_cos;
    }
};

Directions views_under(double theta_i, double step_deg) {
    Directions views = normal_incidence(step_deg, Symmetry::none);
    for (DirectionPair &pair : views.pairs)
        pair.theta_i = theta_i;
    return views;
}

constexpr double kPoint = 0.05 * kDegree; // of a lamp that blurs nothing

TEST_F(RenderedLoop, FindsTheSatinAgainInFewViews) {
    const Directions views = normal_incidence(30, Symmetry::half_turn);
    const SessionMeasurement few = measured(views, kPoint);
    EXPECT_EQ(few.channels[0].views.size(), views.pairs.size());
    std::printf("l2_cos %.4f\n", l2_cos(few));
    EXPECT_LE(l2_cos(few), 0.006);
    Directions turned = views; // the negative control: the cloth lies 10 degrees askew
    for (DirectionPair &pair : turned.pairs)
        pair.phi_r += 10 * kDegree;
    SessionMeasurement askew = measured(turned, kPoint);
    for (ReflectanceRow &row : askew.channels[0].table.rows)
        row.phi_r -= 10 * kDegree;
    EXPECT_GT(l2_cos(askew), 0.1);
}

TEST_F(RenderedLoop, FindsTheSatinAgainUnderLightFromAbove) {
    const double error = l2_cos(measured(normal_incidence(10, Symmetry::half_turn), kPoint));
    std::printf("l2_cos %.4f\n", error);
    EXPECT_LE(error, 0.006);
}

TEST_F(RenderedLoop, FindsTheSatinAgainUnderObliqueLight) {
    const double error = l2_cos(measured(views_under(45 * kDegree, 15), kPoint));
    std::printf("l2_cos at 45 degrees %.4f\n", error);
    EXPECT_LE(error, 0.012);
}

TEST_F(RenderedLoop, AUsualLampBlursLittleAndAWideOneMuch) {
    const Directions views = normal_incidence(15, Symmetry::half_turn);
    const double usual = l2_cos(measured(views, 1.1 * kDegree));
    const double wide = l2_cos(measured(views, 9.5 * kDegree));
    std::printf("lamp of 1.1 degrees: %.4f, of 9.5: %.4f\n", usual, wide);
    EXPECT_LE(usual, 0.005);
    EXPECT_GT(wide, 0.05) << "the negative control";
}

} // namespace
} // namespace tsuya::lab
