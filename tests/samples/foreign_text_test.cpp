// Files as other programs and instruments write them, given to the program.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "samples/process.h"
#include "samples/scratch.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::program {
namespace {

using nlohmann::json;
using scene::Scratch;

// What `garment check` says of a rectangle of 0.5 x 0.7 m whose file begins with these bytes.
json report_of_mesh(const std::string &start) {
    const Scratch scratch;
    const std::string mesh =
        scratch.write("m.obj", start + "v 0 0 0\nv 0.5 0 0\nv 0.5 0.7 0\nv 0 0.7 0\nf 1 2 3 4\n")
            .string();
    const Outcome done = run_program({"garment", "check", mesh, "--json"}, scratch.folder());
    EXPECT_EQ(done.status, 0) << done.err;
    return json::parse(done.out);
}

TEST(ForeignMesh, AByteOrderMarkCostsNoVertex) {
    const json report = report_of_mesh("\xEF\xBB\xBF");
    ASSERT_EQ(report.at("openings").size(), 1u);
    EXPECT_NEAR(report.at("openings")[0].at("length").get<double>(), 2.4, 1e-9);
}

TEST(ForeignMesh, AKoreanNameIsShownEscaped) {
    const std::string report = report_of_mesh("g \xBE\xD5\xC6\xC7\n").dump();
    EXPECT_NE(report.find("\\\\xBE\\\\xD5"), std::string::npos) << report;
}

// They could move the cursor of a terminal or change its colours.
TEST(ForeignMesh, ControlCharactersInNamesAreShownEscaped) {
    const Scratch scratch;
    const std::string name = "a\x1b[31m\x7f\xC2\x9B"
                             "1m \xE5\xB8\x83";
    const std::string escaped = "a\\x1B[31m\\x7F\\xC2\\x9B1m \xE5\xB8\x83";
    const std::string mesh =
        scratch
            .write("m.obj", "o " + name + "\ng " + name +
                                "\nv 0 0 0\nv 0.5 0 0\nv 0.5 0.7 0\nv 0 0.7 0\nf 1 2 3 4\n"
                                "g " +
                                name + "2\nf 1 3 2\nf 1 2 3\nf 1 2 4\n")
            .string();
    const Outcome checked = run_program({"garment", "check", mesh}, scratch.folder());
    EXPECT_NE(checked.out.find("panel " + escaped), std::string::npos);
    const Outcome refused =
        run_program({"tryon", "--garment", mesh, "--grain", "vertical", "--fabric",
                     "none*=black_satin", "-o", (scratch / "out").string()},
                    scratch.folder());
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find(escaped), std::string::npos) << refused.err;
    for (const std::string &said : {checked.out, refused.err})
        for (const char *control : {"\x1b", "\x7f", "\xC2\x9B"})
            EXPECT_EQ(said.find(control), std::string::npos) << said;
}

// A tube along z with two openings, 0.6 m high.
std::string tube_along_z() {
    std::string text;
    const auto number = [](double value) { return " " + std::to_string(value); };
    for (int ring = 0; ring <= 3; ++ring)
        for (int i = 0; i < 8; ++i)
            text += "v" + number(0.2 * std::cos(i * kPi / 4)) +
                    number(0.2 * std::sin(i * kPi / 4)) + number(0.2 * ring) + "\n";
    for (int ring = 0; ring < 3; ++ring)
        for (int i = 0; i < 8; ++i) {
            const int a = 8 * ring + i + 1, b = 8 * ring + (i + 1) % 8 + 1;
            for (const int v : {a, b, b + 8, a + 8})
                text += (v == a ? "f " : " ") + std::to_string(v);
            text += "\n";
        }
    return text;
}

