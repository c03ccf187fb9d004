// What a render keeps on the disk and hands out while it runs, and how it is stopped.

#include <filesystem>
#include <iostream>

#include <gtest/gtest.h>

#include "limited_disk.h"
#include "sdk/render_scenes.h"
#include "tsuya/sdk/file.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;
namespace fs = std::filesystem;

// A folder that a test shares with the process of its death test, which is started anew.
class RenderFiles : public testing::Test {
  protected:
    RenderFiles() {
        GTEST_FLAG_SET(death_test_style, "threadsafe");
        constexpr const char *kName = "TSUYA_RENDER_TEST_FOLDER";
        if (const char *const shared = std::getenv(kName)) {
            folder_ = shared;
            return;
        }
        folder_ = fs::path(testing::TempDir()) / ("tsuya-render-" + std::to_string(getpid()));
        setenv(kName, folder_.c_str(), 1);
        fs::create_directories(folder_);
        owner_ = true;
    }
    ~RenderFiles() override {
        if (!owner_)
            return;
        unsetenv("TSUYA_RENDER_TEST_FOLDER");
        fs::remove_all(folder_);
    }
    RenderSettings settings(int samples) const {
        RenderSettings s = quick(samples);
        s.checkpoint = folder_ / "a.checkpoint";
        return s;
    }

    fs::path folder_{};
    bool owner_ = false;
    const Scene scene_ = folded_satin(70, 50); // six tiles; a film of 238 kB
};

RenderResult interrupted_at(double fraction, const Scene &scene, const RenderSettings &settings) {
    std::atomic<bool> stop{false};
    return render(
        scene, settings,
        {.report = [&](std::string_view stage,
                       double done) { stop = stop || (stage == "render" && done > fraction); },
         .stop = &stop});
}

TEST_F(RenderFiles, ACompleteCheckpointGivesThePictureAtOnce) {
    RenderSettings s = settings(24);
    const RenderResult first = render(scene_, s);
    ASSERT_TRUE(fs::exists(s.checkpoint)) << "it is the caller who removes it";
    EXPECT_TRUE(first.warnings.empty());
    s.resume = true;
    const RenderResult again = render(scene_, s);
    EXPECT_EQ(again.image.transport, first.image.transport);
    EXPECT_EQ(again.stats.rays, first.stats.rays) << "nothing was traced";
}

void render_until_killed(const Scene &scene, RenderSettings settings) {
    settings.checkpoint_seconds = 1e-6;
    render(scene, settings, {.report = [&](std::string_view, double done) {
               if (done > 0.5 && fs::exists(settings.checkpoint))
                   std::raise(SIGKILL);
           }});
}

TEST_F(RenderFiles, AKilledRenderGoesOnToTheSameBits) {
    RenderSettings s = settings(24);
    EXPECT_EXIT(render_until_killed(scene_, s), testing::KilledBySignal(SIGKILL), "");
    ASSERT_TRUE(fs::exists(s.checkpoint));
    s.resume = true;
    double least = 1;
    const RenderResult resumed =
        render(scene_, s, {.report = [&](std::string_view stage, double done) {
                   if (stage == "render")
                       least = std::min(least, done);
               }});
    EXPECT_EQ(resumed.image.transport, render(scene_, quick(24)).image.transport);
}

TEST_F(RenderFiles, WithoutAnIntervalACheckpointIsLeftAtTheEndOnly) {
    RenderSettings s = settings(24);
    s.checkpoint_seconds = 0;
    bool found = false;
    render(scene_, s, {.report = [&](std::string_view, double) {
               found = found || fs::exists(s.checkpoint);
           }});
    EXPECT_FALSE(found);
    EXPECT_TRUE(fs::exists(s.checkpoint));
}

