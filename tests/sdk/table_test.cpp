// TABLE.csv as spreadsheets, rigs and people write it.

#include "tsuya/sdk/reflectance_file.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/table_warnings.h"
#include "tsuya/sdk/text.h"

namespace tsuya::test {
namespace {

const std::string kColumns = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr";
const std::string kRows = "0,0,0,0,0.66\n0,0,30.5,40,0.25\n30,90,60,270,0.125\n";

std::string replaced(std::string text, const std::string &from, const std::string &to) {
    for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

ReflectanceFile parsed(const std::string &text) { return parse_reflectance_file(text, "t.csv"); }

void expect_the_rows(const std::string &text) {
    SCOPED_TRACE(text);
    const ReflectanceFile file = parsed(decode_text(text, "t.csv"));
    ASSERT_EQ(file.channels.size(), 1u);
    const std::vector<ReflectanceRow> &rows = file.channels[0].table.rows;
    const double expected[3][5] = {
        {0, 0, 0, 0, 0.66}, {0, 0, 30.5, 40, 0.25}, {30, 90, 60, 270, 0.125}};
    ASSERT_EQ(rows.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(rows[i].theta_i, expected[i][0] * kDegree, 1e-9);
        EXPECT_NEAR(rows[i].phi_i, expected[i][1] * kDegree, 1e-9);
        EXPECT_NEAR(rows[i].theta_r, expected[i][2] * kDegree, 1e-9);
        EXPECT_NEAR(rows[i].phi_r, expected[i][3] * kDegree, 1e-9);
        EXPECT_EQ(rows[i].brdf_per_sr, expected[i][4]);
    }
}

Problem problem_of(const std::string &text) {
    try {
        parsed(text);
    } catch (const Error &error) {
        EXPECT_EQ(error.problems().size(), 1u) << error.what();
        return error.problems()[0];
    }
    ADD_FAILURE() << "expected an Error of " << text;
    return {};
}

TEST(Table, OneTableInManySpellings) {
    const std::string plain = "# symmetry: none\n" + kColumns + "\n" + kRows;
    const std::string semicolons = replaced(plain, ",", ";");
    const std::string decimal_commas = replaced(semicolons, ".", ",");
    expect_the_rows(plain);
    expect_the_rows("\xEF\xBB\xBF" + plain);
    expect_the_rows(replaced(plain, "\n", "\r"));
    expect_the_rows(replaced(plain, "\n", "\r\n"));
    expect_the_rows(replaced(plain, "\n", "\n\n"));
    expect_the_rows(semicolons);
    expect_the_rows(replaced(plain, ",", "\t"));
    expect_the_rows(replaced(plain, ",", "   "));
    expect_the_rows(replaced(plain, ",", " , "));
    expect_the_rows(decimal_commas);
    expect_the_rows(replaced(decimal_commas, ";", "\t"));
    expect_the_rows("sep=;\n" + decimal_commas);
    // Quotes about every field; a comment and empty rows filled up with separators
    expect_the_rows("\"# symmetry: none\",,,,\n,,,,\n\"" + replaced(kColumns, ",", "\",\"") +
                    "\"\n" +
                    "\"0\",\"0\",\"0\",\"0\",\"0,66\"\n0,0,\"30,5\",40,\"0,25\"\n"
                    "30,90,60,270,\"0,125\"\n,,,,\n");
    // Names as people write them
    expect_the_rows(replaced(
        plain, kColumns, " Theta_i [deg],PHI_I_DEG,theta_r (\xC2\xB0),\"phi_r deg\",BRDF [1/sr]"));
    // Rows that end in separators, signs, exponents
    expect_the_rows(kColumns + ",\n+0,0,0,0,6.6e-1,\n0,0,30.5,+40,2.5E-1,\n30,9e1,60,270,.125\n");
    expect_the_rows("brdf_per_sr,phi_r_deg,theta_r_deg,phi_i_deg,theta_i_deg\n"
                    "0.66,0,0,0,0\n0.25,40,30.5,0,0\n0.125,270,60,90,30\n");
    expect_the_rows("theta_i_rad,phi_i_deg,theta_r_deg,phi_r_rad,brdf_per_sr\n0,0,0,0,0.66\n"
                    "0,0,30.5,0.6981317008,0.25\n0.5235987756,90,60,4.71238898038,0.125\n");
}

TEST(Table, OtherColumnsAreLeftOutAndTold) {
    const ReflectanceFile file = parsed("date;" + replaced(kColumns, ",", ";") + ";note\n" +
                                        "today;0;0;0;0;0,5;\"a; b\"\n;0;0;30;0;0,25\n");
    ASSERT_EQ(file.channels.at(0).table.rows.size(), 2u);
    EXPECT_EQ(file.channels[0].table.rows[1].brdf_per_sr, 0.25);
    EXPECT_EQ(file.warnings, std::vector<std::string>{"columns that are not used: date, note"});
}

TEST(Table, KeysAndSymmetryOfSpreadsheets) {
    const ReflectanceTable table = parsed("\"# Symmetry: Half_Turn\";;;;\n# lamp: HP4, 180 W;;\n" +
                                          replaced(kColumns, ",", ";") + "\n0;0;0;0;1\n")
                                       .channels.at(0)
                                       .table;
    EXPECT_EQ(table.symmetry, Symmetry::half_turn);
    EXPECT_TRUE(table.symmetry_declared);
    EXPECT_EQ(table.keys.at("lamp"), "HP4, 180 W");
}

TEST(Table, NoiseBelowZeroCountsAsZeroAndIsTold) {
    // With standard errors within five of them, without within a tenth of the largest value
    const ReflectanceFile with =
        parsed(kColumns + ",sigma_per_sr\n0,0,0,0,1,\n0,0,30,0,-0.04,0.01\n"
                          "0,0,40,0,-0.01,0.01\n");
    EXPECT_EQ(with.channels[0].table.rows[1].brdf_per_sr, 0);
    EXPECT_EQ(with.channels[0].table.rows[1].sigma_per_sr, 0.01);
    EXPECT_EQ(with.warnings, std::vector<std::string>{"2 values below 0 within noise count as 0"});
    EXPECT_EQ(problem_of(kColumns + ",sigma_per_sr\n0,0,0,0,1,\n0,0,30,0,-0.06,0.01\n").where,
              "t.csv:3:10");
    std::string rows = kColumns + "\n0,0,10,0,1\n0,0,20,0,1\n0,0,30,0,1\n";
    EXPECT_EQ(parsed(rows + "0,0,40,0,-0.09\n").warnings,
              std::vector<std::string>{"1 value below 0 within noise count as 0"});
    EXPECT_EQ(problem_of(rows + "0,0,40,0,-0.11\n").what, "brdf_per_sr is '-0.11'");
    // Two of five are no few
    rows += "0,0,40,0,-0.01\n0,0,50,0,-0.01\n";
    EXPECT_THROW(parsed(rows), Error);
}

TEST(Table, ValuesTooSmallToBeAreBlack) {
    const ReflectanceFile file =
        parsed(kColumns + "\n0,0,0,0,1e-320\n0,0,30,0,1e-31\n0,0,60,0,1e-999\n");
    for (const ReflectanceRow &row : file.channels[0].table.rows)
        EXPECT_EQ(row.brdf_per_sr, 0);
    EXPECT_EQ(file.warnings, (std::vector<std::string>{"2 values below 1e-30 per sr count as 0",
                                                       "all values are 0: the cloth is black"}));
}

TEST(Table, ReadsChannels) {
    const ReflectanceFile colours =
        parsed("brdf_g,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_r,brdf_b,sigma_b\n"
               "0.2,0,0,30,0,0.1,0.3,0.01\n0.25,0,0,60,0,0.15,0.35,0.02\n");
    ASSERT_EQ(colours.channels.size(), 3u);
    for (const TableChannel &channel : colours.channels) {
        const double value = channel.name == "r" ? 0.1 : channel.name == "g" ? 0.2 : 0.3;
        EXPECT_EQ(channel.table.rows.at(0).brdf_per_sr, value) << channel.name;
        EXPECT_NEAR(channel.table.rows.at(1).brdf_per_sr, value + 0.05, 1e-12);
        EXPECT_EQ(channel.table.rows.at(1).sigma_per_sr, channel.name == "b" ? 0.02 : 0);
        EXPECT_NEAR(channel.table.rows.at(1).theta_r, 60 * kDegree, 1e-12);
    }
    const ReflectanceFile spectral =
        parsed("theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_650nm_per_sr,brdf_450.5nm\n"
               "0,0,30,0,0.1,0.3\n");
    ASSERT_EQ(spectral.channels.size(), 2u); // by wavelength
    EXPECT_EQ(spectral.channels[0].wavelength_nm, 450.5);
    EXPECT_EQ(spectral.channels[0].table.rows.at(0).brdf_per_sr, 0.3);
    EXPECT_EQ(spectral.channels[1].wavelength_nm, 650);
    EXPECT_THROW(check_single_channel(spectral, "t.csv"), Error);
}

TEST(Table, OneClearErrorForWhatCannotBeRead) {
    struct Bad {
        std::string text, where, what;
    };
    const std::string angles = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,";
    for (const Bad &bad : {
             Bad{kRows, "t.csv:1:1", "no header line but numbers"},
             {"", "t.csv:1:1", "the table has no row"},
             {replaced(kColumns, "theta_r_deg", "theta_o_deg") + "\n" + kRows, "t.csv:1:1",
              "no column theta_r_deg"},
             {replaced(kColumns, "theta_r_deg", "theta_r") + "\n" + kRows, "t.csv:1:1",
              "theta_r has no unit"},
             {kColumns + ",theta_r_rad\n" + kRows, "t.csv:1:1", "theta_r is given twice"},
             {kColumns + ",brdf_per_sr\n" + kRows, "t.csv:1:1", "brdf_per_sr is given twice"},
             {angles + "radiance\n" + kRows, "t.csv:1:1", "no column brdf_per_sr"},
             {"# symmetry: halfturn\n" + kColumns + "\n" + kRows, "t.csv:1:1",
              "unknown symmetry 'halfturn'"},
             {angles + "brdf_r,brdf_g\n", "t.csv:1:1", "brdf_b is missing"},
             {angles + "brdf_550nm,brdf_per_sr\n", "t.csv:1:1", "of several kinds"},
             {angles + "brdf_550nm,sigma_560nm\n", "t.csv:1:1", "no column of values"},
             {angles + "brdf_550nm,brdf_550.0nm\n", "t.csv:1:1", "given twice"},
             {angles + "brdf_0.45nm,brdf_0.55nm\n", "t.csv:1:1", "brdf_0.45nm is not from 100"},
             {angles + "brdf_550nm,brdf_1e300nm\n", "t.csv:1:1", "brdf_1e300nm is not from 100"},
             {kColumns + "\n" + kRows + "0,0,30,0,NaN\n", "t.csv:5:10", "brdf_per_sr is 'NaN'"},
             {kColumns + "\n" + kRows + "0,0,30,0,inf\n", "t.csv:5:10", "brdf_per_sr is 'inf'"},
             {kColumns + "\n0,0,30,0,1e999\n", "t.csv:2:10", "brdf_per_sr is '1e999'"},
             {kColumns + "\n0,0,30,0,\n", "t.csv:2:10", "brdf_per_sr is ''"},
             {kColumns + "\n0,0,30,0,0,5\n", "t.csv:2:12", "more than 5 columns"},
             {kColumns + "\n\"0,5\",0,30.5,0,1\n", "t.csv:2:9", "theta_r_deg is '30.5'"},
             {kColumns + "\n0,0,\"1,234.5\",0,1\n", "t.csv:2:5", "theta_r_deg is"},
             {kColumns + ",sigma_per_sr\n0,0,30,0,1,-1\n", "t.csv:2:12", "sigma_per_sr is '-1'"},
             {replaced(kColumns, "theta_i_deg", "theta_i_rad") + "\n1.6,0,30,0,1\n", "t.csv:2:1",
              "theta_i_rad is '1.6'"},
         }) {
        const Problem problem = problem_of(bad.text);
        EXPECT_EQ(problem.where, bad.where) << bad.text;
        EXPECT_NE(problem.what.find(bad.what), std::string::npos) << problem.what << "\n"
                                                                  << bad.text;
        EXPECT_FALSE(problem.accepted.empty());
    }
}

TEST(Table, RadiansUnderTheNameOfDegreesAreNamed) {
    std::string rows;
    for (double theta = 0; theta < 1.6; theta += 0.1745329)
        for (double phi = 0; phi < 6.2; phi += 0.7853982)
            rows += "0,0," + std::to_string(theta) + "," + std::to_string(phi) + ",0.3\n";
    const Problem problem = problem_of(kColumns + "\n" + rows);
    EXPECT_NE(problem.what.find("as in radians"), std::string::npos);
    EXPECT_NE(problem.accepted.find("theta_i_rad"), std::string::npos);
    EXPECT_NO_THROW(parsed(replaced(kColumns, "_deg", "_rad") + "\n" + rows));
    // A plane alone may be of small angles
    EXPECT_EQ(parsed(kColumns + "\n0,0,0,0,1\n0,0,1.5,0,1\n").warnings.size(), 1u);
    EXPECT_TRUE(parsed(kColumns + "\n0,0,0,0,1\n0,0,30,0,1\n").warnings.empty());
}

// Light within half a degree of the normal, as a rig has it, in several azimuths.
TEST(Table, LightNearTheNormalIsLightFromAbove) {
    ReflectanceTable table = normal_table(satin_cloth(), even_grid(10, 30));
    const Bard exact = Bard::fit(table, "exact");
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        table.rows[i].theta_i = 0.5 * kDegree * static_cast<double>(i % 7) / 6;
        table.rows[i].phi_i = static_cast<double>(i);
    }
    EXPECT_EQ(table.normal_incidence().rows.size(), table.rows.size());
    const Bard near = Bard::fit(table, "near");
    EXPECT_EQ(near.at(direction(35, 20)), exact.at(direction(35, 20)));
    const std::vector<std::string> warnings = table_warnings(table);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("within half a degree of the normal"), std::string::npos);
    table.rows[0].theta_i = 0.6 * kDegree;
    EXPECT_EQ(table.normal_incidence().rows.size(), table.rows.size() - 1);
}

bool warns(const ReflectanceTable &table, const std::string &of) {
    return std::ranges::any_of(table_warnings(table), [&](const std::string &warning) {
        return warning.find(of) != std::string::npos;
    });
}

TEST(TableWarnings, OrdinaryTablesHaveNone) {
    for (const Cloth &cloth : {satin_cloth(), isotropic_cloth(), twisted_cloth()})
        EXPECT_EQ(table_warnings(normal_table(cloth, even_grid(10, 15))),
                  std::vector<std::string>{});
    EXPECT_EQ(table_warnings(paper_table(satin_cloth(), 10, 15)), std::vector<std::string>{});
}

TEST(TableWarnings, ReflectingMoreThanReceived) {
    ReflectanceTable table = normal_table(isotropic_cloth(), even_grid(5, 15));
    for (ReflectanceRow &row : table.rows)
        row.brdf_per_sr = 0.99 / kPi;
    EXPECT_FALSE(warns(table, "times what they receive"));
    for (ReflectanceRow &row : table.rows)
        row.brdf_per_sr = 1.02 / kPi;
    EXPECT_TRUE(warns(table, "reflect 1.02 times what they receive under light at theta_i 0"));
}

TEST(TableWarnings, StandardErrorsFarAboveTheValues) {
    ReflectanceTable table = normal_table(satin_cloth(), even_grid(10, 15));
    for (ReflectanceRow &row : table.rows)
        row.sigma_per_sr = 0.5 * row.brdf_per_sr;
    EXPECT_FALSE(warns(table, "standard errors"));
    for (ReflectanceRow &row : table.rows)
        row.sigma_per_sr = 20 * row.brdf_per_sr;
    EXPECT_TRUE(warns(table, "the standard errors are 20 times the values"));
}

TEST(TableWarnings, RepeatsAndSpikes) {
    ReflectanceTable table = normal_table(satin_cloth(), even_grid(10, 15));
    EXPECT_FALSE(warns(table, "directions of other rows"));
    table.rows.push_back(table.rows[3]);
    table.rows.back().phi_r += 2 * kPi; // the same direction
    EXPECT_TRUE(warns(table, "the directions of 1 row are those of other rows"));
    table.rows.pop_back();
    EXPECT_FALSE(warns(table, "stands alone"));
    table.rows[20].brdf_per_sr = 40;
    EXPECT_TRUE(warns(table, "the value 40 at theta_r"));
    for (ReflectanceRow &row : table.rows) // a spike among views that saw nothing
        row.brdf_per_sr = row.brdf_per_sr == 40 ? 1 : 0;
    EXPECT_TRUE(warns(table, "the value 1 at theta_r"));
}

} // namespace
} // namespace tsuya::test
