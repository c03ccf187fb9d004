// What the commands of a capture session print and return.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "samples/process.h"
#include "samples/scratch.h"
#include "tsuya/color/camera_frame.h"
#include "tsuya/color/image_file.h"
#include "tsuya/lab/plan.h"
#include "tsuya/lab/safety.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/reflectance_file.h"

namespace tsuya::program {
namespace {

using nlohmann::json;
using scene::Scratch;

TEST(LabCommands, PlanSaysWhatASessionWillTake) {
    const Scratch scratch;
    const auto run = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"lab", "plan"});
        return run_program(words, scratch.folder());
    };
    const std::string output = (scratch / "plans" / "a.plan.jsonl").string();
    const std::filesystem::path picture = scratch / "drawn" / "plan.svg";
    const Outcome planned = run({TSUYA_RIG_SAMPLE, "--views", "few:5", "--symmetry", "orthotropic",
                                 "-o", output, "--picture", picture.string(), "--json"});
    ASSERT_EQ(planned.status, 0) << planned.err;
    EXPECT_NE(read_file(picture).find("left out, geometry.dead_cone_deg: 20"), std::string::npos);
    const json report = json::parse(planned.out);
    EXPECT_EQ(report.at("schema"), "tsuya-lab-plan 1");
    const lab::Plan plan = lab::read_plan(output);
    EXPECT_EQ(report.at("frames"), plan.frames.size());
    EXPECT_EQ(report.at("left_out"), plan.left_out.size());
    EXPECT_EQ(report.at("left_out_for").at("geometry.dead_cone_deg"), 20);
    EXPECT_EQ(report.at("kinds").at("trap"), 4);
    EXPECT_EQ(plan.rig, std::filesystem::path(TSUYA_RIG_SAMPLE).lexically_normal());

    const Outcome told = run({TSUYA_RIG_SAMPLE, "-o", output});
    EXPECT_EQ(told.out.find("few:5: 613 views of the cloth; 540 planned, 73 left out: "
                            "axes.camera 36, geometry.dead_cone_deg 37\n"),
              0u)
        << told.out;
    EXPECT_EQ(report.at("asked"), 324);
    EXPECT_EQ(report.at("planned"), 324 - 39);
    const Outcome paper = run({TSUYA_RIG_SAMPLE, "-o", output, "--views", "paper"});
    EXPECT_EQ(paper.out.find("paper: 33424 views of the cloth, distinct ones of 38880; "), 0u)
        << paper.out;
    const std::string twice =
        scratch
            .write("twice.csv", "theta_i_deg,phi_i_deg,theta_r_deg,"
                                "phi_r_deg,brdf_per_sr\n0,0,30,0,1\n0,0,30,0,1\n")
            .string();
    EXPECT_NE(
        run({TSUYA_RIG_SAMPLE, "-o", output, "--views", twice})
            .out.find(
                "2 views of the cloth, 1 of them given more than once; 1 planned, 0 left out\n"),
        std::string::npos);
    EXPECT_NE(told.out.find("strikes of the lamp 1"), std::string::npos) << told.out;
    EXPECT_EQ(run({TSUYA_RIG_SAMPLE, "-o", output, "--views", "few:0"}).status, 2);
    EXPECT_EQ(run({TSUYA_RIG_SAMPLE, "-o", output, "--symmetry", "round"}).status, 2);
    EXPECT_EQ(run({TSUYA_RIG_SAMPLE, "-o", (scratch / "a.csv").string()}).status, 2);
    EXPECT_EQ(run({TSUYA_RIG_SAMPLE, "-o", output, "--picture", "plan.bmp"}).status, 2);
}

/// A rig of programs alone: `cp` as camera, nothing that moves.
std::string program_rig(const std::string &picture) {
    std::string text = "schema = \"tsuya-rig 1\"\n[lamp]\nkind = \"led\"\nwarm_up_s = 0\n"
                       "restrike_s = 0\nmin_on_s = 0\nhold_s = 0\n[camera]\n"
                       "command = [\"cp\", \"" +
                       picture +
                       "\", \"{file}\"]\nexposures_s = [0.1]\nblack = 0\n"
                       "saturation = 60000\ne_per_dn = 1\nread_noise_e = 1\n"
                       "[sample]\ndrive = \"command\"\ncommand = [\"true\", \"{sample}\"]\n"
                       "[white]\nrho_std = 1\n";
    for (const char *axis : {"lamp_theta", "lamp_phi", "camera", "stage"})
        text += "[axes." + std::string(axis) +
                "]\ndrive = \"command\"\ncommand = [\"true\", \"{deg}\"]\n";
    return text;
}

