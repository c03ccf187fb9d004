// Files whose z points upwards.

#include <numbers>

#include <gtest/gtest.h>

#include "test_meshes.h"
#include "tsuya/garment/animation.h"
#include "tsuya/garment/check.h"
#include "tsuya/garment/garment.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// A skirt that stands along z, wider at its hem, 0.6 m high.
PolygonMesh skirt_along_z() {
    constexpr double kTurn = 2.0 * std::numbers::pi / 24;
    return test::grid(24, 12, true, false, glm::dvec2(0.05), [](int i, int j) {
        const double radius = 0.26 - 0.008 * j;
        return glm::dvec3(radius * std::cos(kTurn * i), radius * std::sin(kTurn * i), 0.05 * j);
    });
}

/// The same with y up.
PolygonMesh skirt_along_y() {
    PolygonMesh mesh = skirt_along_z();
    for (glm::dvec3 &p : mesh.position)
        p = {p.x, p.z, -p.y};
    return mesh;
}

bool found(const Report &report) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [](const Finding &f) { return f.key == "probably_z_up"; });
}

TEST(UpAxis, AGarmentThatStandsAlongZIsFoundWhereNothingIsStated) {
    EXPECT_TRUE(found(load(skirt_along_z(), {}, "m").report));
    EXPECT_FALSE(found(load(skirt_along_z(), {.up = UpAxis::y}, "m").report));
    EXPECT_FALSE(found(load(skirt_along_z(), {.up = UpAxis::z}, "m").report));
    EXPECT_FALSE(found(load(skirt_along_y(), {}, "m").report));
    EXPECT_THROW(load(skirt_along_z(), {.strict = true}, "m"), Error);
}

TEST(UpAxis, OtherShapesAreLeftAlone) {
    // A sleeve along x, a flat panel, a closed body, and a low wide skirt.
    PolygonMesh sleeve = skirt_along_z();
    for (glm::dvec3 &p : sleeve.position)
        p = {p.z, p.x, p.y};
    EXPECT_FALSE(find_up_axis(check(sleeve)));
    EXPECT_FALSE(find_up_axis(check(test::panel(4, 4, 0.2))));
    EXPECT_FALSE(find_up_axis(check(test::cube())));
    PolygonMesh low = skirt_along_z();
    for (glm::dvec3 &p : low.position)
        p.z *= 0.5;
    EXPECT_FALSE(find_up_axis(check(low)));
    // Openings beside each other along z more than above each other: a leaning tube.
    PolygonMesh leaning = skirt_along_z();
    for (glm::dvec3 &p : leaning.position)
        p.x += 0.5 * p.z;
    EXPECT_FALSE(find_up_axis(check(leaning)));
}

TEST(UpAxis, ZUpIsTheSameGarmentTurned) {
    const LoadedGarment turned = load(skirt_along_z(), {.up = UpAxis::z}, "m");
    const LoadedGarment upright = load(skirt_along_y(), {}, "m");
    ASSERT_EQ(turned.surface.position.size(), upright.surface.position.size());
    for (std::size_t v = 0; v < upright.surface.position.size(); ++v) {
        EXPECT_EQ(turned.surface.position[v], upright.surface.position[v]);
        EXPECT_EQ(turned.surface.normal[v], upright.surface.normal[v]);
        EXPECT_EQ(turned.surface.warp[v], upright.surface.warp[v]);
    }
    EXPECT_EQ(in_metres({.metres_per_unit = 0.01, .up = UpAxis::z}, {100, 200, 300}),
              glm::dvec3(1, 3, -2));
    EXPECT_EQ(up_axis("y"), UpAxis::y);
    EXPECT_THROW(up_axis("x"), Error);
}

TEST(UpAxis, FurtherFramesAreTurnedToo) {
    const PolygonMesh mesh = skirt_along_z();
    AnimatedGarment garment({.mesh = mesh}, {.up = UpAxis::z}, "m");
    EXPECT_EQ(garment.frame(mesh.position).position, garment.first().surface.position);
}

} // namespace
} // namespace tsuya::garment
