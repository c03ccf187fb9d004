// Whole studios: in the size of their subject, with a lamp for every group.

#include "tsuya/scene/studio_preset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "samples/scratch.h"
#include "tsuya/color/lamp.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/own_lamps.h"
#include "tsuya/scene/picture.h"
#include "tsuya/scene/scene_file.h"
#include "tsuya/scene/sky.h"
#include "tsuya/scene/tryon.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

TEST(StudioPreset, HasGroupsWithLampsThatAreUsed) {
    for (const std::string &name : studio_names()) {
        const Studio studio = make_studio(name, {});
        std::set<std::uint32_t> used;
        for (const Light &light : studio.lights)
            used.insert(std::visit([](const auto &l) { return l.group.value; }, light));
        if (studio.environment)
            used.insert(studio.environment->group.value);
        EXPECT_EQ(used.size(), studio.groups.size()) << name;
        for (const StudioGroup &group : studio.groups) {
            EXPECT_NO_THROW(lamp(group.lamp)) << name;
            EXPECT_NE(studio_description(name).find(group.name + " " + group.lamp),
                      std::string::npos);
        }
    }
}

// What a white diffuser in the middle of the subject shows that is turned as a chest: without
// shadows and the light of the backdrop.
double exposure(const Studio &studio, const Subject &subject) {
    const glm::dvec3 middle = 0.5 * (subject.lower + subject.upper);
    const glm::dvec3 normal = direction_at(subject.azimuth, 0);
    double sum = 0;
    for (const Light &light : studio.lights) {
        const auto place = place_of(light);
        const glm::dvec3 to_light =
            place ? place->centre - middle : std::get<SunLight>(light).to_light;
        if (glm::dot(to_light, normal) > 0)
            sum += irradiance(light, middle, normal) / kPi;
    }
    return sum;
}

TEST(StudioPreset, ScalesAndTurnsWithItsSubject) {
    for (const std::string &name : studio_names()) {
        const Subject person{}, doll{.lower = {5, 1, 2}, .upper = {5, 1.16, 2}, .azimuth = 2};
        const Studio large = make_studio(name, person), small = make_studio(name, doll);
        EXPECT_NEAR(exposure(small, doll), exposure(large, person), 0.01) << name;
        EXPECT_GT(exposure(large, person), 0.2) << name;
        EXPECT_LT(exposure(large, person), 1.1) << name;
        EXPECT_NEAR(small.backdrop.width, 0.1 * large.backdrop.width, 1e-9);
        EXPECT_NEAR(small.backdrop.centre.y, 1, 1e-12);
    }
}

TEST(StudioPreset, RefusesUnknownNames) {
    try {
        make_studio("softbux", {});
        ADD_FAILURE() << "accepted";
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].where, "studio");
        EXPECT_NE(error.problems()[0].accepted.find("did you mean softbox"), std::string::npos);
    }
    TryOn job = sample_try_on(data_folder());
    job.studio = "garden";
    EXPECT_THROW(run(job), Error);
}

