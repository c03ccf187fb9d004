// tsuya render, from end to end: pictures, checkpoints, signals.
#include <gtest/gtest.h>

#include <signal.h>
#include <stdlib.h>

#include <nlohmann/json.hpp>

#include "limited_disk.h"
#include "samples/program_run.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/sdk/plan.h"

namespace tsuya::program {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Scratch;

TEST(RenderCommand, RendersAScene) {
    const Scratch scratch;
    const std::string scene_file = write_scene(scratch, "[output]\nlamps = [\"A\"]\n");
    const fs::path exr = scratch / "new/a.exr", stats = scratch / "new/stats.json";
    const Outcome explained = run(scratch, {"render", scene_file, "--explain"});
    EXPECT_EQ(explained.status, 0) << explained.err;
    EXPECT_NE(explained.out.find("bounces"), std::string::npos);
    EXPECT_FALSE(fs::exists(scratch / "new"));

    const Outcome done =
        run(scratch, {"render", scene_file, "-o", exr.string(), "--stats", stats.string(), "--spp",
                      "6", "--channels", "8", "--aov", "depth,normal", "--progress", "json"});
    ASSERT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.out, exr.string() + "\n" + (scratch / "new/a-A.png").string() + "\n");
    int warnings = 0;
    for (const std::string &line : lines_of(done.err)) {
        if (line.starts_with("tsuya: warning: ")) {
            EXPECT_NE(line.find("fabrics.silk: 8 channels"), line.npos) << line; // crimson
            ++warnings;
            continue;
        }
        const json progress = json::parse(line);
        EXPECT_EQ(progress.at("schema"), "tsuya-progress 1");
        EXPECT_LE(progress.at("fraction"), 1.0);
    }
    EXPECT_EQ(warnings, 1) << done.err;
    EXPECT_GT(lines_of(done.err).size(), 2u);
    expect_picture(scratch / "new/a-A.png", 16, 20);
    const SpectralImage image = read_spectral_exr(exr);
    EXPECT_EQ(image.basis.count, 8);
    EXPECT_EQ(image.aov_names, (std::vector<std::string>{"depth", "normal"}));
    const json numbers = json::parse(read_file(stats));
    EXPECT_EQ(numbers.at("schema"), "tsuya-render-stats 1");
    EXPECT_EQ(numbers.at("samples_per_pixel"), 6);
    EXPECT_EQ(numbers.at("interrupted"), false);
    EXPECT_EQ(numbers.at("samples"), 6 * 16 * 20);
    std::vector<std::string> phases;
    for (const json &phase : numbers.at("phases")) {
        phases.push_back(phase.at("name"));
        EXPECT_GE(phase.at("seconds"), 0);
        EXPECT_GE(phase.at("cpu_seconds"), 0);
    }
    EXPECT_EQ(phases, (std::vector<std::string>{"load", "bvh", "tables", "trace", "write"}));
    EXPECT_GT(numbers.at("peak_memory_bytes"), 1e6);
    EXPECT_EQ(numbers.at("objects_built"), 1);
    EXPECT_EQ(numbers.at("tables_made"), 0) << "a plain diffuser has none";
    EXPECT_GT(numbers.at("skipped").size(), 0u);
    EXPECT_EQ(numbers.at("features").size(), feature_names().size());
    EXPECT_EQ(numbers.at("camera_rays"), 6 * 16 * 20);
    EXPECT_EQ(numbers.at("camera_rays").get<int>() + numbers.at("shadow_rays").get<int>() +
                  numbers.at("bounce_rays").get<int>(),
              numbers.at("rays"));
    EXPECT_FALSE(fs::exists(exr.string() + ".checkpoint"));
}

TEST(RenderCommand, ExplainsEachFeature) {
    const Scratch scratch;
    const std::string scene_file = write_scene(scratch);
    const Outcome lines = run(scratch, {"render", scene_file, "--explain", "--alpha"});
    ASSERT_EQ(lines.status, 0) << lines.err;
    EXPECT_NE(lines.out.find("\non   alpha: it is asked for\n"), std::string::npos) << lines.out;
    EXPECT_NE(lines.out.find("\noff  holes: no cloth has any; saves about "), std::string::npos);
    const Outcome machine = run(scratch, {"render", scene_file, "--explain", "--json"});
    ASSERT_EQ(machine.status, 0) << machine.err;
    const json plan = json::parse(machine.out);
    EXPECT_EQ(plan.at("schema"), "tsuya-render-plan 1");
    EXPECT_EQ(plan.at("meshes").size(), 1u);
    std::vector<std::string> names;
    for (const json &feature : plan.at("features")) {
        names.push_back(feature.at("name"));
        if (names.back() == "alpha") {
            EXPECT_EQ(feature.at("on"), false);
            EXPECT_EQ(feature.at("saves").at("bytes"), 2 * 4 * 16 * 20);
        }
    }
    EXPECT_EQ(names, feature_names());
    EXPECT_EQ(
        run(scratch, {"render", scene_file, "-o", (scratch / "a.exr").string(), "--json"}).status,
        2);
}

