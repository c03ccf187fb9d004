// tsuya fabric fit, from end to end.
#include <gtest/gtest.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "samples/fabric_run.h"
#include "tsuya/scene/read_cloth.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/reflectance_file.h"

namespace tsuya::program {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Scratch;

// What the sample satin would show under light from straight above and two views under each of six
// lights, its weft deeper than light from above tells, or as deep.
std::string dozen_table(const Scratch &scratch, double odd = 1, bool deeper = true) {
    Fabric fabric = read_fabric(satin());
    YarnLobes lobes = fit_yarn_lobes(*views_of(fabric), 0.05);
    if (deeper)
        lobes.pit = {0.1, 0.05};
    const YarnBrdf brdf(lobes);
    const auto direction = [](double theta, double phi) {
        return glm::vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                         std::cos(theta));
    };
    ReflectanceTable table{.symmetry = Symmetry::orthotropic};
    const auto add = [&](double theta_i, double phi_i, double theta, double phi, double times = 1) {
        const ReflectanceRow row{theta_i * kDegree, phi_i * kDegree, theta * kDegree,
                                 phi * kDegree};
        table.rows.push_back(row);
        table.rows.back().brdf_per_sr = times * brdf.evaluate(direction(row.theta_i, row.phi_i),
                                                              direction(row.theta_r, row.phi_r));
    };
    for (double theta = 0; theta < 86; theta += 5)
        for (double phi = 0; phi < 91 && (theta > 0 || phi == 0); phi += 10)
            add(0, 0, theta, phi);
    for (const auto &[theta, phi] :
         {std::pair{45, 45}, {60, 0}, {60, 45}, {60, 90}, {75, 0}, {75, 90}}) {
        add(theta, phi, theta, phi + 180);
        add(theta, phi, theta, phi + 216, theta == 60 && phi == 45 ? odd : 1);
    }
    const std::filesystem::path file = scratch / "dozen.csv";
    write_reflectance_table(table, file);
    return file.string();
}

TEST(FabricFit, WritesTheLustreThatIsAsked) {
    const Scratch scratch;
    const std::string table = (scene::data_folder() / "fabrics/black_satin.csv").string(),
                      file = (scratch / "f.fabric.toml").string();
    const auto fit = [&](const std::string &lustre) {
        return run_fabric(scratch, {"fit", table, "-o", file, "--lustre", lustre});
    };
    ASSERT_EQ(fit("semi-dull").status, 0);
    EXPECT_EQ(read_fabric(file).colours.lustre, Lustre::semi_dull);
    ASSERT_EQ(fit("bright").status, 0);
    EXPECT_EQ(read_fabric(file).colours.lustre, Lustre::bright);
    const Outcome wrong = fit("semidull");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("semi-dull"), std::string::npos) << wrong.err;
}

// sqrt(sum w (f c - m c)^2 / sum w (m c)^2) of the views in a report, w by the sine of theta.
double residual_of(const json &report) {
    double difference = 0, square = 0;
    for (const json &view : report.at("views")) {
        const double theta = view.at("theta_deg").get<double>() * kDegree;
        const double measured = view.at("brdf_per_sr"), fitted = view.at("fitted_per_sr");
        const double weight = std::sin(theta) * std::cos(theta) * std::cos(theta);
        difference += weight * (fitted - measured) * (fitted - measured);
        square += weight * measured * measured;
    }
    return std::sqrt(difference / square);
}

TEST(FabricFit, ReportsTheResidualOfTheModelThatItWrites) {
    const Scratch scratch;
    const std::string table = (scene::data_folder() / "fabrics/black_satin.csv").string(),
                      file = (scratch / "f.fabric.toml").string();
    const auto fit = [&](std::vector<std::string> more) {
        std::vector<std::string> call{"fit", table, "-o", file, "--json"};
        call.insert(call.end(), more.begin(), more.end());
        return run_fabric(scratch, call);
    };
    const Outcome free = fit({});
    const json report = json::parse(free.out);
    EXPECT_EQ(report.at("model").at("name"), "yarn");
    const json &left_out = report.at("model").at("l2_cos_left_out");
    EXPECT_LT(left_out.at("yarn").get<double>(), left_out.at("ggx").get<double>());
    EXPECT_NEAR(report.at("residual").get<double>(), residual_of(report), 0.01);
    EXPECT_LT(report.at("residual"), 0.15);
    EXPECT_EQ(free.err, "");
    // An ideal diffuser is far from satin
    const Outcome lambert = fit({"--model", "lambert"});
    EXPECT_EQ(lambert.status, 0);
    const json worse = json::parse(lambert.out);
    EXPECT_NEAR(worse.at("residual").get<double>(), residual_of(worse), 0.02);
    EXPECT_GT(worse.at("residual"), 0.5);
    EXPECT_FALSE(worse.at("model").contains("l2_cos_left_out"));
    EXPECT_NE(lambert.err.find("the model lambert misses the views by l2_cos 0."),
              std::string::npos)
        << lambert.err;
    EXPECT_EQ(std::get<CarriedViews>(read_fabric(file).specular).model, ViewModel::lambert);
}

