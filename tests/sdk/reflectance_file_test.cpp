// TABLE.csv: what is written is read back, and what is wrong is told with its place.

#include "tsuya/sdk/reflectance_file.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sdk/files_fixture.h"
#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::test {
namespace {

using TableFile = FilesTest;

const std::string kHeader = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr\n";

TEST_F(TableFile, IsReadBackAsWritten) {
    for (const Symmetry symmetry : {Symmetry::none, Symmetry::half_turn, Symmetry::orthotropic})
        for (const bool sigma : {false, true}) {
            ReflectanceTable table = normal_table(satin_cloth(), even_grid(10, 30));
            table.symmetry = symmetry;
            table.keys = {{"instrument", "made up"}, {"date", "2024-01-02T03:04:05"}};
            table.rows.push_back({0.5, -1.25, 1.5, 6.0, 0, 0});
            for (ReflectanceRow &row : table.rows)
                row.sigma_per_sr = sigma ? 0.01 * row.brdf_per_sr : 0;
            write_reflectance_table(table, file("t.csv"));
            const ReflectanceTable back = read_reflectance_table(file("t.csv"));
            EXPECT_EQ(back.keys, table.keys);
            EXPECT_EQ(back.symmetry, symmetry);
            EXPECT_EQ(back.has_sigma(), sigma);
            ASSERT_EQ(back.rows.size(), table.rows.size());
            for (std::size_t i = 0; i < table.rows.size(); ++i) {
                const ReflectanceRow &a = table.rows[i], &b = back.rows[i];
                EXPECT_NEAR(a.theta_i, b.theta_i, 1e-9);
                EXPECT_NEAR(a.phi_i, b.phi_i, 1e-8);
                EXPECT_NEAR(a.theta_r, b.theta_r, 1e-9);
                EXPECT_NEAR(a.phi_r, b.phi_r, 1e-8);
                EXPECT_NEAR(a.brdf_per_sr, b.brdf_per_sr, 1e-5 * a.brdf_per_sr);
                EXPECT_NEAR(a.sigma_per_sr, b.sigma_per_sr, 1e-2 * a.sigma_per_sr);
            }
            EXPECT_EQ(back.normal_incidence().rows.size(), table.rows.size() - 1);
        }
}

TEST_F(TableFile, CommentsBlanksAndCarriageReturnsAreTolerated) {
    const auto name =
        file("t.csv", "# a note\r\n#key :  a: b \r\n\r\n" + kHeader.substr(0, kHeader.size() - 1) +
                          "\r\n 0, 0 ,30,-360,0.5\r\n# late\n0,0,90,360,1e-3");
    const ReflectanceTable table = read_reflectance_table(name);
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_DOUBLE_EQ(table.rows[0].theta_r, 30 * kDegree);
    EXPECT_EQ(table.rows[1].brdf_per_sr, 1e-3);
    EXPECT_EQ(table.keys.at("key"), "a: b");
    EXPECT_EQ(table.symmetry, Symmetry::orthotropic);
    EXPECT_FALSE(table.symmetry_declared);
}

TEST_F(TableFile, BadOnesAreRefusedWithLineAndColumn) {
    struct Bad {
        std::string text, where;
    };
    const std::string good = "0,0,30,0,0.5\n";
    for (const Bad &bad : {
             Bad{"", ":1:1"},
             {kHeader, ":1:1"},
             {"theta_i_deg,phi_i_deg,theta_r_deg,brdf_per_sr\n" + good, ":1:1"},
             {good, ":1:1"},
             {kHeader + "0,0,30,0\n", ":2:9"},
             {kHeader + "0,0,30,0,0.5,0.1\n", ":2:14"},
             {kHeader + good + "0,0,x,0,0.5\n", ":3:5"},
             {kHeader + "0,0,30,0,nan\n", ":2:10"},
             {kHeader + "0,0,30,0,inf\n", ":2:10"},
             {kHeader + "0,0,30,0,-0.1\n", ":2:10"},
             {kHeader + "0,0,30,0,\n", ":2:10"},
             {kHeader + "0,0,30,0,0.5x\n", ":2:10"},
             {kHeader + "0,0,90.1,0,0.5\n", ":2:5"},
             {kHeader + "-1,0,30,0,0.5\n", ":2:1"},
             {kHeader + "0,361,30,0,0.5\n", ":2:3"},
             {kHeader + "0,0,30,-400,0.5\n", ":2:8"},
             {"# symmetry: orthotrop\n" + kHeader + good, ":1:1"},
             {"# symmetry: orthotropic\n# symmetry: none\n" + kHeader + good, ":2:1"},
         }) {
        const auto problems = problems_of(read_reflectance_table, file("t.csv", bad.text));
        EXPECT_EQ(problems[0].where, bad.where) << bad.text;
        EXPECT_EQ(problems.size(), 1u) << bad.text;
        EXPECT_FALSE(problems[0].accepted.empty()) << bad.text;
    }
}

TEST_F(TableFile, AWrongSymmetryHasASuggestion) {
    const auto name = file("t.csv", "# symmetry: half-trun\n" + kHeader + "0,0,30,0,0.5\n");
    EXPECT_NE(problems_of(read_reflectance_table, name)[0].accepted.find("did you mean half-turn?"),
              std::string::npos);
}

TEST_F(TableFile, ProblemsAreCollectedUpToTwenty) {
    std::string text = kHeader;
    for (int i = 0; i < 30; ++i)
        text += "0,0,95,0,0.5\n";
    const auto problems = problems_of(read_reflectance_table, file("t.csv", text));
    ASSERT_EQ(problems.size(), kMaxProblems);
    EXPECT_EQ(problems[19].where, ":21:5");
}

} // namespace
} // namespace tsuya::test
