#include "tsuya/lab/rig_file.h"

#include "tsuya/sdk/file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include <unistd.h>

namespace tsuya::lab {
namespace {

std::string sample_text() { return read_file(TSUYA_RIG_SAMPLE); }

/// A rig file in a folder of the test.
class RigFiles : public testing::Test {
  protected:
    RigFiles()
        : folder_(std::filesystem::temp_directory_path() /
                  ("tsuya_rig_file_test_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~RigFiles() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path file() const { return folder_ / "a.rig.toml"; }
    RigFile read(const std::string &text) const {
        write_file(file(), text);
        return read_rig_file(file());
    }
    std::vector<Problem> problems_of(const std::string &text) const {
        try {
            read(text);
        } catch (const Error &error) {
            return error.problems();
        }
        return {};
    }
    std::string at_line(int line) const {
        return file().string() + ":" + std::to_string(line) + ":";
    }

    std::filesystem::path folder_;
};

/// The text with the first `what` replaced, which must be there; and the line where that is.
std::string replaced(std::string text, const std::string &what, const std::string &by,
                     int *line = nullptr) {
    const std::size_t at = text.find(what);
    if (at == std::string::npos)
        throw std::invalid_argument("no '" + what + "' in the sample");
    if (line)
        *line = 1 + static_cast<int>(std::count(
                        text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    return text.replace(at, what.size(), by);
}

/// The sample with another line in place of the one of that number, from 1.
std::string with_line(int number, const std::string &line) {
    std::istringstream sample(sample_text());
    std::string text, part;
    for (int i = 1; std::getline(sample, part); ++i)
        text += (i == number ? line : part) + "\n";
    return text;
}

TEST_F(RigFiles, TheSampleIsReadWhole) {
    const RigFile rig = read(sample_text());
    ASSERT_EQ(rig.lines.size(), kLineRoles);
    const GpioLineSettings &press = rig.lines.at(LineRole::half_press);
    EXPECT_EQ(press.chip, "pinctrl-bcm2711");
    EXPECT_EQ(press.line, "22");
    EXPECT_EQ(press.drive, Drive::open_drain);
    EXPECT_EQ(rig.lines.at(LineRole::lamp).line, "GPIO17");
    EXPECT_TRUE(rig.lines.at(LineRole::busy).active_low);
    EXPECT_EQ(rig.lines.at(LineRole::estop).bias, Bias::pull_up);
    EXPECT_EQ(rig.lamp.kind, LampKind::metal_halide);
    EXPECT_EQ(rig.lamp.serial, "MH-2041");
    EXPECT_EQ(rig.lamp.min_on, Seconds(300));
    EXPECT_EQ(rig.lamp.log, folder_ / "lamp.log");
    EXPECT_EQ(rig.shutter.lag, Seconds(0.004));
    EXPECT_EQ(rig.shutter.max_duty, 0.5);
    EXPECT_EQ(rig.camera.command.size(), 6u);
    EXPECT_EQ(rig.camera.exposures_s, (std::vector<double>{0.01, 0.1, 1, 10}));
    EXPECT_EQ(rig.camera.saturation, 15800);
    EXPECT_EQ(rig.axis(AxisName::lamp_phi).drive, AxisDrive::grbl);
    EXPECT_EQ(rig.axis(AxisName::lamp_phi).letter, 'Y');
    EXPECT_EQ(rig.axis(AxisName::camera).drive, AxisDrive::by_operator);
    EXPECT_EQ(rig.axis(AxisName::stage).position_deg(30), -30);
    EXPECT_EQ(rig.axis(AxisName::stage).timeout, Seconds(30));
    EXPECT_TRUE(rig.axis(AxisName::camera).reaches(80));
    EXPECT_FALSE(rig.axis(AxisName::camera).reaches(80.1));
    EXPECT_EQ(rig.dead_cone_deg, 6);
    EXPECT_EQ(rig.lamp.diameter_mm, 8);
    EXPECT_EQ(rig.camera.extension, "cr2");
    EXPECT_EQ(rig.axis(AxisName::lamp_theta).move, Seconds(4));
    EXPECT_EQ(rig.axis(AxisName::camera).move, Seconds(20));
    EXPECT_EQ(rig.sample.drive, AxisDrive::by_operator);
    EXPECT_EQ(std::get<double>(rig.white.rho_std), 0.99);
}

// Each key of the sample in turn: a wrong letter is told at its line, with the key.
TEST_F(RigFiles, EveryKeyIsKnownByItsNameAlone) {
    std::istringstream lines(sample_text());
    const std::regex key("^([a-z_]+) = .*");
    int number = 0, keys = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        std::smatch match;
        if (!std::regex_match(line, match, key))
            continue;
        ++keys;
        const std::string wrong = match.str(1) + "x";
        bool told = false;
        for (const Problem &problem :
             problems_of(with_line(number, wrong + line.substr(match.str(1).size()))))
            told = told || (problem.what.find(wrong) != std::string::npos &&
                            problem.where.starts_with(at_line(number)));
        EXPECT_TRUE(told) << line;
    }
    EXPECT_GE(keys, 60);
}

// Each number and each chosen name of the sample in turn, at its place.
TEST_F(RigFiles, EveryValueHasARange) {
    std::istringstream lines(sample_text());
    const std::regex number_value("^([a-z_]+ = )(-?[0-9.]+)(.*)");
    const std::regex choice("^((?:kind|drive|bias|letter) = )\"([^\"]*)\"(.*)");
    int number = 0, checked = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        std::smatch match;
        std::string wrong = "-99999.5";
        if (!std::regex_match(line, match, number_value)) {
            wrong = "\"nonsense\"";
            if (!std::regex_match(line, match, choice))
                continue;
        }
        bool told = false;
        for (const Problem &problem :
             problems_of(with_line(number, match.str(1) + wrong + match.str(3))))
            told = told || problem.where.starts_with(at_line(number));
        EXPECT_TRUE(told) << line;
        ++checked;
    }
    EXPECT_GE(checked, 45);
}

TEST_F(RigFiles, AreRefusedWithPlaceAndReason) {
    struct Case {
        std::string what, by, expected;
    };
    const std::vector<Case> cases{
        {"tsuya-rig 1", "tsuya-rig 2", "the schema is 'tsuya-rig 2'"},
        {"[lines.estop]", "[lines.e_stop]", "unknown role 'e_stop' of a line"},
        {"[axes.stage]", "[axes.stages]", "unknown axis 'stages'"},
        {"offset = 23", "offset = 24", "is the same line as busy"},
        {"offset = 23", "", "neither a name nor an offset"},
        {"offset = 23", "offset = 23\nname = \"a\"", "both a name and an offset"},
        {"name = \"GPIO17\"", "name = \"\"", "the name is empty"},
        {"chip = \"pinctrl-bcm2711\"\noffset = 22", "offset = 22", "an offset needs a chip"},
        {"bias = \"pull-down\"", "drive = \"push-pull\"", "an input has no drive"},
        {"warm_up_s", "warm_up_min", "unknown key 'warm_up_min'"},
        {"\"{file}\"", "\"{files}\"", "unknown placeholder {files}"},
        {"\"{file}\"", "\"x\"", "the command lacks {file}"},
        {"={exposure}", "={exposure", "a brace without its other"},
        {"\"{deg}\"", "\"0\"", "the command lacks {deg}"},
        {"exposures_s = [0.01, 0.1, 1, 10]", "exposures_s = [0.1, 0.01]", "no ascending times"},
        {"exposures_s = [0.01, 0.1, 1, 10]", "exposures_s = [40]", "longer than the shutter's"},
        {"exposures_s = [0.01, 0.1, 1, 10]", "exposures_s = [nan]", "not"},
        {"saturation = 15800", "saturation = 512", "is not above black"},
        {"letter = \"Y\"", "letter = \"X\"", "same axis of the controller as lamp_theta"},
        {"limits_deg = [-5, 80]", "limits_deg = [80, -5]", "no two ascending positions"},
        {"sign = -1", "sign = 0", "is 0"},
        {"rho_std = 0.99", "rho_std = \"absent.csv\"", "there is no file"},
        {"extension = \"cr2\"", "extension = \"../x\"", "is '../x'"},
        {"# response = \"response.csv\"", "response = \"absent.csv\"", "there is no file"},
        {"# response = \"response.csv\"", "flat = \"absent.tif\"", "there is no file"},
        {"# response = \"response.csv\"", "monitor = [0, 0, 64]", "is no part of a picture"},
        {"# response = \"response.csv\"", "monitor = [0, 0, 64, 0]", "is no part of a picture"},
        {"# response = \"response.csv\"", "monitor = [0, 0.5, 64, 9]", "is no part of a picture"},
        {"# response = \"response.csv\"",
         "[camera.patch_at]\ntheta_deg = [80, 0]\nx = [1, 2]\ny = [1, 2]",
         "the places of the patch are no list"},
        {"# response = \"response.csv\"",
         "[camera.patch_at]\ntheta_deg = [0, 80]\nx = [1, 2]\ny = [1]",
         "the places of the patch are no list"},
        {"drive = \"operator\"            # or", "drive = \"grbl\" # or", "unknown drive 'grbl'"},
        {"drive = \"operator\"            # or", "drive = \"command\"\ncommand = [\"x\"] #",
         "the command lacks {sample}"},
    };
    for (const Case &c : cases) {
        int line = 0;
        const std::string text = replaced(sample_text(), c.what, c.by, &line);
        const std::vector<Problem> problems = problems_of(text);
        bool told = false;
        for (const Problem &problem : problems) {
            told = told || problem.what.find(c.expected) != std::string::npos;
            EXPECT_TRUE(problem.where.starts_with(file().string() + ":")) << problem.where;
        }
        EXPECT_TRUE(told) << c.expected << " for '" << c.by << "'; "
                          << (problems.empty() ? "no problem" : problems[0].what);
    }
}

TEST_F(RigFiles, TheCameraMayBeTriggeredByTheShutter) {
    const std::string all = sample_text();
    const std::size_t at = all.find("command = [\"gphoto2\"");
    const std::string command = all.substr(at, all.find('\n', at) - at);
    const std::string trigger = "trigger = \"shutter\"\nwatch_folder = \"in\"";
    const RigFile rig = read(replaced(all, command, trigger));
    EXPECT_TRUE(rig.camera.command.empty());
    EXPECT_EQ(rig.camera.watch_folder, folder_ / "in");
    const auto first = [&](const std::string &text) {
        const std::vector<Problem> problems = problems_of(text);
        return problems.empty() ? "no problem" : problems[0].what;
    };
    EXPECT_EQ(first(replaced(all, command, command + "\n" + trigger)),
              "the camera has both a command and a trigger");
    EXPECT_EQ(first(replaced(all, command, "")), "the camera has neither command nor trigger");
    EXPECT_EQ(first(replaced(all, command, command + "\nwatch_folder = \"in\"")),
              "a folder is watched for trigger = \"shutter\" alone");
    const std::size_t lines = all.find("[lines.shutter]");
    std::string without = replaced(all, command, trigger);
    without.erase(lines, without.find("[lines.half_press]") - lines);
    EXPECT_EQ(first(without), "the rig has no shutter line");
}

TEST_F(RigFiles, NameEverythingThatIsMissing) {
    const std::vector<Problem> problems = problems_of("schema = \"tsuya-rig 1\"\n");
    ASSERT_EQ(problems.size(), 4u);
    EXPECT_EQ(problems[0].what, "there is no [lamp]");
    EXPECT_EQ(problems[3].what, "there is no [white]");
    EXPECT_EQ(problems[0].where, file().string() + ":1:1");
}

TEST_F(RigFiles, TheStandardMayBeAFile) {
    write_file(folder_ / "white.csv", "400,0.99\n");
    const RigFile rig = read(replaced(sample_text(), "rho_std = 0.99", "rho_std = \"white.csv\""));
    EXPECT_EQ(std::get<std::filesystem::path>(rig.white.rho_std), folder_ / "white.csv");
}

} // namespace
} // namespace tsuya::lab
