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
        keeps(file, {"render", scene_file, "-o", out, "--stats", file, "--spp", "1"}, 2,
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

// As the places: in an installation without its folder lib/tsuya.
TEST(WrongInput, TheModuleForPicturesIsTriedFirst) {
    const Scratch scratch;
    const std::string scene_file = write_scene(scratch);
    scratch.write("libtsuya_picture_writer.so", "");
    const char *const before = std::getenv("LD_LIBRARY_PATH");
    const std::string saved = before ? before : "";
    setenv("LD_LIBRARY_PATH", scratch.folder().c_str(), 1);
    for (const std::vector<std::string> &call : std::vector<std::vector<std::string>>{
             {"render", scene_file, "-o", (scratch / "a.exr").string(), "--progress", "plain"},
             {"fabric", "show", "--weave", "polyester taffeta", "--size", "64", "-o",
              (scratch / "weave.png").string(), "--progress", "plain"},
             {"tryon", "-o", (scratch / "new").string(), "--progress", "plain"}}) {
        const Outcome outcome = run(scratch, call);
        EXPECT_EQ(outcome.status, 1) << call.front();
        EXPECT_NE(outcome.err.find("the module for pictures cannot be loaded"), std::string::npos)
            << outcome.err;
        EXPECT_EQ(outcome.err.find('%'), std::string::npos) << outcome.err; // no work was begun
    }
    before ? setenv("LD_LIBRARY_PATH", saved.c_str(), 1) : unsetenv("LD_LIBRARY_PATH");
    EXPECT_FALSE(fs::exists(scratch / "new"));
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

TEST(WrongCall, NoResultReplacesWhatTheTryOnReads) {
    const Scratch scratch;
    const std::string mesh = scratch.write("cloth.obj", scene::cloth_obj()).string();
    const std::string out = (scratch / "o").string();
    fs::create_directories(out);
    const auto refuses = [&](const fs::path &file, const std::vector<std::string> &more) {
        const std::string before = read_file(file);
        std::vector<std::string> call{"tryon",   "--garment", mesh,    "--dye", "white",
                                      "--lamps", "A",         "--spp", "1",     "--width",
                                      "16",      "--height",  "20",    "-o",    out};
        call.insert(call.end(), more.begin(), more.end());
        const Outcome outcome = run(scratch, call);
        EXPECT_EQ(outcome.status, 2) << file << outcome.err;
        EXPECT_NE(outcome.err.find("it would replace " + file.string()), std::string::npos)
            << outcome.err;
        EXPECT_EQ(read_file(file), before) << file;
    };
    Image image = Image::make(2, 2, {"R", "G", "B"});
    for (const char *name : {"sheet.png", "white-A.png"}) {
        const fs::path picture = fs::path(out) / name;
        write_png(picture, image);
        refuses(picture, {"--pattern", picture.string()});
    }
    const fs::path numbered = fs::path(out) / "white-A-0001.png";
    write_png(numbered, image);
    refuses(numbered, {"--frames", mesh, "--pattern", numbered.string()});
    // By another name
    const std::string fabric =
        scratch
            .write("f.fabric.toml",
                   read_file(scene::data_folder() / "fabrics" / "black_taffeta.fabric.toml"))
            .string();
    fs::create_symlink(fabric, fs::path(out) / "white.exr");
    refuses(fabric, {"--fabric", fabric});
    const std::string body = scratch.write("body.obj", scene::cloth_obj()).string();
    fs::remove(fs::path(out) / "white.exr");
    fs::create_hard_link(body, fs::path(out) / "white.exr");
    refuses(body, {"--body", body});
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
        {{"--fabric", ""}, "--fabric: a value is empty; expected [PANELS=]FABRIC"},
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

// What no input could make right is a wrong call, told at the option, before anything is read.
TEST(WrongCall, ValuesThatNoInputCouldMakeRight) {
    const Scratch scratch;
    const auto file = [&](const char *name) { return (scratch / name).string(); };
    const std::string exr = file("a.exr"), png = file("a.png"), svg = file("a.svg"),
                      csv = file("a.csv");
    const std::vector<std::pair<std::vector<std::string>, std::string>> calls = {
        {{"tryon", "-o", exr, "--dye", "crimsom"}, "--dye: there is no dye 'crimsom'"},
        {{"tryon", "-o", exr, "--dye", "#12345"}, "--dye: '#12345' is not an sRGB colour"},
        {{"tryon", "-o", exr, "--dye", "black,black"}, "--dye: two dyes have the name 'black'"},
        {{"tryon", "-o", exr, "--dye", "crimson,CRIMSON"},
         "--dye: two dyes have the name 'CRIMSON': crimson and CRIMSON"},
        {{"tryon", "-o", exr, "--lamps", "D66"}, "--lamps: there is no lamp 'D66'"},
        {{"tryon", "-o", exr, "--lamps", "A,A"}, "--lamps: two lamps have the name 'A'"},
        {{"tryon", "-o", exr, "--fabric", "black_satan"}, "--fabric: no sample fabric"},
        {{"tryon", "-o", exr, "--view", "Sharp"}, "--view: there is no view 'Sharp'"},
        {{"tryon", "-o", exr, "--adapt", "cat03"}, "--adapt: 'cat03' is unknown"},
        {{"tryon", "-o", exr, "--body", "b.obj"}, "--body: a body without a garment"},
        {{"render", "s.toml", "-o", exr, "--crop", "0,0,0,0"}, "--crop: there is no pixel in it"},
        {{"render", "s.toml", "-o", exr, "--crop", "-1,0,4,4"}, "--crop: '-1' is out of range"},
        {{"render", "s.toml", "-o", png}, "--output: files of type '.png' are not written"},
        {{"relight", exr, "--lamp", "D66", "-o", png}, "--lamp: there is no lamp 'D66'"},
        {{"relight", exr, "--lamp", "key=D66", "-o", png}, "--lamp: there is no lamp 'D66'"},
        {{"relight", exr, "--lamp", "=A", "-o", png}, "--lamp: '=A' names no light group"},
        {{"relight", exr, "--lamp", "A", "--lamp", "E", "-o", png}, "--lamp: two lamps for all"},
        {{"relight", exr, "--lamp", "own", "--lamp", "A", "-o", png}, "--lamp: two lamps for all"},
        {{"relight", exr, "--lamp", "lightbox-usa", "-o", png},
         "--lamp: 'lightbox-usa' is a set of lamps"},
        {{"relight", exr, "--lamp", "A", "--display", "P3", "-o", png},
         "--display: there is no display 'P3'"},
        {{"relight", exr, "--lamp", "A", "--degree", "2", "-o", png}, "--degree: '2' is out of"},
        {{"relight", exr, "--lamp", "A", "--bits", "16", "-o", exr + ".exr"},
         "--bits: an EXR has 32 bits a sample"},
        {{"compare", exr, "--lamps", "A", "-o", png},
         "--lamps: one lamp is named; expected two or more"},
        {{"compare", exr, "--lamps", "A,E"}, "--output: nothing is asked for"},
        {{"fabric", "simulate", "satan 5", "-o", csv}, "WEAVE: unknown weave \"satan 5\""},
        {{"fabric", "simulate", "w.toml", "-o", csv, "--directions", "papr"},
         "--directions: 'papr' is unknown; expected one of: normal, paper; did you mean paper?; or "
         "a file"},
        {{"fabric", "simulate", "w.toml", "-o", csv, "--directions", "t.csv", "--step", "5"},
         "--step: it has no meaning for the directions of a table"},
        {{"fabric", "evaluate", "f.toml", "--against", csv, "--model", "takedo"},
         "--model: 'takedo' is unknown"},
        {{"fabric", "evaluate", "f.toml", "--against", csv, "--part", "body"},
         "--part: the coloured part is compared for no reflectance"},
        {{"fabric", "show", "f.toml", "-o", svg, "--model", "takedo"},
         "--model: 'takedo' is unknown"},
        {{"fabric", "show", "f.toml", "-o", svg, "--model", "yarn,ggx"},
         "--model: several names have no effect on --view lobes; expected --view rings"},
        {{"fabric", "show", "f.toml", "-o", svg, "--theta-i", "20"},
         "--theta-i: it has no effect on --view lobes; expected --view rings"},
        {{"fabric", "show", "--weave", "satan 5", "-o", png}, "--weave: unknown weave"},
        {{"lab", "plan", "r.toml", "-o", file("p.jsonl"), "--views", "few:0"},
         "--views: 'few:0' is no set of views"},
        {{"lab", "plan", "r.toml", "-o", file("p.jsonl"), "--views", "papers"},
         "--views: 'papers' is no set of views, and no file"},
        {{"lab", "pulse", "--simulate", "--width-ms", "0"}, "--width-ms: '0' is out of range"},
        {{"lab", "pulse", "--simulate", "--width-ms", "200"},
         "--period-ms: it is 100.000000 ms; expected more than the width of 200.000000 ms"},
        {{"lab", "pulse", "--simulate", "--warm-up-ms", "1e9"}, "--warm-up-ms: '1e9' is out of"},
        {{"lab", "pulse", "--simulate", "--lamp-line", "shutter"},
         "--lamp-line: lamp and shutter are the same line"},
        {{"lab", "measure", "s", "-o", csv, "--repeat-mm", "0,1"}, "--repeat-mm: '0' is out of"}};
    for (const auto &[call, says] : calls) {
        const Outcome outcome = run(scratch, call);
        EXPECT_EQ(outcome.status, 2) << outcome.err;
        EXPECT_EQ(outcome.err.rfind("tsuya: " + says, 0), 0u) << outcome.err;
        EXPECT_EQ(scratch.file_count(), 0u);
    }
}

// What is wrong with what stands in a file, or with a file, is the input's fault.
TEST(WrongInput, AMeshWithoutAFaceIsNamed) {
    const Scratch scratch;
    const std::string mesh =
        scratch.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 1\n").string();
    const Outcome outcome = run(scratch, {"garment", "check", mesh});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err.rfind("tsuya: " + mesh + ": no face is left", 0), 0u) << outcome.err;
}

TEST(WrongInput, FilesThatAreNotThere) {
    const Scratch scratch;
    const auto file = [&](const char *name) { return (scratch / name).string(); };
    for (const std::vector<std::string> &call : std::vector<std::vector<std::string>>{
             {"tryon", "-o", file("out"), "--dye", "none.csv"},
             {"tryon", "-o", file("out"), "--lamps", "none.csv"},
             {"tryon", "-o", file("out"), "--fabric", "none.fabric.toml"},
             {"fabric", "simulate", "none.wif", "-o", file("a.csv")},
             {"fabric", "simulate", "polyester taffeta", "--directions", "none.csv", "-o",
              file("a.csv")},
             {"lab", "plan", TSUYA_RIG_SAMPLE, "--views", "none.csv", "-o", file("a.jsonl")}}) {
        const Outcome outcome = run(scratch, call);
        EXPECT_EQ(outcome.status, 1) << outcome.err;
        EXPECT_EQ(scratch.file_count(), 0u) << outcome.err;
    }
}

} // namespace
} // namespace tsuya::program
