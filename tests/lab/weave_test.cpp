#include "tsuya/lab/weave.h"

#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tsuya/lab/goniometer.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

class WeaveFile : public testing::Test {
  protected:
    WeaveFile()
        : folder_(std::filesystem::temp_directory_path() /
                  ("tsuya_weave_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~WeaveFile() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string &name, const std::string &text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    std::vector<Problem> problems_of(const std::string &text) const {
        try {
            read_weave(write("bad.toml", text));
        } catch (const Error &error) {
            return error.problems();
        }
        return {};
    }

  private:
    std::filesystem::path folder_;
};

TEST(Weave, PresetsHold) {
    ASSERT_EQ(weave_names().size(), 6u);
    for (const std::string &name : weave_names()) {
        const Weave cloth = weave(name);
        EXPECT_EQ(cloth.name, name);
        check_weave(cloth, name);
    }
    EXPECT_EQ(weave("black polyester satin").draft, satin(5, 2));
    EXPECT_EQ(weave("silk charmeuse").draft, satin(8, 3));
    EXPECT_NE(weave("shot silk").warp.transmission, weave("shot silk").weft.transmission);
    try {
        weave("shot silks", "fabric.toml:1:2");
        ADD_FAILURE();
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].where, "fabric.toml:1:2");
        EXPECT_NE(error.problems()[0].accepted.find("did you mean shot silk"), std::string::npos);
    }
}

TEST(Weave, OpticsFollowMaterialDyeAndWavelength) {
    const Weave shot = weave("shot silk");
    EXPECT_DOUBLE_EQ(transmission(shot.warp, 610), shot.warp.transmission[0]);
    EXPECT_DOUBLE_EQ(transmission(shot.warp, 550), shot.warp.transmission[1]);
    EXPECT_DOUBLE_EQ(transmission(shot.warp, 465), shot.warp.transmission[2]);
    EXPECT_DOUBLE_EQ(transmission(shot.warp, 700), shot.warp.transmission[0]);
    EXPECT_DOUBLE_EQ(transmission(shot.warp, 400), shot.warp.transmission[2]);
    EXPECT_NEAR(transmission(shot.warp, 580),
                (shot.warp.transmission[0] + shot.warp.transmission[1]) / 2, 1e-12);
    EXPECT_NEAR(optics(shot.warp, 589).refractive_index, 1.560, 0.001);
    EXPECT_EQ(optics(weave("black polyester satin").warp, 500).transmission, 0);
    EXPECT_EQ(optics({.refractive_index = 1.7}, 500).refractive_index, 1.7);
}

TEST(Weave, SymmetryIsThatOfDraftAndTwist) {
    EXPECT_EQ(symmetry_of(weave("polyester taffeta")), Symmetry::orthotropic);
    for (const char *name : {"black polyester satin", "twill lining", "silk charmeuse"})
        EXPECT_EQ(symmetry_of(weave(name)), Symmetry::half_turn) << name;
    Weave cloth;
    cloth.draft = twill(2, 2);
    EXPECT_FALSE(is_same_reversed(cloth.draft, true, false)); // the line rises the other way
    EXPECT_TRUE(is_same_reversed(cloth.draft, true, true));
    cloth.draft = plain_weave();
    cloth.warp.twist_per_m = 500;
    EXPECT_EQ(symmetry_of(cloth), Symmetry::half_turn);
    // A hook: no mirror and no turn brings it back
    cloth.draft = {4, 4, {1, 1, 1, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 1}};
    EXPECT_EQ(symmetry_of(cloth), Symmetry::none);
}

TEST(Weave, ViewsFromAboveCoverWhatTheSymmetryLeaves) {
    const auto count = [](Symmetry symmetry) {
        const Directions directions = normal_incidence(15, symmetry);
        EXPECT_EQ(directions.symmetry, symmetry);
        return directions.pairs.size();
    };
    EXPECT_EQ(count(Symmetry::orthotropic), 1u + 5 * 7); // 0 to 90 degrees
    EXPECT_EQ(count(Symmetry::half_turn), 1u + 5 * 12);  // 0 to 165
    EXPECT_EQ(count(Symmetry::none), 1u + 5 * 24);       // 0 to 345
}

