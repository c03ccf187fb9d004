// tsuya lab plan: what the commands of a capture session print and return.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "samples/process.h"
#include "samples/scratch.h"
#include "tsuya/lab/plan.h"

namespace tsuya::program {
namespace {

using nlohmann::json;
using scene::Scratch;

TEST(LabCommands, PlanSaysWhatASessionWillTake) {
    const Scratch scratch;
    const auto run = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"lab", "plan"});
        return run_program(words, scratch.folder());
    };
    const std::string output = (scratch / "a.plan.jsonl").string();
    const Outcome planned = run({TSUYA_RIG_SAMPLE, "--views", "few:5", "--symmetry", "orthotropic",
                                 "-o", output, "--json"});
    ASSERT_EQ(planned.status, 0) << planned.err;
    const json report = json::parse(planned.out);
    EXPECT_EQ(report.at("schema"), "tsuya-lab-plan 1");
    const lab::Plan plan = lab::read_plan(output);
    EXPECT_EQ(report.at("frames"), plan.frames.size());
    EXPECT_EQ(report.at("left_out"), plan.left_out.size());
    EXPECT_EQ(report.at("left_out_for").at("geometry.dead_cone_deg"), 20);
    EXPECT_EQ(report.at("kinds").at("trap"), 4);
    EXPECT_EQ(plan.rig, std::filesystem::path(TSUYA_RIG_SAMPLE).lexically_normal());

    const Outcome told = run({TSUYA_RIG_SAMPLE, "-o", output});
    EXPECT_NE(told.out.find("views left out: axes.camera "), std::string::npos) << told.out;
    EXPECT_NE(told.out.find("strikes of the lamp 1"), std::string::npos) << told.out;
    EXPECT_EQ(run({TSUYA_RIG_SAMPLE, "-o", output, "--views", "few:0"}).status, 1);
    EXPECT_EQ(run({TSUYA_RIG_SAMPLE, "-o", output, "--symmetry", "round"}).status, 2);
    EXPECT_EQ(run({TSUYA_RIG_SAMPLE, "-o", (scratch / "a.csv").string()}).status, 1);
}

} // namespace
} // namespace tsuya::program
