#include "tsuya/lab/session_run.h"

#include "lab/session_bed.h"

#include <gtest/gtest.h>

namespace tsuya::lab {
namespace {

TEST(SessionFolders, AreMadeOnceOfTheRigOfThePlan) {
    SessionBed bed;
    bed.create();
    const auto problem = [](const std::function<void()> &call) {
        try {
            call();
        } catch (const Error &error) {
            return error.problems().front();
        }
        return Problem{.what = "no error"};
    };
    EXPECT_EQ(problem([&] { bed.create(); }).what, "the folder is not empty");
    write_file(bed.rig_file(), std::string(kSmallRig) + "height_mm = 1\n");
    EXPECT_EQ(problem([&] {
                  create_session(bed.scratch / "other", bed.plan_file(), bed.rig_file());
              }).what,
              "the rig file is not the one that the plan was made for");
    EXPECT_FALSE(std::filesystem::exists(bed.scratch / "other"));
}

// A session that never began, for want of a rig for example, can be looked at and begun later.
TEST(SessionFolders, AreSessionsBeforeTheyBegin) {
    SessionBed bed;
    bed.create();
    EXPECT_EQ(read_session(bed.folder()).missing.size(), bed.plan.frames.size());
    try {
        bed.create();
        FAIL() << "no error";
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].accepted, "expected a new one; this session can be resumed");
    }
    BedRun run(bed.rig);
    EXPECT_EQ(run.run(bed.folder(), bed.rig).missing(), 0u);
}

TEST(SessionFolders, ThatCannotBeMadeAreNamed) {
    SessionBed bed;
    const std::filesystem::path nowhere = "/proc/tsuya";
    try {
        create_session(nowhere, bed.plan_file(), bed.rig_file());
        FAIL() << "no error";
    } catch (const Error &error) {
        EXPECT_TRUE(error.problems()[0].where.starts_with(nowhere.string()));
        EXPECT_TRUE(error.problems()[0].what.starts_with("the folder cannot be made: "));
    }
}

// The standard's table comes along; a file elsewhere cannot.
TEST(SessionFolders, HaveWhatTheRigFileNames) {
    SessionBed bed;
    const auto with_standard = [&](const std::string &name) {
        std::string text = kSmallRig;
        const std::size_t at = text.find("0.99");
        write_file(bed.rig_file(), text.replace(at, 4, "\"" + name + "\""));
        Plan plan = bed.plan;
        plan.rig_hash = file_hash(bed.rig_file());
        write_plan(plan, bed.plan_file());
    };
    std::filesystem::create_directories(bed.scratch / "std");
    write_file(bed.scratch / "std/white.csv", "400,0.98\n");
    with_standard("std/white.csv");
    bed.create();
    EXPECT_EQ(read_file(bed.folder() / "std/white.csv"), "400,0.98\n");
    with_standard("../" + bed.scratch.folder().filename().string() + "/std/white.csv");
    EXPECT_THROW(create_session(bed.scratch / "b", bed.plan_file(), bed.rig_file()), Error);
    EXPECT_FALSE(std::filesystem::exists(bed.scratch / "b"));
}

TEST(SessionFolders, AreResumedWithTheSameRigAndPlanAlone) {
    SessionBed bed;
    bed.finished();
    EXPECT_NO_THROW(check_same_rig_and_plan(bed.folder(), bed.rig_file()));
    std::string text = kSmallRig;
    write_file(bed.rig_file(),
               text.replace(text.find("saturation = 1000"), 17, "saturation = 900"));
    try {
        check_same_rig_and_plan(bed.folder(), bed.rig_file());
        FAIL() << "no error";
    } catch (const Error &error) {
        ASSERT_EQ(error.problems().size(), 1u);
        EXPECT_EQ(error.problems()[0].what, "is now 'saturation = 900'");
        EXPECT_EQ(error.problems()[0].where, bed.rig_file().string() + ":14");
    }
    write_file(bed.rig_file(), kSmallRig);
    EXPECT_NO_THROW(check_same_rig_and_plan(bed.folder(), bed.rig_file()));
    bed.plan.frames.pop_back();
    write_plan(bed.plan, bed.folder() / "plan.jsonl");
    EXPECT_THROW(check_same_rig_and_plan(bed.folder(), bed.rig_file()), Error);
}

// Of the standard's table and of the camera's response the content counts, not only the name.
TEST(SessionFolders, AreResumedWithTheSameStandardAndResponseAlone) {
    SessionBed bed;
    std::string text = kSmallRig;
    text.replace(text.find("0.99"), 4, "\"white.csv\"");
    text.replace(text.find("black = 100"), 11, "response = \"response.csv\"\nblack = 100");
    write_file(bed.scratch / "white.csv", "400,0.98\n700,0.97\n");
    write_file(bed.scratch / "response.csv", "0,0\n1000,1\n");
    write_file(bed.rig_file(), text);
    bed.rig = read_rig_file(bed.rig_file());
    bed.plan.rig_hash = file_hash(bed.rig_file());
    write_plan(bed.plan, bed.plan_file());
    bed.finished();
    const auto problem = [&]() -> Problem {
        try {
            check_same_rig_and_plan(bed.folder(), bed.rig_file());
        } catch (const Error &error) {
            return error.problems().front();
        }
        return {.what = "no error"};
    };
    EXPECT_EQ(problem().what, "no error");
    write_file(bed.scratch / "white.csv", "400,0.98\n700,0.96\n");
    EXPECT_EQ(problem().what, "is now '700,0.96'");
    EXPECT_EQ(problem().where, (bed.scratch / "white.csv").string() + ":2");
    // The copy was changed as well.
    write_file(bed.folder() / "white.csv", "400,0.98\n700,0.96\n");
    EXPECT_EQ(problem().what,
              "a copy of the files that the rig file names was changed after the session began");
    write_file(bed.scratch / "white.csv", "400,0.98\n700,0.97\n");
    write_file(bed.folder() / "white.csv", "400,0.98\n700,0.97\n");
    EXPECT_EQ(problem().what, "no error");
    std::filesystem::remove(bed.scratch / "response.csv");
    EXPECT_EQ(problem().what, "the file that the rig file names is gone");
}

} // namespace
} // namespace tsuya::lab
