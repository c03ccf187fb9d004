// tsuya fabric, from end to end.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "samples/process.h"
#include "samples/scratch.h"
#include "tsuya/scene/data_folder.h"

namespace tsuya::program {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Scratch;

Outcome run(const Scratch &scratch, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "fabric");
    return run_program(arguments, scratch.folder());
}

fs::path satin() { return scene::data_folder() / "fabrics/black_satin.fabric.toml"; }

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
    const Outcome done = run(
        scratch, {"evaluate", satin().string(), "--against", table, "--model", "all", "--json"});
    ASSERT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.err, "");
    const json report = json::parse(done.out);
    EXPECT_EQ(report.at("schema"), "tsuya-fabric-evaluate 1");
    EXPECT_EQ(report.at("table"), table);
    ASSERT_EQ(report.at("results").size(), 3u);
    EXPECT_EQ(report["results"][0].at("model"), "takeda");
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

TEST(FabricEvaluate, FindsTheSampleSatinNearItsOwnTable) {
    const Scratch scratch;
    const std::string table = (scene::data_folder() / "fabrics/black_satin.csv").string();
    const Outcome text = run(scratch, {"evaluate", satin().string(), "--against", table});
    ASSERT_EQ(text.status, 0) << text.err;
    EXPECT_EQ(text.out.rfind("takeda\n", 0), 0u);
    EXPECT_EQ(text.out.find("lambert"), std::string::npos);
    EXPECT_NE(text.out.find("noise_floor\n"), std::string::npos);
    const json report = json::parse(
        run(scratch, {"evaluate", satin().string(), "--against", table, "--model", "all", "--json"})
            .out);
    EXPECT_LT(report["results"][0]["mean"]["l2_cos"], 0.1);
    EXPECT_GT(report["results"][2]["mean"]["l2_cos"], 0.3); // the diffuser is not the satin
}

TEST(FabricEvaluate, RefusesWrongInput) {
    const Scratch scratch;
    const std::string table = small_table(scratch);
    const auto status = [&](std::vector<std::string> call, const std::string &said) {
        call.insert(call.begin(), "evaluate");
        const Outcome wrong = run(scratch, call);
        EXPECT_NE(wrong.err.find(said), std::string::npos) << wrong.err;
        EXPECT_EQ(wrong.out, "");
        return wrong.status;
    };
    EXPECT_EQ(status({satin().string()}, "--against"), 2);
    EXPECT_EQ(
        status({satin().string(), "--against", table, "--model", "takedo"}, "did you mean takeda"),
        1);
    EXPECT_EQ(status({satin().string(), "--against", "no.csv"}, "no.csv"), 1);
    EXPECT_EQ(status({table, "--against", table}, "two.csv:"), 1);
    const std::string plain =
        scratch.write("plain.fabric.toml", "schema = \"tsuya-fabric 1\"\nname = \"plain\"\n")
            .string();
    EXPECT_EQ(status({plain, "--against", table}, "no measured views"), 1);
}

} // namespace
} // namespace tsuya::program
