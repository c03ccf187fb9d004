// Scene files that are refused, at the place of what is wrong.

#include <gtest/gtest.h>

#include "samples/scratch.h"
#include "tsuya/scene/scene_file.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

SceneFile read(const Scratch &scratch, const std::string &text) {
    scratch.write("cloth.obj", cloth_obj());
    return read_scene_file(scratch.write("a.scene.toml", text));
}

/// The problems of a scene file that must be refused.
std::vector<Problem> problems_of(const Scratch &scratch, const std::string &text) {
    try {
        read(scratch, text);
    } catch (const Error &error) {
        return error.problems();
    }
    ADD_FAILURE() << "the scene was accepted:\n" << text;
    return {{"", "", ""}};
}

TEST(SceneFile, ALightAtItsTargetIsOneProblem) {
    const Scratch scratch;
    const std::vector<Problem> problems = problems_of(
        scratch, "[fabrics.silk]\n[garments.cloth]\nmesh = \"cloth.obj\"\nfabric = \"silk\"\n"
                 "[lights.key]\ncentre = [1, 2, 3]\ntarget = [1, 2, 3]\n");
    ASSERT_EQ(problems.size(), 1u) << problems[1].what;
    EXPECT_NE(problems[0].what.find("at its target"), std::string::npos) << problems[0].what;
}

TEST(SceneFile, KeysOfARefusedLightAreKnown) {
    const Scratch scratch;
    scratch.write("a.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 100 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n"
                           "300 100\n");
    const std::string behaviour = "visible = true\nblocks = true\nshadows = false\n";
    for (const std::string &kind :
         {"type = \"rectangle\"\nup = [0, 1, 0]\nwidth = 1\nheight = 2\nradiance = 3\n" + behaviour,
          "type = \"disk\"\nradius = 1\nlux = 3\nat = [0, 0, 0]\n" + behaviour,
          std::string(
              "type = \"spot\"\ncone_deg = 20\nfalloff = 0.1\ncandela = 3\nshadows = true\n"),
          std::string("type = \"ies\"\nprofile = \"a.ies\"\nturn_deg = 20\nlumen = 3\n")}) {
        const std::vector<Problem> problems = problems_of(
            scratch, "[fabrics.silk]\n[garments.cloth]\nmesh = \"cloth.obj\"\nfabric = \"silk\"\n"
                     "[lights.key]\ncentre = [1, 2, 3]\ntarget = [1, 2, 3]\ngroup = \"key\"\n"
                     "lamp = \"A\"\n" +
                         kind);
        EXPECT_EQ(problems.size(), 1u) << kind << problems.back().what;
        EXPECT_NE(problems[0].what.find("at its target"), std::string::npos) << problems[0].what;
    }
}

TEST(SceneFile, PanelsOfAMeshThatCannotBeReadAreNotJudged) {
    const Scratch scratch;
    scratch.write("broken.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
    const std::vector<Problem> problems = problems_of(
        scratch, "[fabrics.silk]\n[environment]\n[garments.cloth]\nmesh = \"broken.obj\"\n"
                 "fabric = \"silk\"\ngrain.front = 3\n");
    ASSERT_EQ(problems.size(), 1u) << problems[1].what;
    EXPECT_NE(problems[0].what.find("broken.obj"), std::string::npos) << problems[0].what;
}

TEST(SceneFile, OpenDyesBesideManyColoursAreRefusedAtTheirPlace) {
    const Scratch scratch;
    std::string text = "[environment]\n[fabrics.open]\ndye = \"any\"\n";
    for (const char *const dye : {"crimson", "indigo", "emerald"})
        text += std::string("[fabrics.") + dye + "]\ndye = \"" + dye + "\"\n";
    for (const char *const fabric : {"open", "crimson", "indigo", "emerald"})
        text += std::string("[bodies.") + fabric + "]\nmesh = \"cloth.obj\"\nfabric = \"" + fabric +
                "\"\n";
    const SceneFile file = read(scratch, text);
    try {
        build_scene(file);
        ADD_FAILURE() << "no error was thrown";
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].where,
                  (scratch / "a.scene.toml").string() + ":2:1: fabrics.open.dye");
        EXPECT_NE(error.problems()[0].what.find("4 colours vary"), std::string::npos);
    }
}

