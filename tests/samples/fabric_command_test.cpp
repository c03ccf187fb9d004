// tsuya fabric, from end to end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include <signal.h>

#include <nlohmann/json.hpp>

#include "limited_disk.h"
#include "samples/fabric_run.h"
#include "tsuya/color/image_file.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/reflectance_file.h"

namespace tsuya::program {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Scratch;

/// A table of two lights, one with the ring at 60 degrees.
std::string small_table(const Scratch &scratch) {
    return scratch
        .write("two.csv", "# symmetry: orthotropic\n"
                          "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr,sigma_per_sr\n"
                          "0,0,0,0,0.2,0.01\n0,0,60,0,0.02,0.01\n0,0,60,90,0.01,0.01\n"
                          "45,90,0,0,0.1,0.01\n45,90,45,270,0.4,0.01\n")
        .string();
}

TEST(FabricEvaluate, ReportsEveryMeasureOfEveryModelAsJson) {
    const Scratch scratch;
    const std::string table = small_table(scratch);
    const Outcome done = run_fabric(
        scratch, {"evaluate", satin().string(), "--against", table, "--model", "all", "--json"});
    ASSERT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.err, "");
    const json report = json::parse(done.out);
    EXPECT_EQ(report.at("schema"), "tsuya-fabric-evaluate 1");
    EXPECT_EQ(report.at("table"), table);
    ASSERT_GE(report.at("results").size(), 5u); // no table, so not `tabulated`
    EXPECT_EQ(report["results"][0].at("model"), "yarn");
    for (const json &result : report["results"]) {
        ASSERT_EQ(result.at("directions").size(), 2u);
        const json &slanting = result["directions"][1];
        EXPECT_EQ(slanting.at("theta_i_deg"), 45.0);
        EXPECT_EQ(slanting.at("phi_i_deg"), 90.0);
        EXPECT_EQ(slanting.at("views"), 2);
        for (const char *measure : {"mean_over_peak", "l2_cos", "albedo_ratio", "log_p95",
                                    "noise_floor", "ring_over_peak"}) {
            EXPECT_TRUE(result.at("mean").at(measure).is_number()) << measure;
            const bool absent = std::string(measure) == "ring_over_peak";
            EXPECT_EQ(slanting.at(measure).is_null(), absent) << measure;
        }
    }
}

// Tints and a delustre of yarns are nothing that other models could not be compared with.
TEST(FabricEvaluate, ComparesEveryModelInTheDye) {
    const Scratch scratch;
    const std::string table = small_table(scratch);
    const auto compared = [&](const FabricColours &colours) {
        Fabric fabric = read_fabric(satin());
        fabric.colours = colours;
        const std::string file = (scratch / "tinted.fabric.toml").string();
        write_fabric(fabric, file);
        const Outcome done = run_fabric(scratch, {"evaluate", file, "--against", table, "--model",
                                                  "all", "--reflectance", "0.4", "--json"});
        EXPECT_EQ(done.status, 0) << done.err;
        return json::parse(done.out)["results"];
    };
    const json plain = compared({.delustre = 0.3});
    EXPECT_GT(plain.size(), 3u);
    EXPECT_EQ(compared({.delustre = 0.3,
                        .specular_tint = Spectrum::constant(0),
                        .weft_tint = Spectrum::constant(0)}),
              plain);
}