TEST(FabricFit, SaysWhereADraftDoesNotExplainTheYarns) {
    const Scratch scratch;
    const std::string table = (scene::data_folder() / "fabrics/black_satin.csv").string(),
                      file = (scratch / "f.fabric.toml").string();
    const auto fit = [&](const std::string &weave) {
        return run_fabric(scratch, {"fit", table, "-o", file, "--json", "--weave", weave});
    };
    const Outcome own = fit("black polyester satin"), other = fit("polyester taffeta");
    EXPECT_EQ(own.err, "");
    EXPECT_EQ(read_fabric(file).weave->preset, "polyester taffeta");
    const json covers = json::parse(own.out).at("weave");
    EXPECT_NEAR(covers.at("warp").at("on_face").get<double>(), 0.875, 0.01);
    EXPECT_NEAR(covers.at("warp").at("fitted").get<double>() /
                    covers.at("weft").at("fitted").get<double>(),
                0.875 / 0.125, 2);
    EXPECT_NE(other.err.find("the draft of polyester taffeta does not explain the fitted yarns: it "
                             "has 40 % weft and 60 % warp"),
              std::string::npos)
        << other.err << other.out;
    EXPECT_EQ(fit("no such weave").status, 2);
}

// A fitted fabric shows its yarns close up, wherever it and the weave's file lie.
TEST(FabricFit, NamesTheWeave) {
    const Scratch scratch;
    const std::string table = (scene::data_folder() / "fabrics/black_satin.csv").string(),
                      wif = (scene::data_folder() / "weaves/eight_end_satin.wif").string();
    const std::filesystem::path file = scratch / "f/f.fabric.toml";
    std::filesystem::create_directories(scratch / "f");
    std::filesystem::copy_file(wif, scratch / "dress.wif");
    const auto fitted = [&](std::vector<std::string> more) {
        std::vector<std::string> call{"fit", table, "-o", file.string()};
        call.insert(call.end(), more.begin(), more.end());
        const Outcome made = run_fabric(scratch, call);
        EXPECT_EQ(made.status, 0) << made.err;
        return scene::read_cloth(file).weave;
    };
    const auto draft = fitted({"--weave", (scratch / "dress.wif").string()});
    ASSERT_TRUE(draft);
    EXPECT_EQ(draft->file, "../dress.wif");
    EXPECT_TRUE(draft->has_map());
    const auto preset = fitted({"--weave", "black polyester satin"});
    ASSERT_TRUE(preset);
    EXPECT_EQ(preset->preset, "black polyester satin");
    EXPECT_FALSE(fitted({}));
    EXPECT_FALSE(fitted({"--model", "takeda", "--weave", "black polyester satin"}));
}

TEST(FabricFit, TakesFacetsForViewsThatFacetsMade) {
    const Scratch scratch;
    const GgxBrdf facets({.alpha_weft = 0.3, .alpha_warp = 0.3});
    ReflectanceTable table{.symmetry = Symmetry::orthotropic};
    for (int theta = 0; theta < 86; theta += 5)
        for (int phi = 0; phi < 91 && (theta > 0 || phi == 0); phi += 15) {
            ReflectanceRow row{0, 0, theta * kDegree, phi * kDegree};
            row.brdf_per_sr =
                static_cast<double>(facets.evaluate({0, 0, 1}, glm::vec3(row.to_viewer())));
            table.rows.push_back(row);
        }
    const std::string file = (scratch / "f.fabric.toml").string(),
                      csv = (scratch / "t.csv").string();
    write_reflectance_table(table, csv);
    const Outcome fitted = run_fabric(scratch, {"fit", csv, "-o", file});
    ASSERT_EQ(fitted.status, 0) << fitted.err;
    EXPECT_NE(fitted.out.find("model ggx: l2_cos 0.0"), std::string::npos) << fitted.out;
    EXPECT_EQ(std::get<CarriedViews>(read_fabric(file).specular).model, ViewModel::ggx);
}

TEST(FabricFit, RefusesModelsThatDoNotCarryViews) {
    const Scratch scratch;
    const std::string file = (scratch / "f.fabric.toml").string(), table = dozen_table(scratch);
    const Outcome none = run_fabric(scratch, {"fit", table, "-o", file, "--model", "tabulated"});
    EXPECT_EQ(none.status, 2);
    EXPECT_NE(none.err.find("half_vector"), std::string::npos) << none.err;
    const Outcome both =
        run_fabric(scratch, {"fit", table, "-o", file, "--model", "ggx", "--use", "all"});
    EXPECT_EQ(both.status, 2);
    EXPECT_NE(both.err.find("--use all"), std::string::npos) << both.err;
    EXPECT_FALSE(fs::exists(file));
}

