// The program from end to end: exit status, streams, files.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "samples/program_run.h"
#include "tsuya/scene/data_folder.h"

namespace tsuya::program {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Scratch;

TEST(Program, RefusesAWrongCallWithStatus2) {
    const Scratch scratch;
    for (const std::vector<std::string> &call :
         std::vector<std::vector<std::string>>{{},
                                               {"tyron", "-o", "x"},
                                               {"tryon"},
                                               {"render", "a.toml", "--frobnicate"},
                                               {"render", "a.toml", "-o", "a.exr", "--spp", "many"},
                                               {"list", "lamp"},
                                               {"list", "lamps", "--progress", "loud"}}) {
        const Outcome wrong = run(scratch, call);
        EXPECT_EQ(wrong.status, 2) << wrong.err;
        EXPECT_EQ(wrong.out, "");
        EXPECT_EQ(wrong.err.rfind("tsuya: ", 0), 0u) << wrong.err;
    }
    const std::vector<std::pair<std::vector<std::string>, const char *>> suggestions{
        {{"tyron"}, "did you mean tryon"},
        {{"lab", "pluse"}, "did you mean pulse"},
        {{"render", "a.toml", "--spq", "3"}, "did you mean --spp"},
        {{"garment", "check", "a.obj", "--jsno"}, "did you mean --json"},
        {{"tryon", "--progres", "off"}, "did you mean --progress"}};
    for (const auto &[call, says] : suggestions) {
        const Outcome wrong = run(scratch, call);
        EXPECT_EQ(wrong.status, 2) << wrong.err;
        EXPECT_NE(wrong.err.find(says), std::string::npos) << wrong.err;
    }
}

// Where a number is asked for.
TEST(Program, RefusesNumbersThatAreNotFiniteOrNotWhole) {
    const Scratch scratch;
    const std::string exr = (scratch / "a.exr").string();
    for (const std::vector<std::string> &call : std::vector<std::vector<std::string>>{
             {"render", "a.toml", "-o", exr, "--error", "nan"},
             {"render", "a.toml", "-o", exr, "--time", "inf"},
             {"render", "a.toml", "-o", exr, "--spp", "2.5"},
             {"render", "a.toml", "-o", exr, "--spp", "1e9"},
             {"render", "a.toml", "-o", exr, "--seed", "-1"},
             {"render", "a.toml", "-o", exr, "--seed", "4294967296"},
             {"render", "a.toml", "-o", exr, "--crop", "0,0,1"},
             {"tryon", "-o", exr, "--azimuth", "NaN"},
             {"tryon", "-o", exr, "--exposure", "0x1"},
             {"tryon", "-o", exr, "--exposure", "21"},
             {"tryon", "-o", exr, "--exposure", "meter"},
             {"tryon", "-o", exr, "--error", "0"},
             {"garment", "subdivide", "a.obj", "-o", "b.obj", "--tolerance", "1e999"},
             {"lab", "pulse", "--simulate", "--width-ms", "nan"}}) {
        const Outcome wrong = run(scratch, call);
        EXPECT_EQ(wrong.status, 2) << call.back() << ' ' << wrong.err;
        EXPECT_EQ(wrong.err.rfind("tsuya: --", 0), 0u) << wrong.err;
    }
    EXPECT_EQ(run(scratch, {"lab", "pulse", "--simulate", "--json", "--count", "2e1"}).status, 0);
}

TEST(Program, LooksAtThePlaceBeforeItReads) {
    const Scratch scratch;
    const std::string folder = scratch.folder().string();
    for (const std::vector<std::string> &call : std::vector<std::vector<std::string>>{
             {"relight", "none.exr", "--lamp", "A", "-o", folder + "/n/a.gif"},
             {"compare", "none.exr", "--lamps", "A,D65", "-o", folder + "/n/a.exr"},
             {"fabric", "fit", "none.csv", "-o", folder + "/n/a.csv"},
             {"fabric", "evaluate", "none", "--against", "none.csv", "--values", folder + "/n/a"},
             {"fabric", "show", "none", "-o", folder + "/n/a.gif"},
             {"fabric", "simulate", "none.toml", "-o", folder + "/n/a.png"},
             {"garment", "subdivide", "none.obj", "-o", folder + "/n/a.stl"}}) {
        const Outcome wrong = run(scratch, call);
        EXPECT_EQ(wrong.status, 2) << wrong.err;
        EXPECT_NE(wrong.err.find("ends in ."), std::string::npos) << wrong.err;
        EXPECT_NE(wrong.err.find(folder + "/n/a"), std::string::npos) << wrong.err;
        EXPECT_EQ(scratch.file_count(), 0u);
    }
}

TEST(Program, ListsWhatCanBeNamed) {
    const Scratch scratch;
    const Outcome lamps = run(scratch, {"list", "lamps"});
    EXPECT_EQ(lamps.status, 0);
    EXPECT_EQ(lamps.err, "");
    EXPECT_NE(lamps.out.find("HP4"), std::string::npos);
    for (const char *kind : {"lamps", "fabrics", "weaves", "dyes", "models", "views", "studios"}) {
        const json list = json::parse(run(scratch, {"list", kind, "--json"}).out);
        EXPECT_EQ(list.at("schema"), "tsuya-list 1");
        EXPECT_GE(list.at("entries").size(), 1u) << kind;
    }
    const Outcome nowhere = run(scratch, {"list", "fabrics", "--data", scratch.folder().string()});
    EXPECT_EQ(nowhere.status, 1);
    EXPECT_NE(nowhere.err.find(scratch.folder().string()), std::string::npos);
}

TEST(Program, TriesTheSampleDressOn) {
    const Scratch scratch;
    const fs::path out = scratch / "new/folder";
    const Outcome done = run(scratch, {"tryon", "-o", out.string(), "--width", "40", "--height",
                                       "50", "--spp", "4", "--html"});
    ASSERT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.err, "");
    const std::vector<std::string> files = lines_of(done.out);
    EXPECT_EQ(files.size(), 10u);
    EXPECT_EQ(scratch.file_count(), files.size());
    for (const char *dye : {"white", "crimson"}) {
        const SpectralImage image = read_spectral_exr(out / (std::string(dye) + ".exr"));
        EXPECT_EQ(image.groups, (std::vector<std::string>{"key", "fill"}));
        EXPECT_EQ(image.aov_names, std::vector<std::string>{"garment"});
        for (const char *lamp : {"-D65.png", "-HP4.png", "-A.png"})
            expect_picture(out / (std::string(dye) + lamp), 40, 50);
    }
    const Image sheet = read_image(out / "sheet.png");
    EXPECT_GT(sheet.width, 3 * 40);
    EXPECT_GT(sheet.height, 2 * 50);
    // One picture for both dyes, which can be changed
    const std::string page = read_file(out / "page.html");
    EXPECT_NE(page.find("\"first_dye\":\"white\""), std::string::npos);
    EXPECT_NE(page.find("\"open\":true"), std::string::npos);
    EXPECT_EQ(page.find("id=\"planes-1\""), std::string::npos);
}

