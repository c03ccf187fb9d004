#include "tsuya/lab/view_geometry.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tsuya/sdk/angle.h"

namespace tsuya::lab {
namespace {

DirectionPair degrees(double theta_i, double phi_i, double theta_r, double phi_r) {
    return {theta_i * kDegree, phi_i * kDegree, theta_r * kDegree, phi_r * kDegree};
}

TEST(ViewGeometry, PatchesAndSpotsAreForeshortened) {
    EXPECT_NEAR(patch_length_mm(0.8, 75 * kDegree), 3.09, 0.01);
    EXPECT_NEAR(spot_length_mm(30, degrees(60, 0, 0, 0)), 60, 1e-9);
    EXPECT_NEAR(spot_length_mm(30, degrees(60, 0, 20, 180)), 60, 1e-9);
    EXPECT_NEAR(spot_length_mm(30, degrees(60, 0, 20, 90)), 30, 1e-9);
}

TEST(ViewGeometry, RaisedWhiteIsSeenOffTheMiddleOfTheSpot) {
    EXPECT_DOUBLE_EQ(raised_irradiance(0, 30, 600, degrees(45, 0, 75, 90)), 1);
    // Camera at 75 degrees, light from above: 3.73 mm off the middle; Gaussian, half at 15 mm.
    EXPECT_NEAR(raised_irradiance(1, 30, 0, degrees(0, 0, 75, 30)),
                std::exp2(-std::pow(3.7320508 / 15, 2)), 1e-9);
    // Lamp and camera on one side at one angle see the same point.
    EXPECT_NEAR(raised_irradiance(1, 30, 0, degrees(60, 40, 60, 40)), 1, 1e-12);
    // On opposite sides twice as far; across the beam cos(theta_i) of that.
    EXPECT_NEAR(raised_irradiance(1, 30, 0, degrees(60, 0, 60, 180)),
                std::exp2(-std::pow(2 * std::tan(60 * kDegree) * 0.5 / 15, 2)), 1e-9);
    // Nearer to the lamp.
    EXPECT_NEAR(raised_irradiance(6, 0, 600, degrees(0, 0, 45, 0)), std::pow(600 / 594.0, 2), 1e-9);
}

// The same by points in space: the camera's ray meets the raised surface, and the point's distance
// from the beam's axis says how much light it gets.
TEST(ViewGeometry, ARaisedSurfaceIsSeenWhereTheCamerasRayMeetsIt) {
    EXPECT_NEAR(raised_irradiance(1, 30, 0, degrees(0, 0, 75, 0)), 1 - 0.042, 5e-4);
    for (const double theta_i : {0.0, 20.0, 60.0})
        for (const double theta_r : {0.0, 45.0, 75.0})
            for (const double phi : {0.0, 50.0, 90.0, 180.0}) {
                const DirectionPair at = degrees(theta_i, 10, theta_r, 10 + phi);
                const glm::dvec3 light = at.to_light(), viewer = at.to_viewer();
                const glm::dvec3 met = viewer * (1.5 / viewer.z); // 1.5 mm above the plane
                const double off_axis = glm::length(glm::cross(met, light));
                EXPECT_NEAR(raised_irradiance(1.5, 30, 0, at),
                            std::exp(-std::log(2.0) * off_axis * off_axis / (15 * 15)), 1e-12)
                    << theta_i << " " << theta_r << " " << phi;
            }
}

TEST(ViewGeometry, AnglesOfDisks) {
    EXPECT_NEAR(disk_angle(8, 600) / kDegree, 0.764, 1e-3);
    EXPECT_EQ(disk_angle(8, 0), 0);
}

TEST(ViewGeometry, NarrowestLobeIsMeasuredAcrossItsHalf) {
    ReflectanceTable table;
    const auto add = [&](double theta_i_deg, double theta_r_deg, double phi_deg, double value) {
        table.rows.push_back({.theta_i = theta_i_deg * kDegree,
                              .theta_r = theta_r_deg * kDegree,
                              .phi_r = phi_deg * kDegree,
                              .brdf_per_sr = value});
    };
    add(0, 0, 0, 1);
    for (const double theta_deg : {5, 10, 15, 20}) {
        add(0, theta_deg, 0, 1 - theta_deg / 40);              // half at 20 degrees
        add(0, theta_deg, 90, 1 - theta_deg / 20);             // half at 10 degrees
        add(0, theta_deg, 45, theta_deg == 10 ? 0.02 : 0.001); // not a lobe: its top is the pole
    }
    EXPECT_NEAR(narrowest_lobe(table) / kDegree, 5.0 * 0.5 / 0.999 * 2, 0.01) << "towards 45";
    std::erase_if(table.rows,
                  [](const auto &row) { return std::abs(row.phi_r - 45 * kDegree) < .1; });
    EXPECT_NEAR(narrowest_lobe(table) / kDegree, 20, 1e-6);
    table.rows.clear();
    for (const double theta_deg : {30, 35, 40, 45, 50, 55, 60}) // a lobe at 45 degrees
        add(45, theta_deg, 180, std::exp2(-std::pow((theta_deg - 45) / 4, 2)));
    EXPECT_NEAR(narrowest_lobe(table) / kDegree, 8, 1);
    table.rows.resize(2);
    EXPECT_EQ(narrowest_lobe({}), kPi);
}

} // namespace
} // namespace tsuya::lab
