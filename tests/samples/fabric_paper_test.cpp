// tsuya fabric paper: Eq. 7 of [Takeda] at the feature points, by hand.
#include <cmath>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "samples/process.h"
#include "samples/scratch.h"

namespace tsuya::program {
namespace {

using nlohmann::json;
using scene::Scratch;

TEST(FabricPaper, PrintsEquation7AsItStands) {
    const Scratch scratch;
    const Outcome done = run_program({"fabric", "paper", "--json"}, scratch.folder());
    ASSERT_EQ(done.status, 0) << done.err;
    const json report = json::parse(done.out);
    EXPECT_EQ(report.at("schema"), "tsuya-fabric-paper 1");
    const json &tables = report.at("tables");
    ASSERT_EQ(tables.size(), 3u);
    for (const json &table : tables) {
        ASSERT_EQ(table.at("rows").size(), 6u);
        // Light from straight above is measured, not predicted
        const json &first = table["rows"][0];
        EXPECT_NEAR(first.at("ours_per_sr"), first.at("measured_per_sr").get<double>(), 1e-6);
        // The estimates leave the Fresnel term out, but for the first table
        for (const json &row : table["rows"]) {
            const double ratio = row.at("paper_per_sr").get<double>() /
                                 row.at("without_fresnel_per_sr").get<double>();
            if (table.at("name") != "Table 1") {
                EXPECT_NEAR(ratio, 1, 0.003);
            }
        }
    }
    const auto ours = [&](int table, int row) {
        return tables[static_cast<std::size_t>(table)]["rows"][static_cast<std::size_t>(row)];
    };
    EXPECT_NEAR(ours(0, 5).at("ours_per_sr"), 5.81, 0.01);
    EXPECT_NEAR(ours(0, 5).at("ours_at_measured_mirror_per_sr"), 6.38, 0.01);
    EXPECT_NEAR(ours(1, 4).at("ours_per_sr"), 2.54, 0.01);
    EXPECT_NEAR(ours(1, 5).at("ours_per_sr"), 15.7, 0.05);
    EXPECT_EQ(ours(1, 4).at("paper_per_sr"), 1.808);

    bool found = false;
    for (const json &count : report.at("measurements"))
        if (count.at("spacing_deg") == 5.0) {
            found = true;
            EXPECT_EQ(count.at("normal_incidence"), 324.0);
            EXPECT_EQ(count.at("every_light"), 419904.0);
            EXPECT_EQ(count.at("times_fewer"), 1296.0);
        }
    EXPECT_TRUE(found);
}

// Table 4 as printed, and ours: the great-circle form is nearer than the printed one.
TEST(FabricPaper, PrintsTheErrorsOnTheRing) {
    const Scratch scratch;
    const Outcome done = run_program({"fabric", "paper", "--json"}, scratch.folder());
    ASSERT_EQ(done.status, 0) << done.err;
    const json rings = json::parse(done.out).at("ring_errors");
    ASSERT_EQ(rings.size(), 3u);
    const double paper[3][3] = {{0.44, 20.7, 7.60}, {1.17, 13.4, 6.35}, {0, 0, 7.84}};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(rings[i].at("plane"), (std::vector{"weft", "bias", "warp"})[i]);
        EXPECT_EQ(rings[i].at("paper_peak_per_sr"), paper[i][0]);
        EXPECT_EQ(rings[i].at("paper_peak_per_cent"), paper[i][1]);
        EXPECT_EQ(rings[i].at("paper_mean_per_cent"), paper[i][2]);
        EXPECT_GT(rings[i].at("ours_mean_per_cent"), 0.5);
        EXPECT_LT(rings[i].at("ours_mean_per_cent"), rings[i].at("printed_mean_per_cent"));
    }
}

TEST(FabricPaper, ExplainsTheDifferencesInText) {
    const Scratch scratch;
    const Outcome done = run_program({"fabric", "paper"}, scratch.folder());
    ASSERT_EQ(done.status, 0) << done.err;
    EXPECT_NE(done.out.find("Fresnel term of Eq. 7 was left out"), std::string::npos);
    EXPECT_NE(done.out.find("Table 3, middle plane Fxz"), std::string::npos);
    EXPECT_NE(done.out.find("1296"), std::string::npos);
    EXPECT_NE(done.out.find("Table 4, errors under light"), std::string::npos);
}

} // namespace
} // namespace tsuya::program