TEST(FabricFit, UsesObliqueViewsIfAsked) {
    const Scratch scratch;
    const std::string table = dozen_table(scratch), normal = (scratch / "n.fabric.toml").string(),
                      all = (scratch / "a.fabric.toml").string();
    const auto fit = [&](const std::string &use, const std::string &file) {
        return run_fabric(scratch,
                          {"fit", table, "-o", file, "--f0", "0.05", "--use", use, "--json"});
    };
    const Outcome above = fit("normal", normal), both = fit("all", all);
    ASSERT_EQ(above.status, 0) << above.err;
    ASSERT_EQ(both.status, 0) << both.err;
    const json before = json::parse(above.out)["oblique"], after = json::parse(both.out)["oblique"];
    EXPECT_EQ(before.at("fitted"), false);
    EXPECT_EQ(after.at("fitted"), true);
    EXPECT_EQ(after.at("lights"), 6);
    EXPECT_EQ(after.at("views").size(), 12u);
    EXPECT_NEAR(after.at("pit_weft").get<double>(), 0.1, 0.026);
    EXPECT_NEAR(after.at("pit_warp").get<double>(), 0.05, 0.026);
    EXPECT_NEAR(after.at("l2_cos_from_above").get<double>(), before.at("l2_cos").get<double>(),
                1e-6);
    EXPECT_LT(after.at("l2_cos"), 0.5 * before.at("l2_cos").get<double>());
    const json &left_out = after.at("l2_cos_left_out");
    EXPECT_LT(left_out.at("all").get<double>(), left_out.at("from_above").get<double>());
    EXPECT_TRUE(std::holds_alternative<CarriedViews>(read_fabric(normal).specular));
    const Fabric fitted = read_fabric(all);
    ASSERT_TRUE(std::holds_alternative<YarnLobes>(fitted.specular));
    EXPECT_NEAR(std::get<YarnLobes>(fitted.specular).pit[0], after.at("pit_weft").get<double>(),
                1e-9);
    EXPECT_TRUE(views_of(fitted)) << "the views are kept";
    const Outcome text = run_fabric(scratch, {"fit", table, "-o", all, "--use", "all"});
    EXPECT_NE(text.out.find("oblique views 12 under 6 lights, fitted: l2_cos"), std::string::npos);
    EXPECT_NE(text.out.find("; the fit to all views is kept"), std::string::npos) << text.out;
}

TEST(FabricFit, KeepsTheFitFromAboveWhereObliqueViewsContradict) {
    const Scratch scratch;
    const std::string table = dozen_table(scratch, 1, false),
                      file = (scratch / "f.fabric.toml").string();
    ReflectanceTable odd = read_reflectance_table(table);
    int i = 0;
    for (ReflectanceRow &row : odd.rows)
        if (!row.from_above())
            row.brdf_per_sr *= (i + i / 2) % 2 == 0 ? 3 : 1.0 / 3, ++i;
    write_reflectance_table(odd, table);
    const Outcome text = run_fabric(scratch, {"fit", table, "-o", file, "--use", "all"});
    ASSERT_EQ(text.status, 0) << text.err;
    EXPECT_NE(text.out.find("; the fit from above alone is kept"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("oblique views 12 under 6 lights, not fitted"), std::string::npos);
    const Outcome machine =
        run_fabric(scratch, {"fit", table, "-o", file, "--use", "all", "--json"});
    const json oblique = json::parse(machine.out).at("oblique");
    EXPECT_EQ(oblique.at("fitted"), false);
    EXPECT_EQ(oblique.at("l2_cos"), oblique.at("l2_cos_from_above"));
    const json &left_out = oblique.at("l2_cos_left_out");
    EXPECT_GT(left_out.at("all").get<double>(), left_out.at("from_above").get<double>());
    const Fabric fitted = read_fabric(file);
    const YarnLobes written = std::get<YarnLobes>(fitted.specular),
                    from_above = fit_yarn_lobes(*views_of(fitted), kFibreF0);
    EXPECT_NEAR(written.roughness, from_above.roughness, 1e-4);
    EXPECT_NEAR(written.pit[0], from_above.pit[0], 1e-3);
}

TEST(FabricFit, NamesObliqueViewsThatDoNotFit) {
    const Scratch scratch;
    const std::string file = (scratch / "a.fabric.toml").string();
    const Outcome odd = run_fabric(
        scratch, {"fit", dozen_table(scratch, 0.003), "-o", file, "--f0", "0.05", "--use", "all"});
    EXPECT_EQ(odd.status, 0);
    EXPECT_NE(odd.err.find("theta 60, phi 261 under light at theta_i 60, phi_i 45"),
              std::string::npos)
        << odd.err;
}

TEST(FabricFit, RefusesObliqueViewsThatAreNone) {
    const Scratch scratch;
    const std::string file = (scratch / "n/a.fabric.toml").string();
    ReflectanceTable above = read_reflectance_table(dozen_table(scratch)).normal_incidence();
    write_reflectance_table(above, scratch / "above.csv");
    const Outcome none =
        run_fabric(scratch, {"fit", (scratch / "above.csv").string(), "-o", file, "--use", "all"});
    EXPECT_EQ(none.status, 1);
    EXPECT_NE(none.err.find("0 views under oblique light"), std::string::npos) << none.err;
    EXPECT_FALSE(fs::exists(scratch / "n"));
    EXPECT_EQ(
        run_fabric(scratch, {"fit", (scratch / "above.csv").string(), "-o", file, "--use", "some"})
            .status,
        2);
}

} // namespace
} // namespace tsuya::program