// An even table of the reflectance is what a dull cloth in that dye shows: near by the body alone,
// far by the surface.
TEST(FabricEvaluate, ComparesDyedClothByItsParts) {
    const Scratch scratch;
    Fabric dull = read_fabric(satin());
    dull.colours.delustre = 1;
    const std::string fabric = (scratch / "dull.fabric.toml").string();
    write_fabric(dull, fabric);
    ReflectanceTable even{.symmetry = Symmetry::orthotropic};
    for (const double theta : {0.0, 15.0, 30.0, 45.0, 60.0})
        for (const double phi : {0.0, 30.0, 60.0, 90.0})
            even.rows.push_back({0, 0, theta * kDegree, phi * kDegree, 0.4 / kPi, 0});
    const std::string table = (scratch / "even.csv").string();
    write_reflectance_table(even, table);
    const auto l2_cos = [&](const std::string &part) {
        const Outcome done =
            run_fabric(scratch, {"evaluate", fabric, "--against", table, "--reflectance", "0.4",
                                 "--part", part, "--json"});
        EXPECT_EQ(done.status, 0) << done.err;
        return json::parse(done.out)["results"][0]["mean"]["l2_cos"].get<double>();
    };
    EXPECT_LT(l2_cos("body"), 0.05);
    EXPECT_GT(l2_cos("surface"), 0.3);
    EXPECT_GT(l2_cos("all"), 2 * l2_cos("body"));
    const Outcome refused =
        run_fabric(scratch, {"evaluate", fabric, "--against", table, "--part", "body"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("--reflectance"), std::string::npos) << refused.err;
}

TEST(FabricEvaluate, FindsTheSampleSatinNearItsOwnTable) {
    const Scratch scratch;
    const std::string table = (scene::data_folder() / "fabrics/black_satin.csv").string();
    const Outcome text = run_fabric(scratch, {"evaluate", satin().string(), "--against", table});
    ASSERT_EQ(text.status, 0) << text.err;
    EXPECT_EQ(text.out.rfind("yarn\n", 0), 0u); // the fabric names no model
    EXPECT_EQ(text.out.find("lambert"), std::string::npos);
    EXPECT_NE(text.out.find("noise_floor\n"), std::string::npos);
    const json report = json::parse(run_fabric(scratch, {"evaluate", satin().string(), "--against",
                                                         table, "--model", "all", "--json"})
                                        .out);
    EXPECT_LT(report["results"][0]["mean"]["l2_cos"], 0.1);
    bool has_lambert = false;
    for (const json &result : report["results"])
        if (result["model"] == "lambert") {
            has_lambert = true;
            EXPECT_GT(result["mean"]["l2_cos"], 0.3); // the diffuser is not the satin
        }
    EXPECT_TRUE(has_lambert);
}

TEST(FabricEvaluate, WritesValuesBesideTheTable) {
    const Scratch scratch;
    const std::string values = (scratch / "n/values.csv").string();
    const Outcome done =
        run_fabric(scratch, {"evaluate", satin().string(), "--against", small_table(scratch),
                             "--model", "lambert", "--values", values});
    ASSERT_EQ(done.status, 0) << done.err;
    const std::string text = read_file(values);
    EXPECT_EQ(text.rfind("theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr,lambert\n", 0),
              0u);
    EXPECT_NE(text.find("\n45,90,45,270,0.4,0.0"), std::string::npos) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 6);
}

TEST(FabricEvaluate, RefusesWrongInput) {
    const Scratch scratch;
    const std::string table = small_table(scratch);
    const auto status = [&](std::vector<std::string> call, const std::string &said) {
        call.insert(call.begin(), "evaluate");
        const Outcome wrong = run_fabric(scratch, call);
        EXPECT_NE(wrong.err.find(said), std::string::npos) << wrong.err;
        EXPECT_EQ(wrong.out, "");
        return wrong.status;
    };
    EXPECT_EQ(status({satin().string()}, "--against"), 2);
    EXPECT_EQ(
        status({satin().string(), "--against", table, "--model", "takedo"}, "did you mean takeda"),
        2);
    EXPECT_EQ(status({satin().string(), "--against", "no.csv"}, "no.csv"), 1);
    EXPECT_EQ(status({table, "--against", table}, "two.csv:"), 1);
    const std::string plain =
        scratch.write("plain.fabric.toml", "schema = \"tsuya-fabric 1\"\nname = \"plain\"\n")
            .string();
    EXPECT_EQ(status({plain, "--against", table}, "no measured views"), 1);
}

