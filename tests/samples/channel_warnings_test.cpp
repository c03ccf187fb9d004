#include "tsuya/scene/channel_warnings.h"

#include <gtest/gtest.h>

#include "tsuya/color/dye.h"

namespace tsuya::scene {
namespace {

Scene scene_of(const Spectrum &colour) {
    Scene scene;
    scene.fabrics.push_back({.name = "silk"});
    scene.fabrics[0].colours.dye = colour;
    scene.objects.push_back({});
    return scene;
}

// A dye that absorbs all below 580 nm and nothing above.
const Spectrum kSharp{{580, 581}, {0.04, 0.8}};

TEST(ChannelWarnings, TellOfADyeThatChannelsCannotShow) {
    const auto warnings = channel_warnings(scene_of(kSharp), {.channels = 16});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].where, "fabrics.silk");
    EXPECT_NE(warnings[0].what.find("16 channels"), std::string::npos);
    EXPECT_TRUE(channel_warnings(scene_of(dye("crimson")), {.channels = 16}).empty());
    EXPECT_TRUE(channel_warnings(scene_of(Spectrum::constant(0.8)), {.channels = 8}).empty());
}

TEST(ChannelWarnings, AreSilentWhereTheyWouldNotHold) {
    Scene scene = scene_of(kSharp);
    scene.open_dyes = {FabricIndex{0}};
    EXPECT_TRUE(channel_warnings(scene, {.channels = 16}).empty()) << "depths of dye are exact";
    scene.open_dyes.clear();
    scene.objects.clear();
    EXPECT_TRUE(channel_warnings(scene, {.channels = 16}).empty()) << "it dresses nothing";
}

TEST(ChannelWarnings, LookAtTheInksOfPrints) {
    Scene scene = scene_of(Spectrum::constant(0.8));
    scene.prints.push_back({.layers = {{.inks = {kSharp}}}});
    const auto warnings = channel_warnings(scene, {.channels = 16});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].where, "prints.0");
}

} // namespace
} // namespace tsuya::scene
