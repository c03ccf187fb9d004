// The lights of scene files: kinds, units of their strength, and what is refused.

#include <gtest/gtest.h>

#include <cmath>

#include "samples/scratch.h"
#include "tsuya/scene/scene_file.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

// Line 5 is the first of `lights`.
SceneFile read(const Scratch &scratch, const std::string &lights) {
    scratch.write("cloth.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    return read_scene_file(scratch.write(
        "a.scene.toml",
        "[fabrics.silk]\n[bodies.cloth]\nmesh = \"cloth.obj\"\nfabric = \"silk\"\n" + lights));
}

Light light_of(const std::string &keys) {
    const Scratch scratch;
    return read(scratch, "[lights.a]\n" + keys).lights.at(0);
}

// Of a plane at `at` that faces the middle of the light.
double irradiance_at(const Light &light, const glm::dvec3 &at) {
    const auto place = place_of(light);
    return irradiance(
        light, at, glm::normalize(place ? place->centre - at : std::get<SunLight>(light).to_light));
}

TEST(SceneLights, HaveTheirKeys) {
    const auto disk = std::get<DiskLight>(
        light_of("type = \"disk\"\ncentre = [1, 2, 3]\ntarget = [1, 2, 0]\nradius = 0.3\n"
                 "radiance = 7\nvisible = true\nblocks = true\nshadows = false\n"));
    EXPECT_EQ(disk.centre, glm::dvec3(1, 2, 3));
    EXPECT_EQ(disk.direction, glm::dvec3(0, 0, -1));
    EXPECT_EQ(disk.radius, 0.3);
    EXPECT_EQ(disk.radiance, 7);
    EXPECT_TRUE(disk.behaviour.visible && disk.behaviour.blocks && !disk.behaviour.shadows);

    const auto sphere = std::get<SphereLight>(
        light_of("type = \"sphere\"\ncentre = [1, 2, 3]\nradius = 0.2\nradiance = 2\n"));
    EXPECT_EQ(sphere.radius, 0.2);
    EXPECT_FALSE(sphere.behaviour.visible || sphere.behaviour.blocks);
    EXPECT_TRUE(sphere.behaviour.shadows);

    const auto spot = std::get<PointLight>(
        light_of("type = \"spot\"\ncentre = [0, 3, 0]\ntarget = [0, 1, 0]\ncone_deg = 60\n"
                 "falloff = 0.25\nshadows = false\n"));
    EXPECT_EQ(spot.direction, glm::dvec3(0, -1, 0));
    EXPECT_NEAR(spot.cone_angle, 30 * kDegree, 1e-12);
    EXPECT_NEAR(spot.full_angle, 22.5 * kDegree, 1e-12);
    EXPECT_FALSE(spot.shadows);

    const auto point = std::get<PointLight>(light_of("type = \"point\"\ncentre = [0, 3, 0]\n"));
    EXPECT_EQ(point.cone_angle, kPi);

    const auto sun = std::get<SunLight>(
        light_of("type = \"sun\"\nazimuth_deg = 90\nelevation_deg = 30\ndiameter_deg = 2\n"
                 "visible = true\nstrength = 3\n"));
    EXPECT_NEAR(glm::length(sun.to_light - glm::dvec3(std::cos(30 * kDegree), 0.5, 0)), 0, 1e-12);
    EXPECT_NEAR(sun.angular_radius, kDegree, 1e-12);
    EXPECT_NEAR(sun.irradiance, 3 * kPi, 1e-12);
    EXPECT_TRUE(sun.visible);
}

TEST(SceneLights, LuminairesShineAsMeasured) {
    const Scratch scratch;
    scratch.write("a.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 100 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n"
                           "300 100\n");
    const std::string keys = "[lights.a]\ntype = \"ies\"\nprofile = \"a.ies\"\ncentre = [0, 3, 0]\n"
                             "turn_deg = 90\n";
    const auto own = std::get<PointLight>(read(scratch, keys).lights.at(0));
    EXPECT_NEAR(own.intensity, kPi / 1000, 1e-12); // of one candela
    EXPECT_EQ(own.profile->candela, (std::vector<double>{300, 100}));
    EXPECT_NEAR(glm::length(own.zero_plane - glm::dvec3(1, 0, 0)), 0, 1e-12);
    const Light scaled = read(scratch, keys + "lumen = 100\n").lights.at(0);
    EXPECT_NEAR(flux(scaled), 0.1 * kPi, 1e-9);
}

TEST(SceneLights, EachHasAGroup) {
    const Scratch scratch;
    const SceneFile file = read(
        scratch, "[lights.a]\ntype = \"point\"\ncentre = [0, 2, 0]\n"
                 "[lights.b]\ntype = \"sun\"\ngroup = \"a\"\n[lights.c]\ncentre = [0, 2, 2]\n");
    EXPECT_EQ(file.light_groups, (std::vector<std::string>{"a", "c"}));
    EXPECT_EQ(std::get<SunLight>(file.lights[1]).group, LightGroupIndex{0});
    EXPECT_EQ(name_of(file.lights[1]), "b");
}

