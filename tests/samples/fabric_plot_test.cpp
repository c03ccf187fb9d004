// tsuya fabric show --view: the pictures, and the numbers in them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <vector>

#include "samples/fabric_run.h"
#include "tsuya/scene/lobe_plot.h"
#include "tsuya/scene/ring_plot.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/model.h"

namespace tsuya::program {
namespace {

namespace fs = std::filesystem;
using scene::Scratch;

Outcome show(const Scratch &scratch, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"fabric", "show", satin().string()});
    return run_program(arguments, scratch.folder());
}

glm::dvec3 direction(double theta_deg, double phi_deg) {
    const double theta = theta_deg * kDegree, phi = phi_deg * kDegree;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

std::string ring_table(const Scratch &scratch) {
    return scratch
        .write("ring.csv", "# symmetry: orthotropic\n"
                           "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr,sigma_per_sr\n"
                           "45,90,60,0,0.2,0.01\n45,90,60,270,0.4,0.02\n45,90,50,270,0.3,0.02\n")
        .string();
}

std::size_t count(const std::string &text, const std::string &word) {
    std::size_t found = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        ++found;
    return found;
}

using Rows = std::vector<std::vector<double>>;

// The data that gnuplot is given: a program of that name stands in for it, and keeps its script.
std::map<std::string, Rows> data_of(const Scratch &scratch, std::vector<std::string> arguments) {
    fs::create_directories(scratch / "bin");
    const fs::path stand_in = scratch.write(
        "bin/gnuplot", "#!/bin/sh\ncp \"$1\" '" + (scratch / "script").string() +
                           "'\neval \"$(sed -n \"s/^set output /: > /p\" \"$1\")\"\n");
    fs::permissions(stand_in, fs::perms::owner_all);
    const std::string path = std::getenv("PATH") ? std::getenv("PATH") : "";
    setenv("PATH", ((scratch / "bin").string() + ":" + path).c_str(), 1);
    arguments.insert(arguments.end(), {"-o", (scratch / "a.svg").string()});
    const Outcome done = show(scratch, arguments);
    setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(done.status, 0) << done.err;
    std::map<std::string, Rows> blocks;
    std::istringstream in(read_file(scratch / "script"));
    Rows *block = nullptr;
    for (std::string line; std::getline(in, line);) {
        if (line.ends_with(" << END"))
            block = &blocks[line.substr(1, line.find(' ') - 1)];
        else if (line == "END")
            block = nullptr;
        else if (block && !line.empty()) {
            std::istringstream words(line);
            block->emplace_back();
            for (std::string word; words >> word;)
                block->back().push_back(std::strtod(word.c_str(), nullptr));
        }
    }
    return blocks;
}

TEST(FabricPlot, DrawsEveryViewInASmallFile) {
    if (std::system("command -v gnuplot >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "gnuplot is not installed";
    const Scratch scratch;
    const std::map<std::string, std::string> labels = {{"lobes", "Light in the bias plane"},
                                                       {"bodies", "seen from above"},
                                                       {"map", "42.5° of tilt: extrapolated"},
                                                       {"rings", "phi_r from the weft, degrees"}};
    for (const auto &[view, label] : labels) {
        const fs::path svg = scratch / (view + ".svg");
        const Outcome drawn = show(scratch, {"--view", view, "-o", svg.string()});
        ASSERT_EQ(drawn.status, 0) << drawn.err;
        const std::string text = read_file(svg);
        EXPECT_NE(text.find(label), std::string::npos) << view;
        EXPECT_LT(text.size(), 250'000u) << view;
        EXPECT_EQ(count(text, "<g "), count(text, "</g>")) << view;
        EXPECT_GT(count(text, "<g "), 50u) << view;
    }
}

TEST(FabricPlot, RingsAreThoseOfTheModelAndTheTable) {
    const Scratch scratch;
    auto data = data_of(scratch, {"--view", "rings", "--model", "takeda,half_vector", "--against",
                                  ring_table(scratch)});
    const Fabric fabric = read_fabric(satin());
    for (const char *name : {"takeda", "half_vector"}) {
        const BrdfFunction f = make_model(name, fabric, "satin");
        const Rows &bias = data[std::string(name) + "_bias_60"];
        ASSERT_GT(bias.size(), 20u);
        for (const auto &row : bias) {
            const double truth = f(direction(45, 45), direction(60, row[0]));
            EXPECT_NEAR(row[1], truth, 1e-5 * truth + 1e-9) << name << " at " << row[0];
        }
    }
    const Rows measured = {{0, 0.2, 0.01}, {270, 0.4, 0.02}};
    ASSERT_EQ(data["measured_warp_60"].size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(data["measured_warp_60"][i][k], measured[i][k], 1e-6);
    EXPECT_EQ(data.count("measured_warp_30") + data.count("measured_weft_60"), 0u);
}

// No point of the lobe lies outside its shadow, and the shadow is no larger than needed.
TEST(FabricPlot, OutlinesHoldTheLobe) {
    const Scratch scratch;
    auto data = data_of(scratch, {"--view", "bodies", "--model", "half_vector"});
    const BrdfFunction f = make_model("half_vector", read_fabric(satin()), "satin");
    const Rows &outline = data["body_warp_above_45"];
    ASSERT_GT(outline.size(), 20u);
    double across = 0, along = 0, drawn_across = 0, drawn_along = 0, most = 0;
    for (double theta = 0; theta < 90; ++theta)
        for (double phi = 0; phi < 360; ++phi) {
            const glm::dvec3 view = direction(theta, phi);
            const double radius = f(direction(45, 90), view) * view.z;
            most = std::max(most, radius);
            across = std::max(across, radius * view.x);
            along = std::max(along, -radius * view.y);
        }
    for (const auto &row : outline) {
        drawn_across = std::max(drawn_across, row[0]);
        drawn_along = std::max(drawn_along, -row[1]);
    }
    EXPECT_NEAR(drawn_across, across / most, 0.01);
    EXPECT_NEAR(drawn_along, along / most, 0.01);
}

TEST(FabricPlot, TakesTheDefaultModelOfFabrics) {
    EXPECT_EQ(scene::LobePlot{}.model, kDefaultModel);
    EXPECT_EQ(scene::RingPlot{}.models, std::vector<std::string>{kDefaultModel});
}

TEST(FabricPlot, FacetsFollowTheirEquation) {
    const Scratch scratch;
    auto data = data_of(scratch, {"--view", "map"});
    const Fabric fabric = read_fabric(satin());
    const double f0 = *find_specular<CarriedViews>(fabric)->f0;
    std::size_t shown = 0, striped = 0;
    for (const auto &row : data["facets"]) {
        const double tilt = std::hypot(row[0], row[1]);
        const bool stripe = std::isnan(row[2]);
        EXPECT_TRUE(!stripe || tilt > 42.5) << "the table has views to 85 degrees";
        striped += stripe && tilt < 90;
        if (stripe || tilt > 44.9)
            continue;
        // [Takeda] Eqs. 3-5 with L = N
        const glm::dvec3 view = direction(2 * tilt, std::atan2(row[1], row[0]) / kDegree);
        const double g = std::min(1.0, 2 * view.z);
        const double fresnel = f0 + (1 - f0) * std::pow(1 - std::cos(tilt * kDegree), 5);
        const double d = views_of(fabric)->at(view) * view.z / (g * fresnel);
        ASSERT_NEAR(row[2], d, 2e-5 * d) << row[0] << " " << row[1];
        ++shown;
    }
    EXPECT_GT(shown, 5500u);
    EXPECT_GT(striped, 2000u);
}

TEST(FabricPlot, RefusesWhatItCannotDraw) {
    const Scratch scratch;
    const auto expect = [&](std::vector<std::string> arguments, int status, const char *says) {
        arguments.insert(arguments.end(), {"-o", (scratch / "a.svg").string()});
        const Outcome refused = show(scratch, arguments);
        EXPECT_EQ(refused.status, status) << refused.err;
        EXPECT_NE(refused.err.find(says), std::string::npos) << refused.err;
        EXPECT_FALSE(fs::exists(scratch / "a.svg"));
    };
    const std::string table = ring_table(scratch);
    expect({"--view", "bodie"}, 2, "bodies");
    expect({"--view", "rings", "--theta-i", "90"}, 2, "--theta-i");
    expect({"--view", "rings", "--model", "takedo"}, 2, "did you mean takeda");
    expect({"--view", "rings", "--theta-i", "30", "--against", table}, 1, "lies on a ring");
    expect({"--view", "bodies", "--against", table}, 2, "no effect on --view bodies");
    expect({"--view", "map", "--model", "yarn"}, 2, "no effect on --view map");
    expect({"--model", "takeda,yarn"}, 2, "no effect on --view lobes");
    expect({"--theta-i", "30"}, 2, "no effect on --view lobes");
}

} // namespace
} // namespace tsuya::program
