// The off-specular peak of a glossy plain weave splits [Pont]: yarns wave about the plane of the
// cloth, most of their length lies at the steepest slope of one sign or the other, and either
// turns the mirror direction its own way.

#include <gtest/gtest.h>

#include <algorithm>

#include "lab/filament_samples.h"
#include "tsuya/lab/goniometer.h"
#include "tsuya/lab/weave_geometry.h"

namespace tsuya::lab {
namespace {

using std::numbers::pi;

/// A plain weave of round wires, such as the gauze of [Pont].
FilamentRepeat gauze(double roughness) {
    const Yarn wire{.per_cm = 20,
                    .width = 0.1e-3,
                    .flattening = 1,
                    .filaments = 1,
                    .surface_roughness = roughness};
    return build_filaments({.name = "gauze", .draft = plain_weave(), .warp = wire, .weft = wire});
}

/// The same wires, straight, warp on weft.
FilamentRepeat straight(double roughness) {
    FilamentRepeat repeat = gauze(roughness);
    for (Filament &f : repeat.filaments)
        for (glm::vec3 &p : f.point)
            p.z = f.system == 0 ? f.radius : -f.radius;
    return repeat;
}

/// Steepest angle of a warp wire to the plane of the cloth, radians.
double steepest(const FilamentRepeat &repeat) {
    double slope = 0;
    const std::vector<glm::vec3> &p = repeat.filaments[0].point;
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
        slope = std::max<double>(slope, std::abs(p[i + 1].z - p[i].z) / (p[i + 1].y - p[i].y));
    return std::atan(slope);
}

/// brdf x cos theta_r on a line of views through the mirror direction.
struct Profile {
    std::vector<double> turn_deg{}, value{}, sigma{}; ///< turn from the mirror direction to +y
    std::size_t left = 0, right = 0;                  ///< largest of each side
    std::size_t mirror = 0;

    /// How far the mirror direction lies below the lower of the two maxima, in standard errors.
    double dip() const {
        const std::size_t lower = value[left] < value[right] ? left : right;
        return (value[lower] - value[mirror]) / std::hypot(sigma[lower], sigma[mirror]);
    }
};

/// \param in_plane the light stands in the plane of the warp wires, in which the views lie as well;
/// else it stands across them, and the views lie off its plane
Profile profile(const FilamentRepeat &repeat, double theta_deg, bool in_plane) {
    constexpr int kReach = 40, kStep = 2; // degrees
    const double s = std::sin(theta_deg * kDegree), c = std::cos(theta_deg * kDegree);
    Profile result;
    Directions directions;
    for (int turn = -kReach; turn <= kReach; turn += kStep) {
        const double a = turn * kDegree;
        const glm::dvec3 view = in_plane
                                    ? glm::dvec3(0, std::sin(a - theta_deg * kDegree),
                                                 std::cos(a - theta_deg * kDegree))
                                    : glm::dvec3(-s * std::cos(a), std::sin(a), c * std::cos(a));
        directions.pairs.push_back({theta_deg * kDegree, in_plane ? pi / 2 : 0, std::acos(view.z),
                                    std::atan2(view.y, view.x)});
        result.turn_deg.push_back(turn);
    }
    for (const ReflectanceRow &row : measure(repeat, directions, {.photons = 1 << 19}).table.rows) {
        result.value.push_back(row.brdf_per_sr * std::cos(row.theta_r));
        result.sigma.push_back(row.sigma_per_sr * std::cos(row.theta_r));
    }
    const auto begin = result.value.begin();
    result.mirror = result.value.size() / 2;
    const auto middle = begin + static_cast<std::ptrdiff_t>(result.mirror);
    result.left = static_cast<std::size_t>(std::max_element(begin, middle) - begin);
    result.right =
        static_cast<std::size_t>(std::max_element(middle + 1, result.value.end()) - begin);
    return result;
}

struct Case {
    double theta_deg;
    bool in_plane;
};
constexpr Case kCases[] = {{0, true}, {30, true}, {30, false}, {50, false}};
constexpr double kEnough = 5; // standard errors

TEST(GlossyPlainWeave, SplitsItsOffSpecularPeak) {
    const FilamentRepeat repeat = gauze(0.05);
    const double steep = steepest(repeat);
    ASSERT_GT(steep, 10 * kDegree);
    for (const Case &at : kCases) {
        const Profile p = profile(repeat, at.theta_deg, at.in_plane);
        // In the plane of the wires the mirror direction turns by twice the slope. Across it, the
        // half vector is normal to the inclined wire.
        const double expected =
            at.in_plane ? 2 * steep
                        : 2 * std::atan(std::cos(at.theta_deg * kDegree) * std::tan(steep));
        EXPECT_NEAR(p.turn_deg[p.left], -expected / kDegree, 5) << at.theta_deg;
        EXPECT_NEAR(p.turn_deg[p.right], expected / kDegree, 5) << at.theta_deg;
        EXPECT_GT(p.dip(), kEnough) << at.theta_deg;
        EXPECT_GT(p.value[p.left], 3 * p.value[p.mirror]) << at.theta_deg;
        EXPECT_GT(p.value[p.right], 3 * p.value[p.mirror]) << at.theta_deg;
    }
}

TEST(GlossyPlainWeave, DoesNotSplitItWhereItIsRoughOrStraight) {
    for (const FilamentRepeat &repeat : {gauze(0.3), straight(0.05)})
        for (const Case &at : kCases)
            EXPECT_LT(profile(repeat, at.theta_deg, at.in_plane).dip(), kEnough) << at.theta_deg;
}

} // namespace
} // namespace tsuya::lab