// The second run reads the tables that the first one made, and renders the same.
TEST(RenderCommand, KeepsTablesOnDisk) {
    const Scratch scratch;
    std::string text = read_file(write_scene(scratch));
    text.replace(text.find("dye ="), 5,
                 "file = \"" + (scene::data_folder() / "fabrics/plastic.fabric.toml").string() +
                     "\"\ndye =");
    const std::string scene_file = scratch.write("small.scene.toml", text).string();
    setenv("XDG_CACHE_HOME", (scratch / "caches").c_str(), 1);
    const auto transport = [&](const std::string &name, const std::vector<std::string> &more) {
        std::vector<std::string> call{"render", scene_file, "-o", (scratch / name).string()};
        call.insert(call.end(), more.begin(), more.end());
        const Outcome outcome = run(scratch, call);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return read_spectral_exr(scratch / name).transport;
    };
    const std::vector<float> first = transport("a.exr", {"--no-cache"});
    EXPECT_FALSE(fs::exists(scratch / "caches"));
    EXPECT_EQ(transport("b.exr", {}), first);
    const auto files = fs::directory_iterator(scratch / "caches/tsuya");
    const fs::path file = files->path();
    const fs::file_time_type made = fs::last_write_time(file) - std::chrono::hours(1);
    fs::last_write_time(file, made);
    EXPECT_EQ(transport("c.exr", {}), first);
    EXPECT_GT(fs::last_write_time(file), made) << "it was not read";
    unsetenv("XDG_CACHE_HOME");
}

TEST(RenderCommand, LeavesAllButGarmentAndBodyOut) {
    const Scratch scratch;
    const std::string scene_file =
        write_scene(scratch, "[backdrop]\n[output]\nlamps = [\"A\"]\nexposure = \"metered\"\n");
    const fs::path exr = scratch / "a.exr", sheet = scratch / "aovs.png";
    const Outcome done = run(scratch, {"render", scene_file, "-o", exr.string(), "--alpha", "--aov",
                                       "depth,CryptoObject", "--crop", "2,3,16,18"});
    ASSERT_EQ(done.status, 0) << done.err;
    const SpectralImage image = read_spectral_exr(exr);
    ASSERT_TRUE(image.alpha);
    EXPECT_EQ(image.data_window, (std::array{2, 3, 16, 18}));
    EXPECT_EQ(image.aov_names, (std::vector<std::string>{"depth", "CryptoObject", "garment"}));
    EXPECT_EQ(*image.alpha->pixel(15, 4), 0);
    EXPECT_EQ(*image.alpha->pixel(8, 10), 1);
    EXPECT_EQ(image.pixel(0, 15, 4)[0] + image.pixel(1, 15, 4)[0], 0);
    expect_picture(scratch / "a-A.png", 16, 20);
    EXPECT_EQ(read_image(scratch / "a-A.png").channels.size(), 4u);

    const Outcome drawn =
        run(scratch, {"aovs", exr.string(), "-o", sheet.string(), "--columns", "2"});
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_EQ(drawn.out, sheet.string() + "\n");
    EXPECT_GT(read_image(sheet).height, 2 * 20);
    ASSERT_EQ(run(scratch, {"render", scene_file, "-o", exr.string()}).status, 0);
    EXPECT_EQ(run(scratch, {"aovs", exr.string(), "-o", sheet.string()}).status, 0)
        << "the metered exposure needs the AOV of the garment";
    const std::string plain = write_scene(scratch);
    ASSERT_EQ(run(scratch, {"render", plain, "-o", exr.string()}).status, 0);
    const Outcome none = run(scratch, {"aovs", exr.string(), "-o", sheet.string()});
    EXPECT_EQ(none.status, 1);
    EXPECT_NE(none.err.find("no AOVs"), std::string::npos) << none.err;
}

