// A fabric's weave becomes the map of what lies on its face.

#include "tsuya/scene/read_cloth.h"

#include <gtest/gtest.h>

#include "samples/scratch.h"
#include "tsuya/lab/weave_face.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

const std::string kStart = "schema = \"tsuya-fabric 1\"\nname = \"cloth\"\n"; // lines 1 and 2

TEST(ReadCloth, MakesTheMapOfItsPreset) {
    const Scratch scratch;
    const Fabric cloth =
        read_cloth(scratch.write("c.fabric.toml", kStart + "[weave]\npreset = \"twill lining\"\n"));
    ASSERT_TRUE(cloth.weave);
    EXPECT_EQ(cloth.weave->map, lab::face_of(lab::weave("twill lining")));
}

TEST(ReadCloth, MakesTheMapOfAFileBesideIt) {
    const Scratch scratch;
    scratch.write("my.weave.toml", "[weave]\ndraft = \"twill 2/1\"\n[warp]\nper_cm = 40\n");
    const Fabric cloth =
        read_cloth(scratch.write("c.fabric.toml", kStart + "[weave]\nfile = \"my.weave.toml\"\n"));
    ASSERT_TRUE(cloth.weave);
    EXPECT_EQ(cloth.weave->map.threads, glm::ivec2(3, 3));
    EXPECT_NEAR(cloth.weave->map.spacing().x, 0.25e-3, 1e-12);
}

TEST(ReadCloth, LeavesAClothWithoutWeaveAsItIs) {
    const Scratch scratch;
    EXPECT_FALSE(read_cloth(scratch.write("c.fabric.toml", kStart)).weave);
}

TEST(ReadCloth, SaysWhereAWeaveIsWrong) {
    const Scratch scratch;
    const auto problem = [&](const std::string &text) {
        try {
            read_cloth(scratch.write("c.fabric.toml", kStart + text));
        } catch (const Error &error) {
            return error.problems().front();
        }
        return Problem{"accepted", "", ""};
    };
    const Problem preset = problem("[weave]\npreset = \"twil lining\"\n");
    EXPECT_EQ(preset.where, (scratch / "c.fabric.toml").string() + ":4:10");
    EXPECT_NE(preset.accepted.find("twill lining"), std::string::npos) << preset.accepted;
    scratch.write("bad.weave.toml", "[weave]\ndraft = \"twil 2/2\"\n");
    const Problem file = problem("[weave]\nfile = \"bad.weave.toml\"\n");
    EXPECT_EQ(file.where.find((scratch / "bad.weave.toml").string() + ":2:9"), 0u) << file.where;
    const Problem none = problem("[weave]\nfile = \"none.weave.toml\"\n");
    EXPECT_EQ(none.where, (scratch / "c.fabric.toml").string() + ":4:8");
    EXPECT_NE(none.what.find("none.weave.toml"), std::string::npos) << none.what;
}

} // namespace
} // namespace tsuya::scene