std::vector<std::string> simulation(const std::string &out, const std::string &photons) {
    return {"simulate", "polyester taffeta", "-o", out, "--photons", photons, "--step", "15"};
}

TEST(FabricSimulate, MakesATableThatIsEqualForEqualCalls) {
    const Scratch scratch;
    const std::string one = (scratch / "n/one.csv").string(), two = (scratch / "two.csv").string();
    std::vector<std::string> call = simulation(one, "30000");
    call.insert(call.end(), {"--threads", "1", "--json"});
    const Outcome done = run_fabric(scratch, call);
    ASSERT_EQ(done.status, 0) << done.err;
    const json report = json::parse(done.out);
    EXPECT_EQ(report.at("schema"), "tsuya-fabric-simulate 1");
    EXPECT_EQ(report.at("interrupted"), false);
    EXPECT_GE(report.at("photons"), 30000);
    ASSERT_EQ(report.at("lights").size(), 1u);
    EXPECT_GT(report["lights"][0].at("reflected"), 0.001);
    EXPECT_LT(report["lights"][0].at("reflected"), 0.2); // black
    const ReflectanceTable table = read_reflectance_table(one);
    EXPECT_TRUE(table.has_sigma());
    EXPECT_EQ(table.rows.size(), 5u * 7 + 1);
    EXPECT_EQ(table.keys.at("material"), "polyester taffeta");
    EXPECT_NE(table.keys.at("provenance").find("seed 1"), std::string::npos);
    EXPECT_FALSE(fs::exists(one + ".checkpoint"));

    ASSERT_EQ(run_fabric(scratch, simulation(two, "30000")).status, 0); // all threads
    EXPECT_EQ(read_file(one), read_file(two));
    call = simulation(two, "30000");
    call.insert(call.end(), {"--seed", "2"});
    ASSERT_EQ(run_fabric(scratch, call).status, 0);
    EXPECT_NE(read_file(one), read_file(two));

    // The table fits, and its own directions can be asked for again
    const std::string toml = (scratch / "taffeta.fabric.toml").string();
    EXPECT_EQ(run_fabric(scratch, {"fit", one, "-o", toml}).status, 0);
    EXPECT_EQ(run_fabric(scratch, {"simulate", "twill lining", "-o", two, "--photons", "10000",
                                   "--directions", one})
                  .status,
              0);
    EXPECT_EQ(read_reflectance_table(two).rows.size(), table.rows.size());
}

TEST(FabricSimulate, ResumesBitIdentically) {
    const Scratch scratch;
    const std::string whole = (scratch / "whole.csv").string(),
                      parts = (scratch / "parts.csv").string();
    const std::string photons = "1500000";
    std::vector<std::string> call = simulation(parts, photons);
    call.insert(call.begin(), "fabric");
    call.insert(call.end(), {"--progress", "json"});
    const Outcome interrupted = run_program(call, scratch.folder(), once(SIGTERM, "\"measure\""));
    ASSERT_EQ(interrupted.status, 3) << interrupted.err;
    EXPECT_NE(interrupted.err.find("--resume"), std::string::npos);
    ASSERT_TRUE(fs::exists(parts + ".checkpoint"));
    call = simulation(parts, photons);
    call.insert(call.end(), {"--resume", "--json"});
    {
        // A table that cannot be written takes nothing away
        const test::FileSizeLimit limit(500);
        EXPECT_EQ(run_fabric(scratch, call).status, 1);
    }
    ASSERT_TRUE(fs::exists(parts + ".checkpoint"));
    const Outcome resumed = run_fabric(scratch, call);
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_LT(json::parse(resumed.out).at("photons"), 1500000); // or nothing was resumed
    EXPECT_FALSE(fs::exists(parts + ".checkpoint"));
    ASSERT_EQ(run_fabric(scratch, simulation(whole, photons)).status, 0);
    EXPECT_EQ(read_file(parts), read_file(whole));
}