// As a shell gives them for `--frames cloth_*.obj`, or with the option said again.
TEST(Program, TakesSeveralFramesAfterOneOption) {
    const Scratch scratch;
    const std::string first = scratch.write("cloth_0.obj", scene::cloth_obj()).string();
    const std::string second = scratch.write("cloth_1.obj", scene::cloth_obj()).string();
    for (const std::vector<std::string> &frames : std::vector<std::vector<std::string>>{
             {"--frames", first, second}, {"--frames", first, "--frames", second}}) {
        std::vector<std::string> call{"tryon"};
        call.insert(call.end(), frames.begin(), frames.end());
        for (const char *word : {"--dye", "white", "--lamps", "D65", "--spp", "1", "--width", "16",
                                 "--height", "20", "-o"})
            call.push_back(word);
        call.push_back((scratch / std::to_string(frames.size())).string());
        const Outcome outcome = run(scratch, call);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_TRUE(fs::exists(fs::path(call.back()) / "white-D65-0001.png"));
        EXPECT_FALSE(fs::exists(fs::path(call.back()) / "white-D65-0002.png"));
    }
}

TEST(Program, LeavesNothingBehindWhereATryOnCannotBe) {
    const Scratch scratch;
    const std::string out = (scratch / "out").string();
    const std::vector<std::vector<std::string>> calls{{"--dye", "crimsom"},
                                                      {"--lamps", "D65,D66"},
                                                      {"--view", "Sharp"},
                                                      {"--fabric", "black_satan"},
                                                      {"--garment", "no.obj"}};
    for (std::vector<std::string> call : calls) {
        const std::string wrong = call[1].substr(call[1].find(',') + 1);
        const int status = call[0] == "--garment" ? 1 : 2;
        call.insert(call.begin(), {"tryon", "-o", out});
        const Outcome refused = run(scratch, call);
        EXPECT_EQ(refused.status, status) << refused.err;
        EXPECT_EQ(refused.out, "");
        EXPECT_NE(refused.err.find(wrong), std::string::npos) << refused.err;
        EXPECT_EQ(lines_of(refused.err).size(), 1u) << refused.err;
        EXPECT_FALSE(fs::exists(out));
    }
    const Outcome large = run(scratch, {"tryon", "-o", out + "/a/b", "--width", "32768", "--height",
                                        "32768", "--spp", "1"});
    EXPECT_EQ(large.status, 1);
    EXPECT_NE(large.err.find("159 GB of memory"), std::string::npos) << large.err;
    EXPECT_FALSE(fs::exists(out));
    scratch.write("out", "mine");
    EXPECT_EQ(run(scratch, {"tryon", "-o", out, "--width", "8", "--height", "10"}).status, 1);
    EXPECT_EQ(read_file(out), "mine");
}