TEST(SceneFile, AnOpenDyeIsADye) {
    const Scratch scratch;
    EXPECT_EQ(problems_of(scratch, "[fabrics.silk]\ndye = \"any\"\nreflectance = 0.5\n"
                                   "[garments.cloth]\nmesh = \"cloth.obj\"\nfabric = \"silk\"\n"
                                   "[environment]\n")[0]
                  .what,
              "dye and reflectance are both given");
}

struct BadInput {
    const char *name;
    const char *from, *to; ///< what is replaced in the small scene
    const char *place;     ///< line and column
    const char *what;      ///< in the message
    const char *accepted;  ///< in what would be accepted
};

void PrintTo(const BadInput &bad, std::ostream *out) { *out << bad.name; }

class BadScene : public testing::TestWithParam<BadInput> {};

TEST_P(BadScene, IsRefusedAtItsPlace) {
    const BadInput &bad = GetParam();
    const Scratch scratch;
    std::string text = small_scene();
    const std::size_t at = text.find(bad.from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, std::string(bad.from).size(), bad.to);
    const std::vector<Problem> problems = problems_of(scratch, text);
    ASSERT_EQ(problems.size(), 1u) << problems[1].what;
    EXPECT_EQ(problems[0].where, (scratch / "a.scene.toml").string() + ":" + bad.place);
    EXPECT_NE(problems[0].what.find(bad.what), std::string::npos) << problems[0].what;
    EXPECT_NE(problems[0].accepted.find(bad.accepted), std::string::npos) << problems[0].accepted;
}