TEST(Weave, NumbersOutOfRangeAreNamed) {
    Weave cloth = weave("polyester taffeta");
    cloth.weft.flattening = 1.5;
    try {
        check_weave(cloth, "cloth");
        ADD_FAILURE();
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].where, "cloth.weft");
        EXPECT_TRUE(error.problems()[0].what.starts_with("flattening is 1.5"));
    }
    cloth = weave("polyester taffeta");
    cloth.warp.width = 1.01 * kMostPressed * cloth.warp.spacing();
    EXPECT_THROW(check_weave(cloth, "cloth"), Error);
    cloth = weave("polyester taffeta");
    cloth.warp.surface_roughness = 0.0 / 0.0;
    EXPECT_THROW(check_weave(cloth, "cloth"), Error);
}

TEST_F(WeaveFile, TomlSaysAllOfAWeave) {
    const Weave cloth = read_weave(write("cloth.toml", R"(
[weave]
name = "mine"
plan = ["X..X", "..XX", ".XX.", "XX.."]
[warp]
per_cm = 50
width_mm = 0.19
flattening = 0.31
filaments = 48
section = "trilobal"
corner_rounding = 0.25
twist_per_m = -120
tension = 2.5
material = "silk"
surface_roughness = 0.05
transmission = [0.5, 0.25, 0.125]
[weft]
refractive_index = 1.66
)"));
    EXPECT_EQ(cloth.name, "mine");
    EXPECT_EQ(cloth.draft, twill(2, 2));
    EXPECT_DOUBLE_EQ(cloth.warp.per_cm, 50);
    EXPECT_DOUBLE_EQ(cloth.warp.width, 0.19e-3);
    EXPECT_DOUBLE_EQ(cloth.warp.flattening, 0.31);
    EXPECT_EQ(cloth.warp.filaments, 48);
    EXPECT_EQ(cloth.warp.section, FilamentSection::trilobal);
    EXPECT_DOUBLE_EQ(cloth.warp.corner_rounding, 0.25);
    EXPECT_DOUBLE_EQ(cloth.warp.twist_per_m, -120);
    EXPECT_DOUBLE_EQ(cloth.warp.tension, 2.5);
    EXPECT_EQ(cloth.warp.material, FiberMaterial::silk);
    EXPECT_DOUBLE_EQ(cloth.warp.surface_roughness, 0.05);
    EXPECT_EQ(cloth.warp.transmission, (std::array<double, 3>{0.5, 0.25, 0.125}));
    EXPECT_EQ(cloth.weft.refractive_index, 1.66);
    EXPECT_DOUBLE_EQ(cloth.weft.per_cm, weave("polyester taffeta").weft.per_cm);
}

TEST_F(WeaveFile, APresetIsTheGroundOfWhatIsNotSaid) {
    const Weave cloth = read_weave(
        write("cloth.toml", "[weave]\npreset = \"silk charmeuse\"\n[weft]\ntwist_per_m = 0\n"));
    EXPECT_EQ(cloth.draft, satin(8, 3));
    EXPECT_EQ(cloth.name, "silk charmeuse");
    EXPECT_EQ(cloth.weft.twist_per_m, 0);
    EXPECT_EQ(cloth.weft.filaments, weave("silk charmeuse").weft.filaments);
}

TEST_F(WeaveFile, WhatIsWrongIsToldWithItsPlace) {
    struct Row {
        const char *text, *where, *what;
    };
    const Row rows[] = {
        {"[weave]\ndraft = \"satan 5\"\n", ":2:", "unknown draft \"satan 5\""},
        {"[weave]\npreset = \"silk\"\n", ":2:", "unknown weave \"silk\""},
        {"[weave]\nname = \"x\"\n", ":1:", "no draft, plan or preset"},
        {"[weave]\ndraft = \"plain\"\nplan = [\"X.\", \".X\"]\n", ":3:", "both a draft and a plan"},
        {"[weave]\nplan = [\"X.\", \".\"]\n", ":2:", "rows of different length"},
        {"[weave]\nplan = [\"X.\", \".Y\"]\n", ":2:", "'Y' in a plan"},
        {"[weave]\nplan = [\"XX\", \".X\"]\n", ":2:", "warp end 2 floats for ever"},
        {"[weave]\nplan = []\n", ":2:", "a repeat of 0 ends and 0 picks"},
        {"[warp]\nper_cm = 40\n", "", "section [weave] is missing"},
        {"[weave]\ndraft = \"plain\"\n[warp]\nsection = \"square\"\n",
         ":4:", "unknown filament section \"square\""},
        {"[weave]\ndraft = \"plain\"\n[warp]\nmaterial = \"nylon\"\n",
         ":4:", "unknown material \"nylon\""},
        {"[weave]\ndraft = \"plain\"\n[warp]\ntransmission = [0, 0]\n", ":4:", "not three shares"},
        {"[weave]\ndraft = \"plain\"\n[warp]\ntransmission = [0, 0, 2]\n",
         ":4:", "not three shares"},
        {"[weave]\ndraft = \"plain\"\n[warp]\nper_cm = 80\nwidth_mm = 0.3\n",
         ":5:", "yarns 0.300000 mm wide lie 0.125000 mm apart"},
    };
    for (const Row &row : rows) {
        SCOPED_TRACE(row.text);
        const std::vector<Problem> problems = problems_of(row.text);
        ASSERT_FALSE(problems.empty());
        EXPECT_EQ(problems[0].what, row.what);
        EXPECT_NE(problems[0].where.find(std::string("bad.toml") + row.where), std::string::npos)
            << problems[0].where;
        EXPECT_FALSE(problems[0].accepted.empty());
    }
}

TEST_F(WeaveFile, UnknownKeysAreRefusedWithASuggestion) {
    const std::vector<Problem> problems = problems_of(
        "[weave]\ndraft = \"plain\"\n[warp]\nper_cn = 40\nflattening = 3\n[wept]\nfilaments = 3\n");
    ASSERT_EQ(problems.size(), 3u);
    bool suggested = false;
    for (const Problem &problem : problems)
        suggested |= problem.where.find(":4:") != std::string::npos &&
                     problem.accepted.find("per_cm") != std::string::npos;
    EXPECT_TRUE(suggested);
}

TEST_F(WeaveFile, TellsTheLustreByNameOrLength) {
    const Weave cloth = read_weave(write("lustre.toml", "[weave]\ndraft = \"plain\"\n"
                                                        "[warp]\nlustre = \"dull\"\n"
                                                        "[weft]\nlustre = 25\n"));
    EXPECT_EQ(cloth.warp.scattering_length, scattering_length("dull"));
    EXPECT_LT(scattering_length("dull"), scattering_length("semi-dull"));
    EXPECT_EQ(scattering_length("bright"), 0);
    EXPECT_NEAR(cloth.weft.scattering_length, 25e-6, 1e-12);
    EXPECT_NEAR(optics(cloth.weft, 550).scattering_length, 25e-6, 1e-12);
    for (const char *bad : {"\"dul\"", "0", "true"})
        EXPECT_FALSE(
            problems_of("[weave]\ndraft = \"plain\"\n[warp]\nlustre = " + std::string(bad) + "\n")
                .empty())
            << bad;
}

TEST_F(WeaveFile, AWifGivesDraftSpacingAndColour) {
    const std::string text =
        "[WIF]\nVersion=1.1\n[WARP]\nThreads=4\nColor=1\nUnits=centimeters\nSpacing=0.05\n"
        "[WEFT]\nThreads=2\nColor=2\n[WEAVING]\nShafts=2\n[COLOR TABLE]\n1=255,0,0\n2=0,0,255\n"
        "[THREADING]\n1=1\n2=2\n3=1\n4=2\n[LIFTPLAN]\n1=1\n2=2\n";
    const Weave cloth = read_weave(write("red-blue.WIF", text));
    const Weave taffeta = weave("polyester taffeta");
    EXPECT_EQ(cloth.name, "red-blue");
    EXPECT_EQ(cloth.draft, plain_weave());
    EXPECT_NEAR(cloth.warp.per_cm, 20, 1e-9);
    EXPECT_NEAR(cloth.warp.width / cloth.warp.spacing(),
                taffeta.warp.width / taffeta.warp.spacing(), 1e-9);
    EXPECT_DOUBLE_EQ(cloth.weft.per_cm, taffeta.weft.per_cm);
    EXPECT_EQ(cloth.warp.transmission, (std::array<double, 3>{1, 0, 0}));
    EXPECT_EQ(cloth.weft.transmission, (std::array<double, 3>{0, 0, 1}));
    EXPECT_THROW(read_weave(write("loose.wif", text + "3=9\n")), Error);
}

} // namespace
} // namespace tsuya::lab