TEST_F(RenderFiles, ADiskThatEndsKeepsThePictureAndTheOlderCheckpoint) {
    RenderSettings s = settings(24);
    ASSERT_TRUE(interrupted_at(0.4, scene_, s).stats.interrupted);
    const std::string older = read_file(s.checkpoint);
    s.resume = true;
    RenderResult finished;
    {
        const FileSizeLimit limit(100'000);
        finished = render(scene_, s);
    }
    EXPECT_EQ(finished.image.transport, render(scene_, quick(24)).image.transport);
    ASSERT_EQ(finished.warnings.size(), 1u);
    EXPECT_EQ(finished.warnings[0].where, s.checkpoint.string());
    EXPECT_EQ(read_file(s.checkpoint), older);
}

TEST_F(RenderFiles, AFullDiskIsNamedAndKeepsTheOlderCheckpoint) {
    expect_on_small_disk(300, [&](const fs::path &folder) { // one checkpoint and not two
        RenderSettings s = settings(24);
        s.checkpoint = folder / "c.checkpoint";
        interrupted_at(0.4, scene_, s);
        const std::string older = read_file(s.checkpoint);
        s.resume = true;
        const RenderResult result = interrupted_at(0.8, scene_, s);
        for (const Problem &p : result.warnings)
            std::cerr << p.where << ": " << p.what << "; " << p.accepted << "\n";
        return result.stats.interrupted && result.warnings.size() == 1 &&
               result.warnings[0].accepted == "expected space on the disk" &&
               read_file(s.checkpoint) == older;
    });
}

TEST_F(RenderFiles, ASnapshotIsTakenBetweenTilesAndChangesNothing) {
    std::atomic<bool> wanted{true};
    std::vector<RenderResult> snapshots;
    RenderSettings s = quick(8); // one pass
    s.threads = 1;
    s.snapshot_wanted = &wanted;
    s.snapshot = [&](const RenderResult &so_far) { snapshots.push_back(so_far); };
    const RenderResult whole = render(scene_, s);
    ASSERT_EQ(snapshots.size(), 1u);
    EXPECT_FALSE(wanted);
    const RenderStats &stats = snapshots[0].stats;
    EXPECT_GT(stats.samples_per_pixel, 0);
    EXPECT_LT(stats.samples_per_pixel, 8) << "the pass was not at its end";
    EXPECT_FALSE(stats.interrupted);
    // What it has is what the picture will have
    const std::vector<float> &part = snapshots[0].image.transport;
    std::size_t other = 0;
    for (std::size_t i = 0; i < part.size(); ++i)
        other += part[i] != 0 && part[i] != whole.image.transport[i] ? 1 : 0;
    EXPECT_EQ(other, 0u);
    EXPECT_EQ(whole.image.transport, render(scene_, quick(8)).image.transport);
}

// A mesh whose BVH takes a while.
Scene fine_floor() {
    Scene scene = folded_satin(8, 8);
    Surface &floor = scene.surfaces[1];
    floor = {};
    constexpr unsigned n = 500;
    for (unsigned j = 0; j <= n; ++j)
        for (unsigned i = 0; i <= n; ++i)
            floor.position.emplace_back(i * 0.01 - 2.5, 0, 2.5 - j * 0.01);
    floor.normal.assign(floor.position.size(), {0, 1, 0});
    for (unsigned j = 0; j < n; ++j)
        for (unsigned i = 0; i < n; ++i) {
            const unsigned a = j * (n + 1) + i;
            floor.triangle.emplace_back(a, a + 1, a + n + 2);
            floor.triangle.emplace_back(a, a + n + 2, a + n + 1);
        }
    return scene;
}

TEST_F(RenderFiles, StopEndsTheBuildingOfTheBvh) {
    std::atomic<bool> stop{false};
    double furthest = 0;
    bool traced = false;
    const RenderResult result = render(fine_floor(), settings(8),
                                       {.report =
                                            [&](std::string_view stage, double done) {
                                                traced = traced || stage == "render";
                                                furthest = std::max(furthest, done);
                                                stop = done > 0.1;
                                            },
                                        .stop = &stop});
    EXPECT_TRUE(result.stats.interrupted);
    EXPECT_EQ(result.stats.rays.all(), 0u);
    EXPECT_FALSE(traced);
    EXPECT_GT(furthest, 0.1);
    EXPECT_LT(furthest, 0.9);
    EXPECT_EQ(largest_difference(result.image, 0, 0.0), 0.0);
    EXPECT_FALSE(fs::exists(settings(8).checkpoint)) << "there is nothing to keep";
}

} // namespace