// Every picture but the first is a copy, so that the session ends at once.
TEST(LabCommands, RunTellsWhatFailsAndStatusHowFarItCame) {
    const Scratch scratch;
    const auto run = [&](std::vector<std::string> words) {
        words.insert(words.begin(), "lab");
        return run_program(words, scratch.folder());
    };
    CameraFrame frame{.image = Image::make(32, 32, {"Y"}), .exposure_s = 0.1};
    write_frame(scratch / "picture.tif", frame);
    const std::string rig =
        scratch.write("a.rig.toml", program_rig((scratch / "picture.tif").string())).string();
    const std::string plan = (scratch / "a.plan.jsonl").string();
    const std::string session = (scratch / "session").string();
    ASSERT_EQ(run({"plan", rig, "--views", "few:45", "-o", plan}).status, 0);
    const Outcome done = run({"run", plan, "-o", session});
    EXPECT_EQ(done.status, 1);
    EXPECT_NE(done.err.find("the picture is a copy of an earlier one"), std::string::npos)
        << done.err;
    const Outcome status = run({"status", session, "--json"});
    ASSERT_EQ(status.status, 0) << status.err;
    const json report = json::parse(status.out);
    EXPECT_EQ(report.at("schema"), "tsuya-lab-status 1");
    EXPECT_EQ(report.at("counted"), 0);
    EXPECT_GE(report.at("rejected"), 2);
    EXPECT_EQ(report.at("lamp_lit"), false);
    EXPECT_EQ(report.at("running"), "");
    EXPECT_NE(run({"status", session}).out.find("not running"), std::string::npos);
    EXPECT_EQ(run({"resume", session}).status, 1);
    EXPECT_NE(run({"run", plan, "-o", session}).err.find("the folder is not empty"),
              std::string::npos);
    EXPECT_EQ(run({"run", plan, "-o", session, "--tries", "0"}).status, 2);
    EXPECT_EQ(run({"status", (scratch / "none").string()}).status, 1);
}

TEST(LabCommands, ASessionWithoutARigFromPlanToPictures) {
    const Scratch scratch;
    const auto run = [&](std::vector<std::string> words) {
        words.insert(words.begin(), "lab");
        return run_program(words, scratch.folder());
    };
    const std::string plan = (scratch / "a.plan.jsonl").string();
    const std::string session = (scratch / "session").string();
    ASSERT_EQ(run({"plan", TSUYA_RIG_SAMPLE, "--views", "few:45", "-o", plan}).status, 0);
    const std::string none = (scratch / "none.fabric.toml").string();
    EXPECT_EQ(run({"run", plan, "-o", session, "--dry-run", "--fabric", none}).status, 1);
    EXPECT_FALSE(std::filesystem::exists(session)) << "in the way of the next call";
    const Outcome done = run({"run", plan, "-o", session, "--dry-run", "--json"});
    ASSERT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(json::parse(done.out).at("missing"), 0);
    const Outcome status = run({"status", session, "--json"});
    ASSERT_EQ(status.status, 0) << status.err;
    const json report = json::parse(status.out);
    EXPECT_EQ(report.at("schema"), "tsuya-lab-status 1");
    EXPECT_EQ(report.at("counted"), report.at("planned"));
    EXPECT_EQ(report.at("lamp_lit"), false);
    EXPECT_EQ(report.at("running"), "");
    EXPECT_NE(run({"status", session}).out.find("not running"), std::string::npos);
    const std::string table = (scratch / "a.csv").string();
    const std::string measured = (scratch / "a.json").string();
    const std::filesystem::path map = scratch / "drawn" / "a.svg", sheet = scratch / "a.png";
    const std::filesystem::path page = scratch / "page.html";
    const Outcome measure = run({"measure", session, "-o", table, "--report", measured, "--html",
                                 page.string(), "--map", map.string(), "--sheet", sheet.string()});
    ASSERT_EQ(measure.status, 0) << measure.err;
    EXPECT_NE(read_file(page).find("Dry run session"), std::string::npos);
    EXPECT_NE(read_file(map).find("channel Y: 4 views"), std::string::npos);
    EXPECT_EQ(read_image(sheet).channels.size(), 3u);
    EXPECT_EQ(run({"measure", session, "-o", table, "--map", "map.png"}).status, 2);
    EXPECT_EQ(run({"measure", session, "-o", table, "--report", table}).status, 2);
    const ReflectanceTable grey = read_reflectance_table(table);
    EXPECT_EQ(grey.keys.at("instrument"), "dry run of a camera goniometer");
    EXPECT_EQ(grey.rows.size(), 4u) << "45 degrees, at 4 azimuths";
    for (const ReflectanceRow &row : grey.rows)
        EXPECT_NEAR(row.brdf_per_sr, 0.02, 3 * row.sigma_per_sr);
    const json parts = json::parse(read_file(measured));
    EXPECT_EQ(parts.at("schema"), "tsuya-lab-measure 1");
    EXPECT_EQ(parts.at("channels").at(0).at("views").size(), grey.rows.size());
    EXPECT_EQ(run({"measure", session, "-o", table, "--repeat-mm", "0.4"}).status, 2);
    EXPECT_EQ(run({"measure", session, "-o", table, "--repeat-mm", "0.4,x"}).status, 2);
    EXPECT_EQ(run({"measure", session, "-o", table, "--without", "shadow"}).status, 2);
    EXPECT_EQ(run({"measure", (scratch / "none").string(), "-o", table}).status, 1);
    const std::string rig = read_file(session + "/rig.toml"), white = session + "/white.csv";
    std::string with_file = rig;
    with_file.replace(with_file.find("rho_std = 0.99"), 14, "rho_std = \"white.csv\"");
    write_file(session + "/rig.toml", with_file);
    write_file(white, "400,0.98\n700,0.98\n");
    EXPECT_EQ(run({"measure", session, "-o", white}).status, 2) << "it is read";
    EXPECT_EQ(read_file(white), "400,0.98\n700,0.98\n");
    write_file(session + "/rig.toml", rig);
    const std::string journal = session + "/journal.jsonl", whole = read_file(journal);
    write_file(journal, whole.substr(0, whole.find("\"file\"")));
    EXPECT_NE(run({"status", session}).out.find("lamp lit when the last run was cut off"),
              std::string::npos);
    write_file(journal, whole);
    EXPECT_EQ(run({"resume", session, "--dry-run"}).status, 0);
    EXPECT_EQ(run({"resume", session}).status, 1);                       // was begun as a dry run
    EXPECT_EQ(run({"run", plan, "-o", session, "--dry-run"}).status, 1); // is there
    EXPECT_EQ(run({"run", plan, "-o", session, "--fabric", "x"}).status, 2);
    EXPECT_EQ(run({"status", (scratch / "none").string()}).status, 1);
}