TEST(StudioPreset, IsPutIntoAScene) {
    const Scratch scratch;
    scratch.write("cloth.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string rest = "[fabrics.silk]\n[bodies.cloth]\nmesh = \"cloth.obj\"\n"
                             "fabric = \"silk\"\n";
    const auto built = [&](const std::string &first, const std::string &last) {
        return build_scene(read_scene_file(scratch.write("a.scene.toml", first + rest + last)));
    };
    const BuiltScene alone = built("studio = \"home\"\n", "");
    EXPECT_EQ(alone.scene.light_groups, (std::vector<std::string>{"lamps", "room", "window"}));
    EXPECT_EQ(alone.own_lamps, (std::vector<std::string>{"A", "A", "D65"}));
    EXPECT_EQ(alone.scene.lights.size(), 3u);
    EXPECT_EQ(alone.scene.objects.size(), 2u); // with its backdrop

    const BuiltScene more =
        built("studio = \"home\"\n", "[lights.torch]\ntype = \"point\"\ncentre = [0, 1, 2]\n"
                                     "group = \"window\"\nlamp = \"d65\"\n[environment]\n");
    EXPECT_EQ(more.scene.light_groups, (std::vector<std::string>{"window", "environment", "lamps"}))
        << "nothing is left that shines in the group of the studio's environment";
    EXPECT_EQ(more.own_lamps, (std::vector<std::string>{"d65", "", "A"}));
    EXPECT_FALSE(more.scene.environment->picture);
    EXPECT_EQ(std::get<SphereLight>(more.scene.lights[1]).group, LightGroupIndex{2});
    EXPECT_THROW(built("studio = \"hone\"\n", ""), Error);
}

TEST(StudioPresets, ALightJoinsAGroupUnderItsLamp) {
    const Scratch scratch;
    scratch.write("cloth.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto problems = [&](const std::string &lights) {
        try {
            read_scene_file(
                scratch.write("a.scene.toml", "studio = \"portrait\"\n[bodies.cloth]\n"
                                              "mesh = \"cloth.obj\"\nfabric = \"silk\"\n"
                                              "[fabrics.silk]\n" +
                                                  lights));
        } catch (const Error &error) {
            return error.problems();
        }
        return std::vector<Problem>{};
    };
    const std::string torch = "[lights.torch]\ntype = \"point\"\ncentre = [0, 1, 2]\n";
    const auto other = problems(torch + "group = \"fill\"\nlamp = \"A\"\n");
    ASSERT_EQ(other.size(), 1u);
    EXPECT_EQ(other[0].where, (scratch / "a.scene.toml").string() + ":10:8");
    EXPECT_EQ(other[0].what, "the group has the lamp D65 of the studio");
    EXPECT_EQ(problems(torch + "group = \"fill\"\nlamp = \"A\"\n[environment]\n").size(), 0u)
        << "the group is empty without the studio's environment";
    EXPECT_EQ(problems(torch + "group = \"key\"\nlamp = \"A\"\n[environment]\n").size(), 1u);
    // Pictures under the lights' own lamps: each group needs one
    const std::string own = "[output]\nlamps = [\"D65\", \"own\"]\n";
    EXPECT_EQ(problems(own).size(), 0u);
    EXPECT_EQ(problems(torch + "group = \"fill\"\n" + own).size(), 0u);
    const auto missing = problems(torch + own);
    ASSERT_EQ(missing.size(), 1u);
    EXPECT_EQ(missing[0].where, (scratch / "a.scene.toml").string() + ":10:9");
    EXPECT_EQ(missing[0].what, "light group 'torch' has no lamp of its own");
    EXPECT_EQ(problems(torch + "lamp = \"A\"\n" + own).size(), 0u);
    EXPECT_EQ(problems(torch + "lamp = \"no lamp\"\n" + own).size(), 1u);
}

TEST(OwnLamps, AreKeptWithTheTransport) {
    SpectralImage image = SpectralImage::make(1, 1, {.count = 8}, {"key", "fill", "sky"});
    std::fill(image.transport.begin(), image.transport.end(), 0.25f);
    note_own_lamps(image, std::vector<std::string>{"A", "environment-blue", ""});
    EXPECT_THROW(own_lamps(image), Error); // of the third group nothing is known
    note_own_lamps(image, std::vector<std::string>{"A", "environment-blue", "D65"});
    const std::vector<NamedLamp> own = own_lamps(image);
    EXPECT_EQ(own[0].spectrum, lamp("A"));
    EXPECT_EQ(own[1].name, "environment-blue");
    EXPECT_GT(own[1].spectrum.at(450), 20 * own[1].spectrum.at(600));

    const std::vector<std::string> specs{"own", "fill=HP4"};
    const auto mixed = parse_group_or_own_lamps(specs, image);
    EXPECT_EQ(mixed[0].name, "A");
    EXPECT_EQ(mixed[1].name, "HP4");
    EXPECT_EQ(mixed[2].name, "D65");
    const std::vector<std::string> one_own{"fill=own", "A"};
    const auto rest = parse_group_or_own_lamps(one_own, image);
    EXPECT_EQ(rest[0].name, "A");
    EXPECT_EQ(rest[1].name, "environment-blue");
    EXPECT_EQ(rest[2].name, "A");
    const auto refuses = [&](const std::vector<std::string> &wrong) {
        EXPECT_THROW(parse_group_or_own_lamps(wrong, image), Error);
    };
    refuses({"own", "own"});
    refuses({"own", "fell=HP4"});
    refuses({"own", "D65"});
    const NamedLamp named{.name = kOwnLamps};
    EXPECT_EQ(picture_under(image, {&named, 1}).data, picture_under(image, own).data);
    const std::vector<std::string> both{"D65", "own"};
    EXPECT_EQ(parse_picture_lamps(both)[1].name, "own");
}

} // namespace
} // namespace tsuya::scene