TEST(FabricSimulate, RefusesWrongInput) {
    const Scratch scratch;
    const std::string out = (scratch / "n/a.csv").string();
    const auto status = [&](std::vector<std::string> call, const std::string &said) {
        call.insert(call.begin(), "simulate");
        const Outcome wrong = run_fabric(scratch, call);
        EXPECT_NE(wrong.err.find(said), std::string::npos) << wrong.err;
        EXPECT_EQ(wrong.out, "");
        EXPECT_FALSE(fs::exists(scratch / "n"));
        return wrong.status;
    };
    EXPECT_EQ(status({"polyester taffeta"}, "--output"), 2);
    EXPECT_EQ(status({"polyester taffeta", "-o", out, "--photons", "0"}, "--photons"), 2);
    EXPECT_EQ(status({"polyester tafetta", "-o", out}, "did you mean polyester taffeta"), 2);
    EXPECT_EQ(status({"no.wif", "-o", out}, "no.wif"), 1);
    EXPECT_EQ(status({"polyester taffeta", "-o", (scratch / "n/a.txt").string()}, ".csv"), 2);
    EXPECT_EQ(status({"polyester taffeta", "-o", out, "--directions", "no.csv"}, "no.csv"), 1);
    const std::string bad = scratch.write("bad.toml", "[weave]\ndraft = \"satan 5\"\n").string();
    EXPECT_EQ(status({bad, "-o", out}, "bad.toml:2"), 1);
}

bool has_gnuplot() { return std::system("command -v gnuplot >/dev/null 2>&1") == 0; }

TEST(FabricShow, DrawsLobesAndMap) {
    if (!has_gnuplot())
        GTEST_SKIP() << "gnuplot is not installed";
    const Scratch scratch;
    const fs::path png = scratch / "n/it's.png", svg = scratch / "n/lobes.svg";
    const std::string table = small_table(scratch);
    const Outcome drawn =
        run_fabric(scratch, {"show", satin().string(), "-o", png.string(), "--against", table});
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_EQ(drawn.out, png.string() + "\n");
    const Image image = read_image(png);
    EXPECT_EQ(image.width, 1200);
    EXPECT_EQ(image.height, 1000);
    const Outcome bare = run_fabric(
        scratch, {"show", satin().string(), "-o", svg.string(), "--model", "half_vector"});
    ASSERT_EQ(bare.status, 0) << bare.err;
    const std::string text = read_file(svg);
    for (const char *label : {"Light in the warp plane", "Light in the bias plane", "theta_r",
                              "1/sr", "75°", "BRDF under light from straight above"})
        EXPECT_NE(text.find(label), std::string::npos) << label;
    std::size_t files = 0; // nothing temporary is left
    for ([[maybe_unused]] const auto &entry : fs::directory_iterator(scratch / "n"))
        ++files;
    EXPECT_EQ(files, 2u);
}

TEST(FabricShow, RefusesWrongInput) {
    const Scratch scratch;
    const Outcome kind =
        run_fabric(scratch, {"show", satin().string(), "-o", (scratch / "n/a.pdf").string()});
    EXPECT_EQ(kind.status, 2);
    EXPECT_NE(kind.err.find("expected a name that ends in .svg"), std::string::npos) << kind.err;
    const Outcome model = run_fabric(scratch, {"show", satin().string(), "-o",
                                               (scratch / "a.svg").string(), "--model", "takedo"});
    EXPECT_EQ(model.status, 2);
    EXPECT_NE(model.err.find("did you mean takeda"), std::string::npos) << model.err;
    EXPECT_FALSE(fs::exists(scratch / "a.svg"));
}

