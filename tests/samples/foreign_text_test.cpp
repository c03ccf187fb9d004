// Files as other programs and instruments write them, given to the program.
#include <cstdlib>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "samples/process.h"
#include "samples/scratch.h"

namespace tsuya::program {
namespace {

using nlohmann::json;
using scene::Scratch;

// A file of the folder that TSUYA_TEST_CASES names; empty where there is none.
std::string case_file(const std::string &name) {
    const char *const folder = std::getenv("TSUYA_TEST_CASES");
    const auto path = std::filesystem::path(folder ? folder : "") / name;
    return folder && std::filesystem::exists(path) ? path.string() : "";
}

TEST(ForeignMesh, AByteOrderMarkCostsNoVertex) {
    const std::string mesh = case_file("garment/35_bom_silent_shift.obj");
    if (mesh.empty())
        GTEST_SKIP() << "35_bom_silent_shift.obj is not there: TSUYA_TEST_CASES";
    const Scratch scratch;
    const Outcome done = run_program({"garment", "check", mesh, "--json"}, scratch.folder());
    ASSERT_EQ(done.status, 0) << done.err;
    double length = 0;
    const json report = json::parse(done.out);
    for (const json &opening : report.at("openings"))
        length += opening.at("length").get<double>();
    EXPECT_NEAR(length, 2.882, 0.001);
}

TEST(ForeignMesh, AKoreanNameIsShownEscaped) {
    const std::string mesh = case_file("garment/16_cp949_group.obj");
    if (mesh.empty())
        GTEST_SKIP() << "16_cp949_group.obj is not there: TSUYA_TEST_CASES";
    const Scratch scratch;
    const Outcome done = run_program({"garment", "check", mesh, "--json"}, scratch.folder());
    ASSERT_EQ(done.status, 0) << done.err;
    EXPECT_NE(json::parse(done.out).dump().find("\\\\xBE\\\\xD5"), std::string::npos) << done.out;
}

} // namespace
} // namespace tsuya::program