/// What the program prints at a terminal on which something was typed before it began.
std::string run_at_terminal(const std::vector<std::string> &words, const std::string &typed) {
    std::vector<char *> arguments{const_cast<char *>(TSUYA_PROGRAM)};
    for (const std::string &word : words)
        arguments.push_back(const_cast<char *>(word.c_str()));
    arguments.push_back(nullptr);
    const int ours = posix_openpt(O_RDWR | O_NOCTTY);
    if (ours < 0 || grantpt(ours) != 0 || unlockpt(ours) != 0)
        throw std::runtime_error("no terminal");
    const std::string name = ptsname(ours);
    const int theirs = open(name.c_str(), O_RDWR | O_NOCTTY);
    if (write(ours, typed.data(), typed.size()) != static_cast<ssize_t>(typed.size()))
        throw std::runtime_error("nothing can be typed");
    const pid_t child = fork();
    if (child == 0) {
        setsid();
        const int terminal = open(name.c_str(), O_RDWR); // of the new session
        for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
            dup2(terminal, descriptor);
        close(ours);
        close(theirs);
        close(terminal);
        execv(arguments[0], arguments.data());
        _exit(127);
    }
    close(theirs);
    std::string printed;
    char part[256];
    for (ssize_t got; (got = read(ours, part, sizeof part)) > 0;)
        printed.append(part, static_cast<std::size_t>(got));
    waitpid(child, nullptr, 0);
    close(ours);
    return printed;
}

TEST(LabCommands, AnEnterFromBeforeTheQuestionIsNoAnswer) {
    const Scratch scratch;
    std::string rig = "schema = \"tsuya-rig 1\"\n[lamp]\nkind = \"led\"\nwarm_up_s = 0.1\n"
                      "restrike_s = 0\nmin_on_s = 0\nhold_s = 2\n"
                      "[camera]\ncommand = [\"/bin/false\", \"{file}\", \"{exposure}\"]\n"
                      "exposures_s = [1]\nsaturation = 900\nblack = 1\ne_per_dn = 1\n"
                      "read_noise_e = 1\n[white]\nrho_std = 0.99\n";
    for (const char *axis : {"lamp_theta", "lamp_phi", "camera", "stage"})
        rig += std::string("[axes.") + axis +
               "]\ndrive = \"command\"\ncommand = [\"/bin/true\", \"{axis}\", \"{deg}\"]\n";
    write_file(scratch / "a.rig.toml", rig);
    const std::string plan = (scratch / "a.plan.jsonl").string();
    const Outcome planned = run_program(
        {"lab", "plan", (scratch / "a.rig.toml").string(), "--views", "few:45", "-o", plan},
        scratch.folder());
    ASSERT_EQ(planned.status, 0) << planned.err;
    const std::string printed =
        run_at_terminal({"lab", "run", plan, "-o", (scratch / "s").string()}, "\n");
    // The progress may have filled the terminal: the question waits for room.
    EXPECT_NE(printed.find("please put the white standard"), std::string::npos) << printed;
    EXPECT_NE(printed.find("nobody has answered"), std::string::npos) << printed;
}

TEST(LabCommands, ResetNeedsAFaultAndAReason) {
    const Scratch scratch;
    const std::string rig = (scratch / "a.rig.toml").string();
    const auto reset = [&](const std::string &reason) {
        return run_program({"lab", "reset", rig, "--acknowledge", reason}, scratch.folder());
    };
    EXPECT_EQ(reset("looked").status, 1);
    lab::latch_fault(lab::fault_log_of(rig), "the door", 1);
    EXPECT_EQ(reset("").status, 2);
    const Outcome done = reset("closed it");
    EXPECT_EQ(done.status, 0);
    EXPECT_EQ(done.out, "acknowledged: the door\n");
    EXPECT_FALSE(lab::latched_fault(lab::fault_log_of(rig)));
}

} // namespace
} // namespace tsuya::program