// A table that never comes: the command waits for it when the signal arrives.
TEST(Program, LeavesAtOnceWhereNothingIsToBeSaved) {
    const Scratch scratch;
    const fs::path pipe = scratch / "table.csv", fabric = scratch / "f.fabric.toml";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        int writer = -1;
        const Outcome left = run_program({"fabric", "fit", pipe.string(), "-o", fabric.string()},
                                         scratch.folder(), [&](const std::string &) {
                                             if (writer >= 0)
                                                 return 0;
                                             writer = open(pipe.c_str(), O_WRONLY | O_NONBLOCK);
                                             return writer >= 0 ? signal : 0;
                                         });
        close(writer);
        EXPECT_EQ(left.status, 3) << left.err;
        EXPECT_NE(left.err.find("tsuya: interrupted"), std::string::npos) << left.err;
        EXPECT_FALSE(fs::exists(fabric));
    }
}

// Its check takes longer than the second that a command may take to stop.
TEST(Program, StopsTheCheckOfALargeMesh) {
    const Scratch scratch;
    std::string obj;
    constexpr int kSide = 600;
    for (int y = 0; y <= kSide; ++y)
        for (int x = 0; x <= kSide; ++x)
            obj += "v " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
    for (int y = 0; y < kSide; ++y)
        for (int x = 1; x <= kSide; ++x) {
            const int a = y * (kSide + 1) + x, b = a + kSide + 1;
            for (const int corner : {a, a + 1, b + 1, b})
                obj += (corner == a ? "f " : " ") + std::to_string(corner);
            obj += "\n";
        }
    const std::string mesh = scratch.write("grid.obj", obj).string();
    const Outcome stopped = run_program({"garment", "check", mesh, "--progress", "json"},
                                        scratch.folder(), once(SIGTERM, "\"garment: read\""));
    EXPECT_EQ(stopped.status, 3) << stopped.err;
    EXPECT_EQ(stopped.out, "");
}

TEST(Program, ChecksGarments) {
    const Scratch scratch;
    const std::string good = scratch.write("good.obj", scene::cloth_obj()).string();
    const std::string bad =
        scratch.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1 2 3\nf 1 2 3\n").string();
    EXPECT_EQ(run(scratch, {"garment", "check", good, "--strict"}).status, 0);
    EXPECT_EQ(run(scratch, {"garment", "check", bad}).status, 0);
    const Outcome strict = run(scratch, {"garment", "check", bad, "--strict", "--json"});
    EXPECT_EQ(strict.status, 4) << strict.err;
    const json report = json::parse(strict.out);
    EXPECT_EQ(report.at("schema"), "tsuya-garment-check 1");
    EXPECT_EQ(report.at("file").at("duplicate_faces"), 1);
    EXPECT_EQ(run(scratch, {"garment", "check", (scratch / "no.obj").string()}).status, 1);
    // A stage is as long as its unit, where that is stated, says
    const std::string stage =
        scratch.write("stage.obj", "v 0 0 0\nv 18.5 0 0\nv 18.5 0 9\nv 0 0 9\nf 1 2 3 4\n")
            .string();
    for (const char *const command : {"check", "subdivide"}) {
        const auto said = [&](std::vector<std::string> more) {
            std::vector<std::string> call{"garment", command, stage};
            if (command == std::string("subdivide"))
                call.insert(call.end(), {"--grain", "vertical", "-o", stage + ".obj"});
            call.insert(call.end(), more.begin(), more.end());
            const Outcome made = run(scratch, call);
            EXPECT_EQ(made.status, 0) << made.err;
            return made.out + made.err;
        };
        EXPECT_NE(said({}).find("measures 18.5 m at most"), std::string::npos) << said({});
        EXPECT_EQ(said({"--unit", "m"}).find("at most"), std::string::npos);
    }

    const std::string fine = (scratch / "n/fine.obj").string();
    const Outcome divided =
        run(scratch, {"garment", "subdivide", good, "-o", fine, "--level", "2"});
    ASSERT_EQ(divided.status, 0) << divided.err;
    const json report_fine = json::parse(run(scratch, {"garment", "check", fine, "--json"}).out);
    EXPECT_EQ(report_fine.at("faces"), 32);
}