TEST(RenderCommand, RendersFramesAndGoesOnWithThem) {
    const Scratch scratch;
    const std::string scene_file = write_scene(scratch, "[output]\nlamps = [\"A\"]\n");
    std::string text = read_file(scene_file), moved = scene::cloth_obj();
    moved.replace(moved.find("0.6 0\n"), 5, "0.6 0.2");
    scratch.write("moved.obj", moved);
    text.insert(text.find("fabric = \"silk\""), "frames = [\"moved.obj\"]\n");
    // Without an eye the camera depends on all frames
    text.insert(text.find("width"), "eye = [0, 0.3, 2]\ntarget = [0, 0.3, 0]\n");
    scratch.write("small.scene.toml", text);
    const std::vector<std::string> call{
        "render",   scene_file, "-o",      (scratch / "a.exr").string(),
        "--frames", "2",        "--stats", (scratch / "s.json").string()};
    const Outcome done = run(scratch, call);
    ASSERT_EQ(done.status, 0) << done.err;
    std::string all;
    for (const char *const name : {"a-0000.exr", "a-A-0000.png", "a-0001.exr", "a-A-0001.png"})
        all += (scratch / name).string() + "\n";
    EXPECT_EQ(done.out, all);
    EXPECT_NE(read_spectral_exr(scratch / "a-0000.exr").transport,
              read_spectral_exr(scratch / "a-0001.exr").transport);
    EXPECT_TRUE(fs::exists(scratch / "s-0001.json"));
    EXPECT_FALSE(fs::exists(scratch / "a.exr"));

    // What is there is kept, what is missing or of another scene or settings is rendered again
    std::vector<std::string> again = call;
    again.emplace_back("--resume");
    EXPECT_EQ(run(scratch, again).out, "");
    const std::string second = read_file(scratch / "a-A-0001.png");
    fs::remove(scratch / "a-A-0001.png");
    EXPECT_EQ(run(scratch, again).out, all.substr(all.find((scratch / "a-0001.exr").string())));
    EXPECT_EQ(read_file(scratch / "a-A-0001.png"), second);
    moved.replace(moved.find("0.6 0.2"), 7, "0.6 0.1");
    scratch.write("moved.obj", moved);
    EXPECT_EQ(run(scratch, again).out, all.substr(all.find((scratch / "a-0001.exr").string())));
    std::vector<std::string> other = again;
    for (const char *const option : {"--spp", "--seed"}) {
        other.insert(other.end(), {option, "5"});
        EXPECT_EQ(run(scratch, other).out, all) << option;
        EXPECT_EQ(run(scratch, other).out, "") << option;
    }

    const Outcome more =
        run(scratch, {"render", scene_file, "-o", (scratch / "b.exr").string(), "--frames", "3"});
    EXPECT_EQ(more.status, 1);
    EXPECT_NE(more.err.find("cloth has 2 frames"), std::string::npos) << more.err;
}

TEST(RenderCommand, PlacesWhatIsWrongInAScene) {
    const Scratch scratch;
    const std::string scene_file = write_scene(scratch, "sample = 3\n");
    const Outcome wrong =
        run(scratch, {"render", scene_file, "-o", (scratch / "n/a.exr").string()});
    EXPECT_EQ(wrong.status, 1);
    EXPECT_EQ(wrong.err.rfind("tsuya: " + scene_file + ":17:1: unknown key 'sample'", 0), 0u)
        << wrong.err;
    EXPECT_FALSE(fs::exists(scratch / "n"));
}

TEST(RenderCommand, RefusesPlacesBeforeItRenders) {
    const Scratch scratch;
    const std::string scene_file = write_scene(scratch);
    fs::create_directories(scratch / "folder.exr");
    const std::size_t before = scratch.file_count();
    for (const char *name : {"folder.exr", "cloth.obj/a.exr"}) {
        const Outcome wrong = run(scratch, {"render", scene_file, "-o", (scratch / name).string()});
        EXPECT_EQ(wrong.status, 1) << name;
        EXPECT_NE(wrong.err.find(scratch.folder().string()), std::string::npos) << wrong.err;
    }
    const Outcome outside = run(
        scratch, {"render", scene_file, "-o", (scratch / "a.exr").string(), "--crop", "0,0,17,20"});
    EXPECT_EQ(outside.status, 1);
    EXPECT_NE(outside.err.find("16 x 20"), std::string::npos) << outside.err;
    EXPECT_EQ(scratch.file_count(), before);
}