INSTANTIATE_TEST_SUITE_P(
    Inputs, BadScene,
    testing::Values(
        BadInput{"UnknownKey", "width = 16", "widht = 16", "2:1", "widht", "did you mean width"},
        BadInput{"UnknownSection", "[render]", "[rendering]", "15:2", "rendering", "render"},
        BadInput{"OutOfRange", "width = 16", "width = 0", "2:9", "0", "from 1 to 32768"},
        BadInput{"NotANumber", "radiance = 0.2", "radiance = \"x\"", "13:12", "not a number",
                 "number"},
        BadInput{"UnknownFabric", "fabric = \"silk\"", "fabric = \"silc\"", "8:10", "silc",
                 "did you mean silk"},
        BadInput{"UnknownDye", "\"crimson\"", "\"crimsom\"", "5:7", "crimsom", "crimson"},
        BadInput{"MissingMesh", "cloth.obj", "other.obj", "7:8", "other.obj", "relative"},
        BadInput{"TwoColours", "[fabrics.silk]\n", "[fabrics.silk]\nreflectance = 0.5\n", "6:7",
                 "both", "one of them"},
        BadInput{"LightAtItsTarget", "[-1, 1, 2]", "[0, 0.3, 0]", "10:10", "at its target",
                 "apart"},
        BadInput{"LightTooFarAway", "[-1, 1, 2]", "[-1e300, 1, 2]", "10:10",
                 "too far from its target", "within"},
        BadInput{"ShortNumber", "radiance = 0.2", "radiance = 1e300", "13:12",
                 "'radiance' is 1e+300", "from 0 to 1e+06"},
        BadInput{"LightWithoutCentre", "centre = [-1, 1, 2]\n", "", "9:1", "'centre' is missing",
                 "such as"},
        BadInput{"GroupWithoutName", "group = \"fill\"", "group = \"\"", "14:9", "no name",
                 "\"key\""},
        BadInput{"GroupWithNul", "group = \"fill\"", "group = \"a\\u0000b\"", "14:9",
                 "control character", "bytes"},
        BadInput{"GroupWithEquals", "group = \"fill\"", "group = \"a=b\"", "14:9", "'='", "bytes"},
        BadInput{"TwoNumbers", "[0, 0.3, 0]", "[0, 0.3]", "11:10", "2 numbers", "three"},
        BadInput{"UnknownPanel", "fabric = \"silk\"", "fabric = \"silk\"\ngrain.sleeve = 3", "9:7",
                 "sleeve", "panel"},
        BadInput{"UnknownUp", "fabric = \"silk\"", "fabric = \"silk\"\nup = \"x\"", "9:6",
                 "not an axis", "y, z"},
        BadInput{"UnknownUnit", "fabric = \"silk\"", "fabric = \"silk\"\nunit = \"feet\"", "9:8",
                 "feet", "mm"},
        BadInput{"Channels", "samples_per_pixel = 4", "channels = 12", "16:12", "12 channels",
                 "8, 16 or 32"},
        BadInput{"EyeAndAzimuth", "width = 16", "eye = [0,0,2]\ntarget = [0,0,0]\nmargin = 0.1",
                 "4:10", "beside eye", "frames"},
        BadInput{"UnknownProjection", "width = 16", "projection = \"flat\"", "2:14", "flat",
                 "orthographic"},
        BadInput{"HeightOfAPerspective", "width = 16", "orthographic_height = 2", "2:23",
                 "in a perspective", "projection"},
        BadInput{"AngleOfParallelRays", "width = 16",
                 "projection = \"orthographic\"\nvertical_angle_deg = 20", "3:22", "no angle",
                 "orthographic_height"},
        BadInput{"NoHeightBesideEye", "width = 16",
                 "projection = \"orthographic\"\neye = [0,0,2]\ntarget = [0,0,0]", "2:14",
                 "is missing", "1.8"},
        BadInput{"LensOfParallelRays", "width = 16", "projection = \"orthographic\"\nf_number = 2",
                 "3:12", "no lens", "f_number"},
        BadInput{"ShiftOfOneNumber", "width = 16", "shift = [0.1]", "2:9", "no shift", "[0, 0.1]"},
        BadInput{"ShiftTooFar", "width = 16", "shift = [0, 11]", "2:9", "no shift", "10"},
        BadInput{"FocusWithoutLens", "width = 16", "focus_distance = 2", "2:18", "without f_number",
                 "2.8"},
        BadInput{"TwoFocuses", "width = 16", "f_number = 2\nfocus_distance = 2\nfocus = [0,0,0]",
                 "4:9", "both", "one of them"},
        BadInput{"TwoBlades", "width = 16", "f_number = 2\naperture_blades = 2", "3:19", "2 blades",
                 "3 to 16"},
        BadInput{"ExposureOfAnotherText", "samples_per_pixel = 4",
                 "samples_per_pixel = 4\n[output]\nexposure = \"meter\"", "18:12", "another text",
                 "metered"},
        BadInput{"PathOfOneKey", "width = 16",
                 "path = [{ at = 0, eye = [0, 1, 3], target = [0, 1, 0] }]", "2:8", "no end",
                 "from at = 0 to at = 1"},
        BadInput{"PathThatDoesNotRise", "width = 16",
                 "path = [{ at = 0, eye = [0, 1, 3], target = [0, 1, 0] }, "
                 "{ at = 1, eye = [0, 1, 2], target = [0, 1, 0] }, "
                 "{ at = 1, eye = [0, 1, 1], target = [0, 1, 0] }]",
                 "2:114", "does not rise", "order"},
        BadInput{"KeyWithoutEye", "width = 16",
                 "path = [{ at = 0, target = [0, 1, 0] }, "
                 "{ at = 1, eye = [0, 1, 2], target = [0, 1, 0] }]",
                 "2:9", "'eye' is missing", "[0, 1, 3]"},
        BadInput{"UnknownKeyOfAKey", "width = 16",
                 "path = [{ at = 0, eye = [0, 1, 3], target = [0, 1, 0], ups = 1 }, "
                 "{ at = 1, eye = [0, 1, 2], target = [0, 1, 0] }]",
                 "2:56", "'ups'", "at, eye"},
        BadInput{"PathAndEye", "width = 16",
                 "eye = [0, 1, 3]\npath = [{ at = 0, eye = [0, 1, 3], target = [0, 1, 0] }, "
                 "{ at = 1, eye = [0, 1, 2], target = [0, 1, 0] }]",
                 "2:7", "beside a path", "camera.path"},
        BadInput{"PathThatIsNoList", "width = 16", "path = 3", "2:8", "no list of tables",
                 "[[camera.path]]"},
        BadInput{"EmptyPath", "width = 16", "path = []", "2:8", "no list of tables",
                 "[[camera.path]]"},
        BadInput{"PathOfOneTable", "width = 16", "path = {at = 0}", "2:8", "no list of tables",
                 "[[camera.path]]"},
        BadInput{"KeyAtItsTarget", "width = 16",
                 "path = [{ at = 0, eye = [0, 1, 3], target = [0, 1, 0] },\n"
                 "{ at = 1, eye = [0, 1, 2], target = [0, 1, 2] }]",
                 "3:37", "looks nowhere", "apart"},
        BadInput{"KeyAlongUp", "width = 16",
                 "up = [0, 0, 1]\npath = [{ at = 0, eye = [0, 1, 3], target = [0, 1, 0] },\n"
                 "{ at = 1, eye = [0, 2, 2], target = [0, 1, 2] }]",
                 "3:45", "along its up direction", "not parallel"},
        BadInput{"EyeAtTarget", "width = 16", "eye = [0,1,0]\ntarget = [0,1,0]", "3:10",
                 "looks nowhere", "apart"},
        BadInput{"KeyAtNoTime", "width = 16",
                 "path = [{ at = nan, eye = [0, 1, 3], target = [0, 1, 0] }, "
                 "{ at = 1, eye = [0, 1, 2], target = [0, 1, 0] }]",
                 "2:16", "'at'", "from 0 to 1"},
        BadInput{"KeyWithoutTime", "width = 16",
                 "path = [{ at = 0, eye = [0, 1, 3], target = [0, 1, 0] }, "
                 "{ eye = [0, 1, 2], target = [0, 1, 0] }]",
                 "2:58", "'at' is missing", "from 0 to 1"},
        BadInput{"SkyThatIsNoTable", "radiance = 0.2", "sky = 3", "13:7", "not a table",
                 "[environment.sky]"},
        BadInput{"NotToml", "width = 16", "width = = 16", "2:9", "", "TOML"}),
    [](const auto &input) { return std::string(input.param.name); });

