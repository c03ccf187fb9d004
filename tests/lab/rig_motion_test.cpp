#include "tsuya/lab/rig_motion.h"

#include <gtest/gtest.h>

namespace tsuya::lab {
namespace {

DirectionPair pair_of(double theta_i, double phi_i, double theta_r, double phi_r) {
    return {.theta_i = theta_i * kDegree,
            .phi_i = phi_i * kDegree,
            .theta_r = theta_r * kDegree,
            .phi_r = phi_r * kDegree};
}

double of(const AxisAngles &angles, AxisName name) {
    return angles[static_cast<std::size_t>(name)];
}

/// The direction of that inclination and azimuth in the room, after the stage turned the cloth.
glm::dvec3 in_the_room(const glm::dvec3 &of_cloth, double stage_deg) {
    const double turn = stage_deg * kDegree;
    return {of_cloth.x * std::cos(turn) - of_cloth.y * std::sin(turn),
            of_cloth.x * std::sin(turn) + of_cloth.y * std::cos(turn), of_cloth.z};
}

// The camera moves in one plane of the room and the lamp on two axes: together with the stage they
// see the cloth from the asked directions.
TEST(RigMotion, BringsLampAndCameraToTheDirections) {
    for (const double phi_i : {-170.0, 0.0, 45.0, 300.0})
        for (const double phi_r : {-90.0, 0.0, 10.0, 180.0}) {
            const DirectionPair pair = pair_of(30, phi_i, 60, phi_r);
            const AxisAngles angles = axis_angles_deg(pair);
            const double stage = of(angles, AxisName::stage);
            const glm::dvec3 camera = direction_of(of(angles, AxisName::camera) * kDegree, 0);
            const glm::dvec3 lamp = direction_of(of(angles, AxisName::lamp_theta) * kDegree,
                                                 of(angles, AxisName::lamp_phi) * kDegree);
            EXPECT_LT(glm::distance(in_the_room(pair.to_viewer(), stage), camera), 1e-12);
            EXPECT_LT(glm::distance(in_the_room(pair.to_light(), stage), lamp), 1e-12);
            EXPECT_GT(stage, -180.0001);
            EXPECT_LE(stage, 180);
        }
}

TEST(RigMotion, TakesTheTurnThatIsNearest) {
    RigFile rig;
    RigAxis &stage = rig.axes[static_cast<std::size_t>(AxisName::stage)];
    stage = {.zero_deg = 10, .sign = -1, .limits_deg = {-400, 400}};
    AxisAngles from{};
    from[static_cast<std::size_t>(AxisName::stage)] = 300;
    const DirectionPair pair = pair_of(30, 0, 60, 20); // the stage at -20, its drive at 30
    EXPECT_NEAR(of(positions_deg(rig, pair, {}), AxisName::stage), 30, 1e-9);
    EXPECT_NEAR(of(positions_deg(rig, pair, from), AxisName::stage), 390, 1e-9);
    stage.limits_deg = {-350, 0};
    EXPECT_NEAR(of(positions_deg(rig, pair, {}), AxisName::stage), -330, 1e-9);
}

TEST(RigMotion, NamesWhatCannotBeReached) {
    RigFile rig;
    rig.axes[static_cast<std::size_t>(AxisName::camera)].limits_deg = {-5, 50};
    rig.axes[static_cast<std::size_t>(AxisName::lamp_theta)].limits_deg = {-5, 50};
    try {
        positions_deg(rig, pair_of(60, 0, 61, 0), {});
        FAIL() << "no error";
    } catch (const Error &error) {
        ASSERT_EQ(error.problems().size(), 3u);
        EXPECT_EQ(error.problems()[0].where, "geometry.dead_cone_deg");
        EXPECT_EQ(error.problems()[1].where, "axes.lamp_theta");
        EXPECT_EQ(error.problems()[2].where, "axes.camera");
    }
    EXPECT_NO_THROW(positions_deg(rig, pair_of(50, 0, 40, 0), {})); // a limit itself is reached
}

// Straight above, the lamp would be in front of the camera.
TEST(RigMotion, KeepsLampAndCameraApart) {
    const RigFile rig;
    EXPECT_THROW(positions_deg(rig, pair_of(0, 0, 0, 0), {}), Error);
    EXPECT_THROW(positions_deg(rig, pair_of(0, 0, 5.9, 90), {}), Error);
    EXPECT_NO_THROW(positions_deg(rig, pair_of(0, 0, 6.1, 90), {}));
    EXPECT_NEAR(separation_deg(pair_of(30, 0, 30, 180)), 60, 1e-9);
}

} // namespace
} // namespace tsuya::lab
