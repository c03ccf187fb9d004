// Try-ons of a figure that turns.

#include "turntable.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "samples/scratch.h"
#include "tsuya/color/image_file.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/studio.h"
#include "tsuya/scene/tryon.h"
#include "tsuya/scene/video.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

namespace fs = std::filesystem;

TryOn turning_job(const fs::path &output, int views) {
    TryOn job = sample_try_on(data_folder());
    job.level = 0;
    job.turntable = views;
    job.width = 16;
    job.height = 20;
    job.render.stop = {.samples_per_pixel = 4};
    job.dyes = {"white"};
    job.lamps = {"D65"};
    job.output = output;
    return job;
}

std::string refusal(const TryOn &job) {
    try {
        make_try_on_scene(job);
    } catch (const Error &error) {
        return error.problems().at(0).where;
    }
    return "accepted";
}

TEST(Turntable, TurnsAboutTheVerticalWithYarnsAndNormals) {
    const Surface flag{.position = {{1, 0, 2}, {1, 5, 3}, {2, 0, 2}},
                       .normal = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
                       .warp = {{0, 1, 0}, {0, 0, 1}, {0, 1, 0}},
                       .triangle = {{0, 1, 2}}};
    const glm::dvec3 axis(1, 7, 2);
    const Surface quarter = turned(flag, axis, kPi / 2);
    const auto expect_near = [](const auto &a, const auto &b) {
        EXPECT_LT(glm::length(glm::dvec3(a) - glm::dvec3(b)), 1e-6);
    };
    expect_near(quarter.position[0], glm::dvec3(1, 0, 2));
    expect_near(quarter.position[1], glm::dvec3(2, 5, 2)); // +z goes to +x
    expect_near(quarter.position[2], glm::dvec3(1, 0, 1)); // +x to -z
    expect_near(quarter.normal[0], glm::dvec3(1, 0, 0));
    expect_near(quarter.normal[1], glm::dvec3(0, 1, 0));
    expect_near(quarter.warp[1], glm::dvec3(1, 0, 0));
    const Surface whole =
        turned(turned(turned(quarter, axis, kPi / 2), axis, kPi / 2), axis, kPi / 2);
    for (std::size_t i = 0; i < 3; ++i)
        expect_near(whole.position[i], flag.position[i]);
    EXPECT_EQ(quarter.triangle, flag.triangle);
}

// The camera and the lights are those of the first view in all of them, and see every turn.
TEST(Turntable, KeepsTheFigureInThePicture) {
    const TryOn job = turning_job({}, 5);
    const Scene scene = make_try_on_scene(job).scene;
    glm::dvec3 lower(1e9), upper(-1e9);
    for (const glm::dvec3 &p : scene.surfaces[0].position) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    const glm::dvec3 axis = 0.5 * (lower + upper);
    for (int view = 0; view < 5; ++view)
        for (const glm::dvec3 &p : turned(scene.surfaces[0], axis, turn_of(view, 5)).position) {
            const glm::dvec3 at = project_point(scene.camera, p);
            ASSERT_GT(at.x, 0);
            ASSERT_LT(at.x, job.width);
            ASSERT_GT(at.y, 0);
            ASSERT_LT(at.y, job.height);
        }
}

TEST(Turntable, WritesEveryViewAndGoesOnWithThem) {
    const Scratch scratch;
    TryOn job = turning_job(scratch.folder(), 3);
    const TryOnResult first = run(job);
    EXPECT_EQ(first.stats.size(), 3u);
    for (const char *const name : {"white-0000.exr", "white-0002.exr", "white-D65-0001.png"})
        EXPECT_TRUE(fs::exists(scratch / name)) << name;
    EXPECT_FALSE(fs::exists(scratch / "sheet.png"));
    EXPECT_EQ(first.stats[1].prepared.objects_kept, 1u) << "the backdrop";
    EXPECT_EQ(replaced_files(job).size(), 6u);
    const auto transport = [&](const char *name) {
        return read_spectral_exr(scratch / name).transport;
    };
    const std::vector<float> front = transport("white-0000.exr"),
                             side = transport("white-0001.exr");
    EXPECT_NE(front, side);

    job.resume = true;
    EXPECT_EQ(run(job).stats.size(), 0u);
    scratch.write("white-0001.exr", "damaged");
    EXPECT_EQ(run(job).stats.size(), 1u);
    EXPECT_EQ(transport("white-0001.exr"), side);
    job.render.seed = 1;
    EXPECT_EQ(run(job).stats.size(), 3u) << "other settings";
    EXPECT_NE(transport("white-0000.exr"), front);
}

TEST(Turntable, RefusesWhatDoesNotGoTogether) {
    EXPECT_EQ(refusal(turning_job({}, 1)), "turntable");
    EXPECT_EQ(refusal(turning_job({}, 10000)), "turntable");
    TryOn moves = turning_job({}, 4), fine = turning_job({}, 4), fast = turning_job({}, 4);
    moves.frames = {moves.garment};
    EXPECT_EQ(refusal(moves), "turntable");
    fine.tolerance_px = 1;
    EXPECT_EQ(refusal(fine), "tolerance_px");
    fast.video_fps = 241;
    EXPECT_EQ(refusal(fast), "video_fps");
}

// Where programs are looked for while it lives.
class Path {
  public:
    explicit Path(const fs::path &folder, const char *more = ":/usr/bin:/bin") {
        setenv("PATH", (folder.string() + more).c_str(), 1);
    }
    ~Path() { setenv("PATH", before_.c_str(), 1); }

  private:
    std::string before_ = std::getenv("PATH");
};

TEST(Video, IsWhatFfmpegWrites) {
    const Scratch scratch;
    const fs::path program = scratch.write("ffmpeg", "#!/bin/sh\nfor last; do :; done\n"
                                                     "echo \"$@\" > \"$last\"\n");
    fs::permissions(program, fs::perms::owner_all);
    const Path path(scratch.folder());
    write_video(scratch / "50%-D65.mp4", scratch / "50%-D65", 12);
    const std::string call = read_file(scratch / "50%-D65.mp4");
    EXPECT_NE(call.find("-framerate 12 -i " + (scratch / "50%%-D65-%04d.png").string()),
              std::string::npos)
        << call;
    EXPECT_NE(call.find("libx264"), std::string::npos);
    EXPECT_EQ(scratch.file_count(), 2u) << "a temporary file was left";
}

TEST(Video, ThatCannotBeMadeIsAnError) {
    const Scratch scratch;
    const fs::path program =
        scratch.write("ffmpeg", "#!/bin/sh\necho 'Unknown encoder' >&2\necho more >&2\nexit 1\n");
    fs::permissions(program, fs::perms::owner_all);
    const auto what = [&] {
        try {
            write_video(scratch / "a.mp4", scratch / "a", 24);
        } catch (const Error &error) {
            EXPECT_EQ(error.problems().at(0).where, (scratch / "a.mp4").string());
            return error.problems().at(0).what;
        }
        return std::string("made");
    };
    {
        const Path path(scratch.folder());
        EXPECT_EQ(what(), "ffmpeg made no video: Unknown encoder");
    }
    fs::remove(program);
    const Path nowhere(scratch.folder(), "");
    const std::string missing = what();
    EXPECT_NE(missing.find("cannot be started"), std::string::npos) << missing;
    EXPECT_EQ(scratch.file_count(), 0u);
}

} // namespace
} // namespace tsuya::scene
