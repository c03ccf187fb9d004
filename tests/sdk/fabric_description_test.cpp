// What a fabric's file says wholly, in part, or of nothing; and texts of any kind in it.

#include <gtest/gtest.h>
#include <unistd.h>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/file.h"

namespace tsuya::test {
namespace {

class FabricDescription : public testing::Test {
  protected:
    ~FabricDescription() override { std::filesystem::remove(file_); }

    // The first problem of a file that begins with schema and name, on lines 1 and 2.
    Problem problem_of(const std::string &text) const {
        write_file(file_, "schema = \"tsuya-fabric 1\"\nname = \"f\"\n" + text);
        try {
            read_fabric(file_);
        } catch (const Error &error) {
            Problem problem = error.problems().front();
            problem.where.erase(0, file_.string().size());
            return problem;
        }
        ADD_FAILURE() << "accepted: " << text;
        return {};
    }
    const std::filesystem::path file_ = std::filesystem::temp_directory_path() /
                                        ("tsuya_description_" + std::to_string(getpid()) + ".toml");
};

TEST_F(FabricDescription, ASpectrumIsWhole) {
    for (const std::string text : {"[dye]\n", "[weft_tint]\n", "[dye]\nvalue = [0.5]\n",
                                   "[transmittance]\nwavelength_nm = [500]\n"}) {
        const Problem problem = problem_of(text);
        EXPECT_EQ(problem.where, ":3:1") << text;
        EXPECT_NE(problem.what.find("not complete"), std::string::npos) << problem.what;
    }
}

TEST_F(FabricDescription, WhatIsOfViewsNeedsViews) {
    for (const std::string text :
         {"f0 = 0.1\n", "symmetry = \"none\"\n",
          "[smoothness]\nweft_support = 1\nwarp_support = 1\nnoise_share = 0.1\n"}) {
        const Problem problem = problem_of(text);
        EXPECT_EQ(problem.where.substr(0, 3), ":3:") << text;
        EXPECT_NE(problem.what.find("stands without [views]"), std::string::npos) << problem.what;
    }
}

// A fabric that silently has no specular part looks like a wrong picture, not like a wrong file.
TEST_F(FabricDescription, FacetsNeedTheirModel) {
    const std::string facets = "[ggx]\nalpha_weft = 0.1\nalpha_warp = 0.2\n";
    const Problem problem = problem_of(facets);
    EXPECT_EQ(problem.where, ":3:1");
    EXPECT_EQ(problem.accepted, "expected model = \"ggx\"");
    write_file(file_, "schema = \"tsuya-fabric 1\"\nname = \"f\"\nmodel = \"ggx\"\n" + facets);
    EXPECT_TRUE(has_specular(read_fabric(file_)));
}

TEST_F(FabricDescription, AnyTextIsReadBack) {
    Fabric fabric{.name = "a \"b\" \\ c\td\x7f\x01"};
    fabric.keys = {{"lab", "first\nsecond"}, {"\xe7\xb5\xb9", "\xe8\x89\xb6"}};
    write_fabric(fabric, file_);
    EXPECT_EQ(read_fabric(file_), fabric);
    // Bytes that are not UTF-8 are shown
    fabric.keys = {{"instrument", "g\xe9rard"}};
    write_fabric(fabric, file_);
    EXPECT_EQ(read_fabric(file_).keys.at("instrument"), "g\\xE9rard");
}

} // namespace
} // namespace tsuya::test