TEST(RenderCommand, ResumesAnInterruptedRenderBitIdentically) {
    const Scratch scratch;
    const std::string scene_file = write_scene(scratch);
    const std::string whole = (scratch / "whole.exr").string(),
                      parts = (scratch / "parts.exr").string();
    const auto call = [&](const std::string &out) {
        return std::vector<std::string>{"render", scene_file, "-o",         out,
                                        "--spp",  "32768",    "--progress", "json"};
    };
    SpectralImage partial;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) { // each goes on from the one before
        std::vector<std::string> next = call(parts);
        if (signal != SIGINT)
            next.push_back("--resume");
        const Outcome interrupted = run_program(next, scratch.folder(), once(signal, "\"render\""));
        ASSERT_EQ(interrupted.status, 3) << interrupted.err;
        EXPECT_NE(interrupted.err.find("--resume"), std::string::npos);
        EXPECT_EQ(interrupted.out, parts + "\n");
        ASSERT_TRUE(fs::exists(parts + ".checkpoint"));
        partial = read_spectral_exr(parts);
    }

    std::vector<std::string> resume = call(parts);
    resume.push_back("--resume");
    const Outcome resumed = run(scratch, resume);
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_FALSE(fs::exists(parts + ".checkpoint"));
    ASSERT_EQ(run(scratch, call(whole)).status, 0);
    const SpectralImage expected = read_spectral_exr(whole);
    EXPECT_EQ(read_spectral_exr(parts).transport, expected.transport);
    EXPECT_NE(partial.transport, expected.transport); // or nothing was interrupted
}

TEST(RenderCommand, ResumesAKilledRenderBitIdentically) {
    const Scratch scratch;
    const std::string scene_file = write_scene(scratch);
    const fs::path exr = scratch / "a.exr", checkpoint = exr.string() + ".checkpoint";
    std::vector<std::string> call{"render", scene_file, "-o", exr.string(), "--spp", "8192"};
    call.insert(call.end(), {"--checkpoint-every", "0.1"});
    const Outcome killed = run_program(call, scratch.folder(), [&](const std::string &) {
        return fs::exists(checkpoint) ? SIGKILL : 0;
    });
    ASSERT_EQ(killed.status, -1) << killed.err;
    EXPECT_FALSE(fs::exists(exr));

    call.push_back("--resume");
    const Outcome resumed = run(scratch, call);
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(resumed.err, "");
    EXPECT_FALSE(fs::exists(checkpoint));
    const SpectralImage in_parts = read_spectral_exr(exr);
    const std::string whole = (scratch / "whole.exr").string();
    ASSERT_EQ(run(scratch, {"render", scene_file, "-o", whole, "--spp", "8192"}).status, 0);
    EXPECT_EQ(in_parts.transport, read_spectral_exr(whole).transport);
}

TEST(RenderCommand, WritesThePictureSoFarAtSIGUSR1AndGoesOn) {
    const Scratch scratch;
    const std::string scene_file = write_scene(scratch), exr = (scratch / "a.exr").string();
    SpectralImage so_far;
    const auto ask = once(SIGUSR1, "\"render\"");
    const Outcome done =
        run_program({"render", scene_file, "-o", exr, "--spp", "16384", "--progress", "json"},
                    scratch.folder(), [&](const std::string &err) {
                        if (so_far.transport.empty() && fs::exists(exr))
                            so_far = read_spectral_exr(exr);
                        return ask(err);
                    });
    ASSERT_EQ(done.status, 0) << done.err;
    const std::string whole = (scratch / "whole.exr").string();
    ASSERT_EQ(run(scratch, {"render", scene_file, "-o", whole, "--spp", "16384"}).status, 0);
    const SpectralImage expected = read_spectral_exr(whole);
    EXPECT_EQ(read_spectral_exr(exr).transport, expected.transport);
    ASSERT_EQ(so_far.transport.size(), expected.transport.size());
    EXPECT_NE(so_far.transport, expected.transport); // or it was the picture at the end
}

// A picture that cannot be written costs nothing: its checkpoint stays.
TEST(RenderCommand, KeepsTheCheckpointOfAPictureThatCannotBeWritten) {
    const Scratch scratch;
    const std::string scene_file = write_scene(scratch);
    const std::string exr = (scratch / "a.exr").string(), checkpoint = exr + ".checkpoint";
    std::vector<std::string> call{"render", scene_file, "-o", exr, "--spp", "16384"};
    call.insert(call.end(), {"--progress", "json"});
    const Outcome interrupted = run_program(call, scratch.folder(), once(SIGINT, "\"render\""));
    ASSERT_EQ(interrupted.status, 3) << interrupted.err;
    call.back() = "off"; // stderr is a file here
    call.push_back("--resume");
    {
        const test::FileSizeLimit limit(2000);
        const Outcome failed = run(scratch, call);
        EXPECT_EQ(failed.status, 1);
        EXPECT_NE(failed.err.find("of this size"), std::string::npos) << failed.err;
    }
    ASSERT_TRUE(fs::exists(checkpoint));
    EXPECT_EQ(run(scratch, call).status, 0);
    EXPECT_FALSE(fs::exists(checkpoint));
}

} // namespace
} // namespace tsuya::program