TEST(FabricShow, DrawsAWeaveBesideItsDraft) {
    const Scratch scratch;
    const fs::path png = scratch / "n/weave.png", svg = scratch / "weave.svg";
    const Outcome drawn = run_fabric(scratch, {"show", "--weave", "shot silk", "-o", png.string(),
                                               "--size", "64", "--tilt", "30"});
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_EQ(drawn.out, png.string() + "\n");
    EXPECT_GT(read_image(png).width, 2 * 64);
    const std::string toml =
        scratch.write("a & b.toml", "[weave]\ndraft = \"satin 5\"\nname = \"a & b\"\n").string();
    const Outcome vector = run_fabric(
        scratch, {"show", "--weave", toml, "-o", svg.string(), "--size", "64", "--across", "1"});
    ASSERT_EQ(vector.status, 0) << vector.err;
    const std::string text = read_file(svg);
    for (const char *part : {">a &amp; b<", "the bar is 0.2 mm", "warp on the face",
                             "data:image/png;base64,iVBORw0KGgo"})
        EXPECT_NE(text.find(part), std::string::npos) << part;
    std::size_t files = 0; // nothing temporary is left: folder n, two files
    for ([[maybe_unused]] const auto &entry : fs::directory_iterator(scratch.folder()))
        ++files;
    EXPECT_EQ(files, 3u);
}

TEST(FabricShow, DrawsTheSampleDraft) {
    const Scratch scratch;
    const fs::path wif = scene::data_folder() / "weaves/eight_end_satin.wif";
    const fs::path svg = scratch / "satin.svg";
    const Outcome drawn =
        run_fabric(scratch, {"show", "--weave", wif.string(), "-o", svg.string(), "--size", "64"});
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_NE(read_file(svg).find(">Eight-end satin<"), std::string::npos);
}

TEST(FabricShow, RefusesAWeaveThatItCannotDraw) {
    const Scratch scratch;
    const std::string out = (scratch / "a.png").string();
    const auto expect = [&](std::vector<std::string> arguments, int status, const char *says) {
        arguments.insert(arguments.begin(), "show");
        const Outcome refused = run_fabric(scratch, arguments);
        EXPECT_EQ(refused.status, status) << refused.err;
        EXPECT_NE(refused.err.find(says), std::string::npos) << refused.err;
        EXPECT_FALSE(fs::exists(out));
    };
    expect({"--weave", "silk charmeus", "-o", out}, 2, "did you mean silk charmeuse");
    expect({"--weave", "none.wif", "-o", out}, 1, "none.wif");
    const std::string bad = scratch.write("bad.toml", "[weave]\ndraft = \"satan 5\"\n").string();
    expect({"--weave", bad, "-o", out}, 1, "bad.toml:2");
    expect({"--weave", "shot silk", "-o", (scratch / "a.jpg").string()}, 2, ".svg or .png");
    scratch.write("file", "");
    expect({"--weave", "shot silk", "-o", (scratch / "file/a.png").string()}, 1, "file");
    expect({"-o", out}, 2, "neither F.fabric.toml nor --weave");
    expect({satin().string(), "--weave", "shot silk", "-o", out}, 2,
           "cannot be given with --weave");
    expect({satin().string(), "--tilt", "3", "-o", out}, 2,
           "--tilt: it has no meaning without --weave");
    expect({"--weave", "shot silk", "--tilt", "90", "-o", out}, 2, "--tilt");
}

// A PATH with no program in it
TEST(FabricShow, NamesThePackageOfGnuplot) {
    const Scratch scratch;
    const std::string path = std::getenv("PATH") ? std::getenv("PATH") : "";
    setenv("PATH", scratch.folder().c_str(), 1);
    const Outcome refused =
        run_fabric(scratch, {"show", satin().string(), "-o", (scratch / "a.svg").string()});
    setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("gnuplot-nox"), std::string::npos) << refused.err;
    EXPECT_FALSE(fs::exists(scratch / "a.svg"));
}

} // namespace
} // namespace tsuya::program