// Two squares 1 mm apart along an edge: apart by the usual tolerance, joined by a larger one.
TEST(Program, SewsOverTheGapThatIsAskedFor) {
    const Scratch scratch;
    const std::string mesh =
        scratch
            .write("gap.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                              "v 1.001 0 0\nv 2 0 0\nv 2 1 0\nv 1.001 1 0\n"
                              "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                              "vt 2 0\nvt 3 0\nvt 3 1\nvt 2 1\n"
                              "g a\nf 1/1 2/2 3/3 4/4\ng b\nf 5/5 6/6 7/7 8/8\n")
            .string();
    const auto parts = [&](const std::vector<std::string> &more) {
        std::vector<std::string> call{"garment", "check", mesh, "--json"};
        call.insert(call.end(), more.begin(), more.end());
        return json::parse(run(scratch, call).out).at("parts").get<int>();
    };
    EXPECT_EQ(parts({"--sewing-tolerance", "1e-4"}), 2);
    EXPECT_EQ(parts({"--sewing-tolerance", "2e-3"}), 1);
    EXPECT_EQ(run(scratch, {"garment", "check", mesh, "--sewing-tolerance", "-1"}).status, 2);
}

TEST(Program, FitsFabrics) {
    const Scratch scratch;
    const fs::path data = scene::data_folder();
    const std::string toml = (scratch / "n/black_satin.fabric.toml").string();
    const std::string table = (data / "fabrics/black_satin.csv").string();
    const Outcome fitted =
        run(scratch, {"fabric", "fit", table, "-o", toml, "--f0", "0.0491", "--json"});
    ASSERT_EQ(fitted.status, 0) << fitted.err;
    const json report = json::parse(fitted.out);
    EXPECT_EQ(report.at("schema"), "tsuya-fabric-fit 2");
    EXPECT_LT(report.at("bard").at("rms_log10_ratio"), 0.06); // darkest views 1e-4 of the brightest
    EXPECT_GT(report.at("views").size(), 6u);
    // make_fabrics beside it remakes it where the table or the fit has changed
    EXPECT_EQ(read_file(toml), read_file(data / "fabrics/black_satin.fabric.toml"));

    const std::string none = (scratch / "m/x.fabric.toml").string();
    const std::string few =
        scratch
            .write("few.csv", "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr\n"
                              "0,0,0,0,nan\n")
            .string();
    const Outcome refused = run(scratch, {"fabric", "fit", few, "-o", none});
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find(few + ":2:9"), std::string::npos) << refused.err;
    EXPECT_FALSE(fs::exists(scratch / "m"));
}

TEST(Program, PulsesInVirtualTime) {
    const Scratch scratch;
    const Outcome pulsed = run(scratch, {"lab", "pulse", "--simulate", "--json", "--count", "3",
                                         "--width-ms", "2.5", "--lamp-line", "lamp"});
    ASSERT_EQ(pulsed.status, 0) << pulsed.err;
    const json report = json::parse(pulsed.out);
    EXPECT_EQ(report.at("schema"), "tsuya-lab-pulse 1");
    ASSERT_EQ(report.at("pulses").size(), 3u);
    EXPECT_DOUBLE_EQ(report["pulses"][1].at("opened_ms"), 100.0);
    EXPECT_DOUBLE_EQ(report["pulses"][1].at("closed_ms"), 102.5);
    EXPECT_EQ(run(scratch, {"lab", "pulse", "--simulate", "--width-ms", "0"}).status, 2);
    EXPECT_EQ(run(scratch, {"lab", "pulse", "--simulate", "--lamp-line", "shutter"}).status, 2);
    for (const char *option : {"--line", "--lamp-line"}) {
        const Outcome refused = run(scratch, {"lab", "pulse", "--simulate", option, ""});
        EXPECT_EQ(refused.status, 2);
        EXPECT_NE(refused.err.find("a value is empty"), std::string::npos) << refused.err;
    }
    EXPECT_EQ(run(scratch, {"lab", "pulse", "--simulate", "--lamp-bias", "pull-up"}).status, 2);
    EXPECT_EQ(run(scratch, {"lab", "pulse", "--simulate", "--tolerance-ms", "0"}).status, 2);
}

// A computer that runs tests may have GPIO or none; its user may be allowed to open it or not.
TEST(Program, ListsTheLinesOfThisComputer) {
    const Scratch scratch;
    const Outcome listed = run(scratch, {"lab", "lines", "--json"});
    if (listed.status != 0) {
        EXPECT_NE(listed.err.find("cannot be opened"), std::string::npos) << listed.err;
        return;
    }
    const json report = json::parse(listed.out);
    EXPECT_EQ(report.at("schema"), "tsuya-lab-lines 1");
    EXPECT_TRUE(report.at("lines").is_array());
    EXPECT_TRUE(report.at("unreadable").is_array());
}

} // namespace
} // namespace tsuya::program