TEST(SceneFile, RefusesUnknownLampsAndViews) {
    const Scratch scratch;
    const std::vector<Problem> problems = problems_of(
        scratch, small_scene("[output]\nlamps = [\"D66\"]\nview = \"soft\"\nadapt = \"cat16\"\n"));
    ASSERT_EQ(problems.size(), 3u);
    EXPECT_NE(problems[0].where.find(":18:9"), std::string::npos) << problems[0].where;
    EXPECT_NE(problems[0].what.find("D66"), std::string::npos);
}

// A file of spectra that is wrong is named, where it is missing as where it is no file of spectra.
TEST(SceneFile, NamesFilesOfLampsAndDyes) {
    const Scratch scratch;
    scratch.write("bad.csv", "400,x\n");
    const std::string missing = (scratch / "no.csv").string();
    for (const auto &[from, to] :
         {std::pair(std::string("\"crimson\""), std::string("\"no.csv\"")),
          {"[lights.key]\n", "[lights.key]\nlamp = \"no.csv\"\n"},
          {"[render]\n", "[output]\nlamps = [\"A\", \"no.csv\"]\n[render]\n"}}) {
        std::string text = small_scene();
        text.replace(text.find(from), from.size(), to);
        const std::vector<Problem> problems = problems_of(scratch, text);
        ASSERT_EQ(problems.size(), 1u) << to;
        EXPECT_EQ(problems[0].what,
                  missing + ": the file cannot be opened: No such file or directory");
        EXPECT_NE(problems[0].where.find("a.scene.toml:"), std::string::npos);
    }
    std::string wrong = small_scene();
    wrong.replace(wrong.find("crimson"), 7, "bad.csv");
    const std::vector<Problem> problems = problems_of(scratch, wrong);
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].what.rfind((scratch / "bad.csv").string() + ":", 0), 0u)
        << problems[0].what;
    // Files beside a scene that is named without a folder
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(scratch.folder());
    std::string text = small_scene();
    text.replace(text.find("crimson"), 7, "no.csv");
    scratch.write("cloth.obj", cloth_obj());
    scratch.write("a.scene.toml", text);
    try {
        read_scene_file("a.scene.toml");
        ADD_FAILURE() << "no error was thrown";
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].what.rfind("no.csv: ", 0), 0u) << error.what();
    }
    std::filesystem::current_path(before);
}

TEST(SceneFile, RefusesASceneWithoutLightOrGarment) {
    const Scratch scratch;
    EXPECT_EQ(problems_of(scratch, "[camera]\n").size(), 2u);
}

TEST(SceneFile, ReportsAllProblemsAtOnce) {
    const Scratch scratch;
    EXPECT_EQ(
        problems_of(scratch, small_scene("seed = -1\nchannels = 3\nmax_bounces = -1\n")).size(),
        3u);
}

} // namespace
} // namespace tsuya::scene
