// Calls that would lose something of the user's, and calls that are only nearly right.
#include <gtest/gtest.h>

#include <signal.h>

#include "samples/program_run.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/sdk/file.h"

namespace tsuya::program {
namespace {

namespace fs = std::filesystem;
using scene::Scratch;

TEST(WrongCall, NoResultReplacesWhatTheCallReads) {
    const Scratch scratch;
    const fs::path fabrics = scene::data_folder() / "fabrics";
    const std::string table = (scratch / "t.csv").string();
    fs::copy_file(fabrics / "black_taffeta.csv", table);
    const std::string mesh = scratch.write("cloth.obj", scene::cloth_obj()).string();
    const std::string small = scratch.write("small.scene.toml", scene::small_scene("")).string();
    const std::string linked = (scratch / "linked.obj").string();
    fs::create_symlink("cloth.obj", linked);
    const std::string twice = (scratch / "new.exr").string();
    const std::vector<std::pair<std::string, std::vector<std::string>>> calls = {
        {table,
         {"fabric", "evaluate", (fabrics / "black_taffeta.fabric.toml").string(), "--against",
          table, "--values", table}},
        {table, {"fabric", "simulate", "polyester taffeta", "--directions", table, "-o", table}},
        {mesh, {"garment", "subdivide", mesh, "-o", linked}},
        {small, {"render", small, "-o", twice, "--stats", small}},
        {small, {"render", small, "-o", twice, "--stats", twice}}};
    for (const auto &[file, call] : calls) {
        const std::string before = read_file(file);
        const Outcome outcome = run(scratch, call);
        EXPECT_EQ(outcome.status, 2) << outcome.err;
        EXPECT_NE(outcome.err.find("it would replace the file of "), std::string::npos)
            << outcome.err;
        EXPECT_EQ(read_file(file), before) << file;
    }
    EXPECT_FALSE(fs::exists(twice));
    // The same names in texts that are no files
    EXPECT_EQ(run(scratch,
                  {"fabric", "fit", table, "--name", "f.toml", "-o", (scratch / "f.toml").string()})
                  .status,
              0);
}

TEST(WrongCall, NoResultReplacesWhatTheSceneReads) {
    const Scratch scratch;
    const std::string scene_file = write_scene(scratch);
    const std::string sky = (scratch / "sky.exr").string(), out = (scratch / "out.exr").string();
    ASSERT_EQ(run(scratch, {"render", scene_file, "-o", sky, "--spp", "1"}).status, 0);
    std::string text = scene::small_scene();
    text.replace(text.find("radiance = 0.2"), 14, "picture = \"sky.exr\"");
    scratch.write("small.scene.toml", text);
    const auto keeps = [&](const std::string &file, const std::vector<std::string> &call,
                           int status, const std::string &says) {
        const std::string before = read_file(file);
        const Outcome outcome = run(scratch, call);
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
        EXPECT_EQ(read_file(file), before) << file;
    };
    const std::string replaces = "it would replace a file of the scene";
    keeps(sky, {"render", scene_file, "-o", sky, "--spp", "1"}, 2, replaces);
    // The picture of a lamp
    const std::string lit = (scratch / "out-A.png").string();
    ASSERT_EQ(run(scratch, {"relight", sky, "--lamp", "A", "-o", lit}).status, 0);
    text.replace(text.find("sky.exr"), 7, "out-A.png");
    scratch.write("small.scene.toml", text + "[output]\nlamps = [\"A\"]\n");
    keeps(lit, {"render", scene_file, "-o", out, "--spp", "1"}, 2, replaces);
    // Statistics are JSON: no mesh, lamp, dye, table of a fabric or buffer of a mesh has their name
    const std::string lamp = scratch.write("lamp.csv", "400,1\n700,1\n").string();
    write_scene(scratch, "[output]\nlamps = [\"lamp.csv\"]\n");
    for (const std::string &file : {(scratch / "cloth.obj").string(), lamp})
        keeps(file, {"render", scene_file, "-o", out, "--stats", file, "--spp", "1"}, 1,
              "ends in .json");
    EXPECT_FALSE(fs::exists(out));
}

// Before the work, whoever calls: permissions say that root may write into /proc.
TEST(WrongInput, PlacesThatCannotBeWrittenAreToldFirst) {
    const Scratch scratch;
    const std::string scene_file = write_scene(scratch);
    const std::string table = (scene::data_folder() / "fabrics" / "black_taffeta.csv").string();
    const std::string long_name = (scratch / std::string(300, 'x')).string();
    for (const std::vector<std::string> &call : std::vector<std::vector<std::string>>{
             {"render", scene_file, "-o", "/proc/x.exr"},
             {"render", scene_file, "-o", long_name + ".exr"},
             {"render", scene_file, "-o",
              (scratch / "new").string() + "/" + std::string(300, 'x') + ".exr"},
             {"fabric", "fit", table, "-o", long_name + ".toml"},
             {"tryon", "-o", "/proc/new"}}) {
        std::vector<std::string> told = call;
        told.insert(told.end(), {"--progress", "plain"});
        const Outcome outcome = run(scratch, told);
        EXPECT_EQ(outcome.status, 1) << call.back();
        EXPECT_NE(outcome.err.find("written"), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.err.find('%'), std::string::npos) << outcome.err; // no work was begun
    }
    EXPECT_FALSE(fs::exists(scratch / "new"));
    EXPECT_EQ(scratch.file_count(), 2U); // the scene and its mesh
}

TEST(WrongCall, HelpOfACommandThatIsNotThere) {
    const Scratch scratch;
    for (const std::vector<std::string> &call : std::vector<std::vector<std::string>>{
             {"fabric", "exprot", "--help"}, {"tyron", "--help"}, {"fabric", "exprot"}}) {
        const Outcome outcome = run(scratch, call);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find("unknown command"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(run(scratch, {"fabric", "--help"}).status, 0);
}

TEST(WrongCall, RenderWithoutAPlaceForTheResult) {
    const Scratch scratch;
    const Outcome outcome =
        run(scratch, {"render", scratch.write("s.toml", scene::small_scene("")).string()});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("--output: it is missing"), std::string::npos) << outcome.err;
}

// A plan is printed of a scene that can be rendered, and of no other.
TEST(Explain, RefusesWhatARenderRefuses) {
    const Scratch scratch;
    scratch.write("cloth.obj", scene::cloth_obj());
    std::string text = scene::small_scene();
    text.replace(text.find("dye = \"crimson\""), 15, "reflectance = 0.6\ntransmittance = 0.6");
    const std::string file = scratch.write("a.scene.toml", text).string();
    const Outcome outcome = run(scratch, {"render", file, "--explain"});
    EXPECT_EQ(outcome.status, 1) << outcome.out;
    EXPECT_NE(outcome.err.find("dye and transmittance"), std::string::npos) << outcome.err;
}

// A file's name is bytes, JSON is UTF-8.
TEST(Reports, NameFilesThatAreNoUtf8) {
    const Scratch scratch;
    const fs::path fabrics = scene::data_folder() / "fabrics", table = scratch / "\xe9.csv";
    fs::copy_file(fabrics / "black_taffeta.csv", table);
    const Outcome outcome =
        run(scratch, {"fabric", "evaluate", (fabrics / "black_taffeta.fabric.toml").string(),
                      "--against", table.string(), "--json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("\xef\xbf\xbd.csv"), std::string::npos) << outcome.out;
}

// SIGUSR1 asks renders for the picture so far. Sent to any other command it ends nothing.
TEST(Signals, OtherCommandsOutliveSigusr1) {
    const Scratch scratch;
    const Outcome outcome =
        run_program({"fabric", "simulate", "polyester taffeta", "--photons", "200000", "--progress",
                     "plain", "-o", (scratch / "t.csv").string()},
                    scratch.folder(), once(SIGUSR1, "%"));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST(WrongCall, AGarmentWithoutUvIsNamedWithTheOptionThatHelps) {
    const Scratch scratch;
    const std::string mesh =
        scratch.write("bare.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").string();
    const Outcome outcome =
        run(scratch, {"tryon", "--garment", mesh, "-o", (scratch / "out").string()});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find(mesh + ": the mesh has no UV"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("(--grain)"), std::string::npos) << outcome.err;
}

TEST(WrongCall, ValuesThatAreNoneAreRefusedByTheNameThatWasTyped) {
    const Scratch scratch;
    const std::string out = (scratch / "out").string();
    const std::vector<std::pair<std::vector<std::string>, std::string>> calls = {
        {{"--lamps", "D65,,A"}, "--lamps: a value is empty; expected A,B,..."},
        {{"--lamps", "D65,"}, "--lamps: a value is empty; expected A,B,..."},
        {{"--lamps", ""}, "--lamps: a value is empty; expected A,B,..."},
        {{"--fabric", ""}, "--fabric: a value is empty; expected FABRIC"},
        {{"--spp", "1e1.5"}, "--spp: '1e1.5' is not a number; expected a whole number from 1"},
        {{"--samples=0"}, "--samples: '0' is out of range"},
        {{"--spp", "2", "--error", "0.1"}, "--spp: it cannot be given with --error"},
        {{"--grain", "nan"}, "--grain: 'nan' is no direction of the warp"},
        {{"--unit", "mile"}, "--unit: 'mile' is unknown; expected one of: m, dm, cm, mm, in"}};
    for (auto [call, says] : calls) {
        call.insert(call.begin(), {"tryon", "-o", out});
        const Outcome outcome = run(scratch, call);
        EXPECT_EQ(outcome.status, 2) << outcome.err;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
        EXPECT_FALSE(fs::exists(out));
    }
}

} // namespace
} // namespace tsuya::program