// Every unit says the same of every kind, as light.h relates them.
TEST(SceneLights, StrengthsHaveUnits) {
    const std::string kinds[] = {"centre = [0, 3, 1]\n",
                                 "type = \"disk\"\ncentre = [0, 3, 1]\n",
                                 "type = \"sphere\"\ncentre = [0, 3, 1]\n",
                                 "type = \"point\"\ncentre = [0, 3, 1]\n",
                                 "type = \"spot\"\ncentre = [0, 3, 1]\n",
                                 "type = \"sun\"\n"};
    const glm::dvec3 target(0, 1, 0), at(0.2, 0.8, 0);
    for (const std::string &kind : kinds) {
        EXPECT_NEAR(irradiance_at(light_of(kind), target), kPi, 1e-9) << kind;
        EXPECT_NEAR(irradiance_at(light_of(kind + "lux = 500\n"), target), 0.5 * kPi, 1e-9);
        EXPECT_NEAR(
            irradiance_at(light_of("lux = 500\n" + kind + "[units]\nwhite_lux = 250\n"), target),
            2 * kPi, 1e-9);
        if (kind.find("sun") != std::string::npos)
            continue;
        EXPECT_NEAR(irradiance_at(light_of(kind + "lux = 500\nat = [0.2, 0.8, 0]\n"), at),
                    0.5 * kPi, 1e-9);
        EXPECT_NEAR(flux(light_of(kind + "lumen = 2000\n")), 2 * kPi, 1e-9) << kind;
    }
    EXPECT_NEAR(emission_of(light_of(kinds[3] + "candela = 3000\n")), 3 * kPi, 1e-9);
    EXPECT_EQ(emission_of(light_of(kinds[1] + "radiance = 3\n")), 3);
}

struct BadLight {
    const char *name, *keys;
    const char *place; ///< line and column
    const char *what, *accepted;
};

void PrintTo(const BadLight &bad, std::ostream *out) { *out << bad.name; }

class BadSceneLight : public testing::TestWithParam<BadLight> {};

TEST_P(BadSceneLight, IsRefusedAtItsPlace) {
    const Scratch scratch;
    try {
        read(scratch, GetParam().keys);
        ADD_FAILURE() << "accepted";
    } catch (const Error &error) {
        ASSERT_EQ(error.problems().size(), 1u) << error.what();
        const Problem &p = error.problems()[0];
        EXPECT_EQ(p.where, (scratch / "a.scene.toml").string() + ":" + GetParam().place);
        EXPECT_NE(p.what.find(GetParam().what), std::string::npos) << p.what;
        EXPECT_NE(p.accepted.find(GetParam().accepted), std::string::npos) << p.accepted;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Inputs, BadSceneLight,
    testing::Values(
        BadLight{"Type", "[lights.a]\ntype = \"dish\"\ncentre = [0, 2, 1]\n", "6:8", "'dish'",
                 "disk"},
        BadLight{"TwoUnits", "[lights.a]\ncentre = [0, 2, 1]\nlux = 3\nlumen = 4\n", "8:9",
                 "lux and lumen are both given", "one of them"},
        BadLight{"UnitOfAnotherKind", "[lights.a]\ncentre = [0, 2, 1]\ncandela = 3\n", "7:1",
                 "candela", ""},
        BadLight{"SunHasNoLumens", "[lights.a]\ntype = \"sun\"\nlumen = 3\n", "7:1", "lumen", ""},
        BadLight{"NegativeLux", "[lights.a]\ncentre = [0, 2, 1]\nlux = -3\n", "7:7", "-3",
                 "from 0"},
        BadLight{"BehindALight",
                 "[lights.a]\ntype = \"spot\"\ncentre = [0, 2, 1]\nlux = 3\nat = [0, 3, 2]\n",
                 "8:7", "does not reach", "'at'"},
        BadLight{"InsideASphere",
                 "[lights.a]\ntype = \"sphere\"\ncentre = [0, 1, 0]\nradius = 0.5\n", "5:1",
                 "does not reach", "'at'"},
        BadLight{"NoRadius", "[lights.a]\ntype = \"disk\"\ncentre = [0, 2, 1]\nradius = 0\n",
                 "8:10", "0", "from 1e-06"},
        BadLight{"DiskAtItsTarget", "[lights.a]\ntype = \"disk\"\ncentre = [0, 1, 0]\n", "7:10",
                 "at its target", "apart"},
        BadLight{"NoCone", "[lights.a]\ntype = \"spot\"\ncentre = [0, 2, 1]\ncone_deg = 0\n",
                 "8:12", "0", "from 0.1"},
        BadLight{"Falloff", "[lights.a]\ntype = \"spot\"\ncentre = [0, 2, 1]\nfalloff = 2\n",
                 "8:11", "2", "from 0 to 1"},
        BadLight{"PointsDoNotBlock",
                 "[lights.a]\ntype = \"point\"\ncentre = [0, 2, 1]\nblocks = true\n", "8:1",
                 "blocks", ""},
        BadLight{"NoProfile",
                 "[lights.a]\ntype = \"ies\"\ncentre = [0, 2, 1]\nprofile = \"no.ies\"\n", "8:11",
                 "no.ies", "relative"},
        BadLight{"WrongProfile",
                 "[lights.a]\ntype = \"ies\"\ncentre = [0, 2, 1]\nprofile = \"cloth.obj\"\n",
                 "8:11", "TILT", "LM-63"},
        BadLight{"BelowTheGround", "[lights.a]\ntype = \"sun\"\nelevation_deg = -100\n", "7:17",
                 "-100", "from -90"},
        BadLight{"WhiteLux", "[units]\nwhite_lux = 0\n[lights.a]\ncentre = [0, 2, 1]\n", "6:13",
                 "0", "from 1e-06"}),
    [](const auto &input) { return std::string(input.param.name); });

} // namespace
} // namespace tsuya::scene
