// Files as other programs and instruments write them, given to the program.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "samples/process.h"
#include "samples/scratch.h"
#include "tsuya/sdk/angle.h"

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

// A satin-like cloth under light from straight above, with a body of some reflectance.
double cloth_value(double theta_deg, double phi_deg, double body) {
    const double theta = theta_deg * kDegree, phi = phi_deg * kDegree;
    const double x = std::sin(theta / 2) * std::cos(phi), y = std::sin(theta / 2) * std::sin(phi);
    return 0.06 * std::exp(-x * x / 0.08 - y * y / 0.02) + 0.002 + body / kPi;
}

// Rows of a quadrant; `row` writes one.
template <class Row> std::string quadrant(const std::string &header, const Row &row) {
    std::string text = header + "\n";
    for (int theta = 0; theta <= 80; theta += 10)
        for (int phi = 0; phi <= (theta > 0 ? 90 : 0); phi += 15)
            text += row(theta, phi) + "\n";
    return text;
}

const std::string kHeader = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr";

std::string plain_rows(double body) {
    return quadrant("# symmetry: orthotropic\n" + kHeader, [&](int theta, int phi) {
        return "0,0," + std::to_string(theta) + "," + std::to_string(phi) + "," +
               std::to_string(cloth_value(theta, phi, body));
    });
}

Outcome fit(const Scratch &scratch, const std::string &table, const std::string &fabric) {
    return run_program({"fabric", "fit", table, "-o", fabric, "--json"}, scratch.folder());
}

TEST(ForeignTable, FitsASpreadsheetAsAPlainTable) {
    const Scratch scratch;
    const std::string plain = plain_rows(0);
    std::string sheet = plain;
    std::replace(sheet.begin(), sheet.end(), ',', ';');
    std::replace(sheet.begin(), sheet.end(), '.', ',');
    std::replace(sheet.begin(), sheet.end(), '\n', '\r');
    const std::string one = scratch.write("plain.csv", plain).string();
    const std::string two = scratch.write("sheet.csv", "\xEF\xBB\xBF" + sheet).string();
    const std::string fabric = (scratch / "f.fabric.toml").string();
    const Outcome first = fit(scratch, one, fabric), second = fit(scratch, two, fabric);
    ASSERT_EQ(first.status, 0) << first.err;
    ASSERT_EQ(second.status, 0) << second.err;
    EXPECT_EQ(first.out, second.out);
    EXPECT_EQ(second.err.find("warning"), std::string::npos) << second.err;
}

TEST(ForeignTable, WarningsNameTheFile) {
    const Scratch scratch;
    const std::string table =
        scratch.write("dim.csv", plain_rows(0) + "0,0,85,0,-0.001\n0,0,85,90,1e-40\n").string();
    const Outcome done = fit(scratch, table, (scratch / "f.fabric.toml").string());
    ASSERT_EQ(done.status, 0) << done.err;
    EXPECT_NE(done.err.find("dim.csv: 1 value below 0 within noise count as 0"), std::string::npos)
        << done.err;
    EXPECT_NE(done.err.find("dim.csv: 1 value below 1e-30 per sr count as 0"), std::string::npos)
        << done.err;
}

TEST(ForeignTable, EvaluateSaysThatAllLightIsFromAbove) {
    const Scratch scratch;
    const std::string table = scratch.write("above.csv", plain_rows(0)).string();
    const std::string fabric = (scratch / "f.fabric.toml").string();
    ASSERT_EQ(fit(scratch, table, fabric).status, 0);
    const Outcome done =
        run_program({"fabric", "evaluate", fabric, "--against", table, "--json"}, scratch.folder());
    ASSERT_EQ(done.status, 0) << done.err;
    EXPECT_TRUE(json::parse(done.out).at("only_light_from_above").get<bool>());
    EXPECT_NE(done.err.find("all light is from straight above"), std::string::npos) << done.err;
}

TEST(ForeignTable, ChannelsBecomeADye) {
    const Scratch scratch;
    const std::string header = "theta_i_deg;phi_i_deg;theta_r_deg;phi_r_deg;brdf_450nm;brdf_550nm;"
                               "brdf_650nm";
    const std::string table =
        scratch
            .write("crimson.csv",
                   quadrant(header,
                            [](int theta, int phi) {
                                std::string row =
                                    "0;0;" + std::to_string(theta) + ";" + std::to_string(phi);
                                for (const double body : {0.1, 0.05, 0.6})
                                    row += ";" + std::to_string(cloth_value(theta, phi, body));
                                return row;
                            }))
            .string();
    const std::string fabric = (scratch / "f.fabric.toml").string();
    const Outcome done = fit(scratch, table, fabric);
    ASSERT_EQ(done.status, 0) << done.err;
    const json report = json::parse(done.out);
    const json &body = report.at("body");
    ASSERT_EQ(body.size(), 3u);
    const double expected[] = {0.1, 0.05, 0.6};
    for (std::size_t c = 0; c < 3; ++c) {
        // What is even of the surface, 0.002 pi, counts as the body's
        EXPECT_NEAR(body[c].at("reflectance").get<double>(), expected[c] + 0.006, 0.02);
    }
    EXPECT_NE(read_file(fabric).find("[dye]\nwavelength_nm = [450, 550, 650]"), std::string::npos)
        << read_file(fabric);
    // Colours become a smooth spectrum
    std::string colours = read_file(table);
    for (const auto &[from, to] : {std::pair("450nm", "b"), {"550nm", "g"}, {"650nm", "r"}})
        colours.replace(colours.find(from), std::string_view(from).size(), to);
    const Outcome rgb = fit(scratch, scratch.write("rgb.csv", colours).string(), fabric);
    ASSERT_EQ(rgb.status, 0) << rgb.err;
    EXPECT_EQ(json::parse(rgb.out).at("body").size(), 3u);

    const Outcome all =
        run_program({"fabric", "fit", table, "-o", fabric, "--use", "all"}, scratch.folder());
    EXPECT_EQ(all.status, 1);
    EXPECT_NE(all.err.find("no meaning for a table with channels"), std::string::npos) << all.err;
    const Outcome against =
        run_program({"fabric", "evaluate", fabric, "--against", table}, scratch.folder());
    EXPECT_EQ(against.status, 1);
    EXPECT_NE(against.err.find("3 channels"), std::string::npos) << against.err;
}

// Each table of the folder of cases gives a fabric or one clear line.
TEST(ForeignTable, CasesGiveAFabricOrOneLine) {
    const std::filesystem::path folder = case_file("fabric");
    if (folder.empty())
        GTEST_SKIP() << "the folder fabric is not there: TSUYA_TEST_CASES";
    const Scratch scratch;
    const std::vector<std::pair<std::string, std::string>> said = {
        {"bom.csv", ""},
        {"cr.csv", ""},
        {"order.csv", ""},
        {"theta_i_1e-6.csv", ""},
        {"negnoise.csv", "8 values below 0 within noise count as 0"},
        {"denorm.csv", "all values are 0: the cloth is black"},
        {"spike.csv", "stands alone"}};
    for (const auto &[name, words] : said) {
        const Outcome done =
            fit(scratch, (folder / name).string(), (scratch / "f.fabric.toml").string());
        EXPECT_TRUE(done.status == 0 || done.status == 1) << name << done.err;
        EXPECT_NE(done.err.find(words), std::string::npos) << name << "\n" << done.err;
        EXPECT_EQ(done.err.find("internal"), std::string::npos) << name << "\n" << done.err;
        if (words.empty()) {
            EXPECT_EQ(done.status, 0) << name << "\n" << done.err;
        }
    }
}

} // namespace
} // namespace tsuya::program
