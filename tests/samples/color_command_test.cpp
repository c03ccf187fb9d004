// relight, compare and list config from end to end.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "samples/program_run.h"
#include "tsuya/color/difference.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/measured_spectrum.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/srgb.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/sdk/file.h"

namespace tsuya::program {
namespace {

using nlohmann::json;
using scene::Scratch;

TEST(Program, RelightsAndCompares) {
    const Scratch scratch;
    const std::string exr = (scratch / "a.exr").string();
    ASSERT_EQ(run(scratch, {"render", write_scene(scratch), "-o", exr}).status, 0);
    const std::string png = (scratch / "p/a.png").string();
    const Outcome relit = run(scratch, {"relight", exr, "--lamp", "key=A", "--lamp", "fill=D65",
                                        "-o", png, "--adapt", "cat02", "--exposure", "1"});
    ASSERT_EQ(relit.status, 0) << relit.err;
    EXPECT_EQ(relit.out, png + "\n");
    expect_picture(png, 16, 20);
    EXPECT_EQ(run(scratch, {"relight", exr, "--lamp", "rim=A", "-o", png}).status, 1);
    EXPECT_EQ(run(scratch, {"relight", png, "--lamp", "A", "-o", png + ".png"}).status, 1);

    const Outcome metered =
        run(scratch, {"relight", exr, "--lamp", "D65", "-o", png, "--exposure", "metered"});
    EXPECT_EQ(metered.status, 0) << metered.err;

    const std::string sheet = (scratch / "sheet.png").string(),
                      report = (scratch / "report.json").string();
    const Outcome compared = run(scratch, {"compare", exr, "--lamps", "D65,A,HP4", "-o", sheet,
                                           "--report", report, "--exposure", "metered"});
    ASSERT_EQ(compared.status, 0) << compared.err;
    EXPECT_NE(compared.out.find("CIEDE2000"), std::string::npos);
    const json numbers = json::parse(read_file(report));
    EXPECT_EQ(numbers.at("schema"), "tsuya-compare 2");
    ASSERT_EQ(numbers.at("differences").size(), 3u);
    EXPECT_GT(numbers["differences"][0].at("mean"), 0.1);
    EXPECT_GT(read_image(sheet).width, 3 * 16);
    EXPECT_NE(compared.out.find(sheet + ": at most "), std::string::npos) << compared.out;
    EXPECT_EQ(numbers.at("observer_deg"), 10);
    const json &part = numbers.at("parts").at(0);
    EXPECT_EQ(part.at("kind"), "garment");
    ASSERT_EQ(part.at("observers").size(), 2u);
    EXPECT_EQ(part["observers"][0].at("observer_deg"), 10);
    const json &change = part["observers"][0].at("changes").at(0);
    EXPECT_EQ(change.at("test"), "A");
    EXPECT_GT(change.at("cmccon02"), 0.1);
    EXPECT_LE(change.at("cmccon02_over_angle").at("p5"), change["cmccon02_over_angle"].at("p95"));
}

TEST(Program, ReportsFabricsAndPanels) {
    const Scratch scratch;
    const std::string exr = (scratch / "a.exr").string(), other = (scratch / "b.exr").string();
    const std::string scene = write_scene(scratch);
    for (const std::string &file : {exr, other})
        ASSERT_EQ(
            run(scratch, {"render", scene, "-o", file, "--aov", "CryptoFabric,CryptoPanel"}).status,
            0);
    const auto report = [&](const char *name) {
        const std::string file = (scratch / name).string();
        const Outcome made = run(scratch, {"compare", exr, other, "--lamps", "D65,A", "--report",
                                           file, "--observer", "2"});
        EXPECT_EQ(made.status, 0) << made.err;
        return read_file(file);
    };
    const json numbers = json::parse(report("r.json"));
    std::set<std::string> kinds;
    for (const json &part : numbers.at("parts"))
        kinds.insert(part.at("kind"));
    EXPECT_EQ(kinds, (std::set<std::string>{"garment", "fabric", "panel"}));
    // Both pictures are of one cloth: nothing parts them.
    ASSERT_EQ(numbers.at("pairs").size(), 2u); // one an observer
    EXPECT_LT(numbers["pairs"][0].at("metamerism").at(0).at("multiplicative"), 1e-3);
    EXPECT_LT(numbers["pairs"][0].at("matches").at(1).at("cmc_2_1"), 1e-3);
    const std::vector<std::string> rows = lines_of(report("r.csv"));
    EXPECT_EQ(rows.at(0).rfind("picture,dye,kind,name,", 0), 0u);
    for (const std::string &row : rows)
        EXPECT_EQ(std::count(row.begin(), row.end(), ','), 16) << row;
    const std::string text = report("r.txt");
    for (const char *part : {"CMCCON02", "metamerism: multiplicative", "fabric silk", "a, "})
        EXPECT_NE(text.find(part), std::string::npos) << part << text;
}

// A metered exposure, which other pictures change, is for the sheet alone.
TEST(Program, FiguresHaveTheExposureThatIsStated) {
    const Scratch scratch;
    const std::string exr = (scratch / "a.exr").string();
    const std::string scene = write_scene(scratch);
    ASSERT_EQ(run(scratch, {"render", scene, "-o", exr}).status, 0);
    const auto report = [&](const std::string &name, const char *exposure) {
        const std::string file = (scratch / name).string();
        const Outcome made = run(scratch, {"compare", exr, "--lamps", "D65,A", "--report", file,
                                           "--exposure", exposure});
        EXPECT_EQ(made.status, 0) << made.err;
        return read_file(file);
    };
    const json metered = json::parse(report("m.json", "metered")),
               plain = json::parse(report("p.json", "0")),
               brighter = json::parse(report("b.json", "1"));
    EXPECT_EQ(metered, plain);
    EXPECT_EQ(metered.at("exposure_stops"), 0);
    EXPECT_EQ(brighter.at("exposure_stops"), 1);
    const auto lightness = [](const json &numbers) -> double {
        return numbers.at("parts").at(0).at("observers").at(0).at("colors").at(0).at("lab").at(0);
    };
    // L* + 16 goes with the cube root of Y.
    EXPECT_NEAR(lightness(brighter) + 16, std::cbrt(2.0) * (lightness(plain) + 16), 1e-6);
    EXPECT_NE(report("m.txt", "metered").find("L* = 100 is Y = 1;"), std::string::npos);
    EXPECT_NE(report("b.txt", "1").find("L* = 100 is Y = 1 after the exposure (stops: 1);"),
              std::string::npos);
}

// Two files of one name are called by their paths; one file twice is no comparison.
TEST(Program, ComparesFilesOfOneName) {
    const Scratch scratch;
    const std::string first = (scratch / "satin/a.exr").string(),
                      second = (scratch / "taffeta/a.exr").string(),
                      third = (scratch / "b.exr").string();
    ASSERT_EQ(run(scratch, {"render", write_scene(scratch), "-o", first}).status, 0);
    std::filesystem::create_directories(scratch / "taffeta");
    write_file(second, read_file(first));
    write_file(third, read_file(first));
    const std::string report = (scratch / "r.json").string(),
                      sheet = (scratch / "sheet.png").string();
    const Outcome made = run(scratch, {"compare", first, second, third, "--lamps", "D65,A",
                                       "--report", report, "-o", sheet});
    ASSERT_EQ(made.status, 0) << made.err;
    std::vector<std::string> pictures;
    const json numbers = json::parse(read_file(report));
    for (const json &part : numbers.at("parts"))
        pictures.push_back(part.at("picture"));
    EXPECT_EQ(pictures, (std::vector<std::string>{first, second, "b"}));
    // Swatches of its own part in each row, so that all rows are as high as those of one picture
    const int high = read_image(sheet).height;
    ASSERT_EQ(run(scratch, {"compare", first, "--lamps", "D65,A", "-o", sheet}).status, 0);
    EXPECT_LE(high, 3 * read_image(sheet).height);
    for (const std::string &again : {first, (scratch / "satin/../satin/a.exr").string()}) {
        const Outcome twice =
            run(scratch, {"compare", first, again, "--lamps", "D65,A", "-o", sheet});
        EXPECT_EQ(twice.status, 2);
        EXPECT_NE(twice.err.find("is given twice; expected each picture once"), std::string::npos)
            << twice.err;
    }
}

// A line shines: it is on sheet and report, and has no differences, because no eye adapts to it.
TEST(Program, ComparesALine) {
    const Scratch scratch;
    const std::string exr = (scratch / "a.exr").string(), report = (scratch / "r.json").string(),
                      sheet = (scratch / "sheet.png").string();
    ASSERT_EQ(run(scratch, {"render", write_scene(scratch), "-o", exr}).status, 0);
    const std::string line = scratch.write("laser650.csv", "649,0\n650,1\n651,0\n").string();
    const auto compared = [&](const std::string &lamps) {
        const Outcome made =
            run(scratch, {"compare", exr, "--lamps", lamps, "-o", sheet, "--report", report});
        EXPECT_EQ(made.status, 0) << made.err;
        EXPECT_NE(made.err.find("no eye adapts to the lamp 'laser650'"), std::string::npos)
            << made.err;
        return std::pair(made.out, json::parse(read_file(report)));
    };
    const auto [alone, none] = compared("D65," + line);
    EXPECT_EQ(none.at("differences").size(), 0u);
    EXPECT_EQ(alone.find("CIEDE2000"), std::string::npos) << alone;
    EXPECT_EQ(none.at("lamps").size(), 2u);
    const auto [table, numbers] = compared("D65," + line + ",A");
    ASSERT_EQ(numbers.at("differences").size(), 1u);
    EXPECT_EQ(numbers["differences"][0].at("second"), "A");
}

TEST(Program, RelightsIntoEveryFormat) {
    const Scratch scratch;
    const std::string exr = (scratch / "a.exr").string();
    ASSERT_EQ(run(scratch, {"render", write_scene(scratch), "-o", exr}).status, 0);
    const auto made = [&](const char *name, std::vector<std::string> more) {
        std::vector<std::string> call{"relight", exr,  "--lamp",
                                      "D65",     "-o", (scratch / name).string()};
        call.insert(call.end(), more.begin(), more.end());
        const Outcome outcome = run(scratch, call);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return read_image(scratch / name);
    };
    const Image png = made("p.png", {"--view", "Plain"}),
                tiff = made("p.tif", {"--view", "Plain", "--bits", "16"}),
                linear = made("p.exr", {});
    ASSERT_EQ(linear.channels, (std::vector<std::string>{"R", "G", "B"}));
    for (std::size_t i = 0; i < png.data.size(); ++i) {
        ASSERT_NEAR(png.data[i], tiff.data[i], 0.6 / 255) << i;
        ASSERT_NEAR(tiff.data[i], std::clamp(srgb_encode(linear.data[i]), 0.0, 1.0), 1e-4) << i;
    }
    made("p.jpg", {});
    made("wide.png", {"--display", "Display P3"});
    made("pq.png", {"--display", "Rec.2100-PQ", "--bits", "16"});
    const auto status = [&](std::vector<std::string> more) {
        std::vector<std::string> call{"relight", exr, "--lamp", "D65", "-o"};
        call.insert(call.end(), more.begin(), more.end());
        return run(scratch, call).status;
    };
    EXPECT_EQ(status({(scratch / "x.jpg").string(), "--bits", "16"}), 2);
    EXPECT_EQ(status({(scratch / "x.tif").string(), "--display", "Rec.2100-PQ"}), 2);
    EXPECT_EQ(status({(scratch / "x.png").string(), "--display", "P3"}), 2);
    EXPECT_EQ(status({(scratch / "x.png").string(), "--ocio", "none.ocio"}), 1);
    EXPECT_FALSE(std::filesystem::exists(scratch / "x.png"));
}

// The sample: of one colour under D65 for 10 degrees, another under A.
TEST(Program, TheMetamericPairParts) {
    const std::filesystem::path folder = scene::data_folder() / "dyes";
    const Spectrum first = read_dye_file(folder / "plum.csv").spectrum,
                   second = read_dye_file(folder / "plum_match.csv").spectrum;
    const auto difference = [&](const char *name) {
        const glm::dvec3 white = white_of(lamp(name), Observer::cie1964);
        return ciede2000(lab_of(xyz_of(lamp(name), first, Observer::cie1964), white),
                         lab_of(xyz_of(lamp(name), second, Observer::cie1964), white));
    };
    EXPECT_LT(difference("D65"), 0.01);
    EXPECT_NEAR(difference("A"), 7.445, 0.01);
}

TEST(Program, ListsItsConfig) {
    const Scratch scratch;
    const std::string file = (scratch / "tsuya.ocio").string();
    ASSERT_EQ(run(scratch, {"list", "config", "-o", file}).status, 0);
    EXPECT_EQ(read_file(file), run(scratch, {"list", "config"}).out);
    EXPECT_NE(read_file(file).find("HP4 cat02"), std::string::npos);
    EXPECT_EQ(run(scratch, {"list", "lamps", "-o", file}).status, 2);
    // It makes the program's own pictures.
    const std::string exr = (scratch / "a.exr").string(), png = (scratch / "a.png").string();
    ASSERT_EQ(run(scratch, {"render", write_scene(scratch), "-o", exr}).status, 0);
    const auto shown = [&](std::vector<std::string> more) {
        std::vector<std::string> call{"relight", exr, "--lamp", "HP4", "-o", png, "--view", "Soft"};
        call.insert(call.end(), more.begin(), more.end());
        EXPECT_EQ(run(scratch, call).status, 0);
        return read_image(png);
    };
    for (const char *display : {"sRGB", "Display P3"}) {
        const Image own = shown({"--display", display}),
                    by_file = shown({"--display", display, "--ocio", file});
        for (std::size_t i = 0; i < own.data.size(); ++i)
            ASSERT_NEAR(own.data[i], by_file.data[i], 1.01 / 255) << display << i;
    }
}

TEST(Program, WritesALivePageOfSeveralPictures) {
    const Scratch scratch;
    const std::string first = (scratch / "first.exr").string(),
                      second = (scratch / "second.exr").string(),
                      page = (scratch / "p/page.html").string();
    ASSERT_EQ(run(scratch, {"render", write_scene(scratch), "-o", first}).status, 0);
    std::filesystem::copy_file(first, second);
    const Outcome made =
        run(scratch, {"compare", first, second, "--lamps", "D65,A", "--html", page});
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_NE(made.out.find(second + ": CIEDE2000"), std::string::npos) << made.out;
    EXPECT_NE(made.out.find(page + ": "), std::string::npos) << made.out;
    EXPECT_NE(made.out.find("(99th percentile) of the file's"), std::string::npos) << made.out;
    const std::string html = read_file(page);
    EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
    EXPECT_NE(html.find("<title>first, second</title>"), std::string::npos);
    EXPECT_NE(html.find("id=\"planes-1\""), std::string::npos);
    // A dye that is fixed is no input, and leaves no page.
    const std::string dyed = (scratch / "dyed.html").string();
    EXPECT_EQ(
        run(scratch, {"compare", first, "--lamps", "D65,A", "--dyes", "crimson", "--html", dyed})
            .status,
        1);
    EXPECT_FALSE(std::filesystem::exists(dyed));
}

} // namespace
} // namespace tsuya::program