TEST(ForeignMesh, ZUpIsFoundAndCanBeStated) {
    const Scratch scratch;
    const std::string mesh = scratch.write("tube.obj", tube_along_z()).string();
    const Outcome found = run_program({"garment", "check", mesh}, scratch.folder());
    EXPECT_NE(found.out.find("warning probably_z_up: "), std::string::npos) << found.out;
    EXPECT_NE(found.out.find("--up z"), std::string::npos);
    const Outcome stated =
        run_program({"garment", "check", mesh, "--up", "z", "--json"}, scratch.folder());
    ASSERT_EQ(stated.status, 0) << stated.err;
    EXPECT_EQ(stated.out.find("probably_z_up"), std::string::npos);
    const std::string fine = (scratch.folder() / "fine.obj").string();
    ASSERT_EQ(run_program({"garment", "subdivide", mesh, "-o", fine, "--up", "z", "--level", "0",
                           "--grain", "vertical"},
                          scratch.folder())
                  .status,
              0);
    const Outcome turned = run_program({"garment", "check", fine}, scratch.folder());
    EXPECT_NE(turned.out.find(" x 0.6 x "), std::string::npos) << turned.out;
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
    // The coloured part follows the yarns, as that of any dyed fabric
    EXPECT_EQ(read_file(fabric).find("delustre"), std::string::npos);
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
}

TEST(ForeignTable, AChannelIsComparedByItsName) {
    const Scratch scratch;
    const auto rows = [](const char *header, double factor) {
        return quadrant(header, [=](int theta, int phi) {
            std::string row = "0,0," + std::to_string(theta) + "," + std::to_string(phi);
            for (double value = cloth_value(theta, phi, 0.1), c = 1; c > 0.2; c *= factor)
                row += "," + std::to_string(value * c);
            return row;
        });
    };
    const std::string angles = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,";
    const std::string fabric = (scratch / "f.fabric.toml").string();
    const std::string red = scratch.write("red.csv", rows(kHeader.c_str(), 0)).string();
    const std::string all =
        scratch.write("all.csv", rows((angles + "brdf_r,brdf_g,brdf_b").c_str(), 0.5)).string();
    ASSERT_EQ(fit(scratch, red, fabric).status, 0);
    const auto evaluate = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"fabric", "evaluate", fabric, "--json", "--against"});
        return run_program(more, scratch.folder());
    };
    const auto l2_cos = [](const Outcome &done) {
        EXPECT_EQ(done.status, 0) << done.err;
        return json::parse(done.out).at("results")[0].at("mean").at("l2_cos").get<double>();
    };
    const Outcome of_red = evaluate({all, "--channel", "r"});
    EXPECT_NEAR(l2_cos(of_red), l2_cos(evaluate({red})), 1e-4);
    EXPECT_EQ(json::parse(of_red.out).at("channel"), "r");
    EXPECT_GT(l2_cos(evaluate({all, "--channel", "g"})), 0.5); // half as bright
    for (const auto &[more, says] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{all}, "has 3 channels; expected one of: r, g, b"},
             {{all, "--channel", "x"}, "has 3 channels, and none is 'x'; expected one of: r, g, b"},
             {{red, "--channel", "r"},
              "has one column of values and no channels; leave the option out"}}) {
        const Outcome wrong = evaluate(more);
        EXPECT_EQ(wrong.status, 1);
        EXPECT_NE(wrong.err.find(says), std::string::npos) << wrong.err;
    }
}

// Tables of which no cloth can be made, or hardly one: a fabric and one clear line.
TEST(ForeignTable, OddTablesGiveAFabricAndOneLine) {
    const Scratch scratch;
    const auto rows_of = [](const auto &value) {
        return quadrant("# symmetry: orthotropic\n" + kHeader, [&](int theta, int phi) {
            return "0,0," + std::to_string(theta) + "," + std::to_string(phi) + "," +
                   value(theta, phi);
        });
    };
    const std::vector<std::pair<std::string, std::string>> said = {
        {rows_of([](int, int) { return "1e-320"; }), "all values are 0: the cloth is black"},
        {rows_of([](int theta, int phi) { return theta == 20 && phi == 90 ? "1" : "0"; }),
         "stands alone"},
        {rows_of([](int theta, int phi) {
             return theta == 80 ? "-0.0005" : std::to_string(cloth_value(theta, phi, 0));
         }),
         "7 values below 0 within noise count as 0"}};
    for (const auto &[table, words] : said) {
        const Outcome done = fit(scratch, scratch.write("odd.csv", table).string(),
                                 (scratch / "f.fabric.toml").string());
        EXPECT_EQ(done.status, 0) << done.err;
        EXPECT_NE(done.err.find(words), std::string::npos) << done.err;
    }
}

} // namespace
} // namespace tsuya::program
