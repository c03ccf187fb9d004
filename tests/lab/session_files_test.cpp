#include "tsuya/lab/session.h"

#include "samples/scratch.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

#include <gtest/gtest.h>

namespace tsuya::lab {
namespace {

using scene::Scratch;

Plan small_plan() {
    const DirectionPair at{.theta_i = 0, .phi_i = 0, .theta_r = 45 * kDegree, .phi_r = 0.1};
    return {.symmetry = Symmetry::half_turn,
            .white = WhiteUse::each_view,
            .views = "few:5",
            .rig = "/rigs/a.rig.toml",
            .rig_hash = "0123456789abcdef",
            .frames = {{.kind = FrameKind::white, .view = 0, .directions = at, .exposure_s = 0.1},
                       {.kind = FrameKind::cloth, .view = 1, .directions = at, .exposure_s = 0.01},
                       {.kind = FrameKind::cloth, .view = 1, .directions = at, .exposure_s = 0.1},
                       {.kind = FrameKind::dark, .view = 2, .directions = at, .exposure_s = 0.1},
                       {.kind = FrameKind::trap, .view = 3, .directions = at, .exposure_s = 1}},
            .left_out = {{.directions = {}, .why = "within the dead cone"}}};
}

template <class Call> Problem problem_of(const Call &call) {
    try {
        call();
    } catch (const Error &error) {
        return error.problems().front();
    }
    return {.what = "no error"};
}

std::string replaced(std::string text, const std::string &what, const std::string &by) {
    const std::size_t at = text.find(what);
    if (at == std::string::npos)
        throw std::invalid_argument("no '" + what + "'");
    return text.replace(at, what.size(), by);
}

TEST(PlanFile, IsReadAsItWasWritten) {
    const Scratch folder;
    write_plan(small_plan(), folder / "a.jsonl");
    const Plan plan = read_plan(folder / "a.jsonl");
    EXPECT_EQ(plan.symmetry, Symmetry::half_turn);
    EXPECT_EQ(plan.white, WhiteUse::each_view);
    EXPECT_EQ(plan.views, "few:5");
    EXPECT_EQ(plan.rig, "/rigs/a.rig.toml");
    EXPECT_EQ(plan.rig_hash, "0123456789abcdef");
    ASSERT_EQ(plan.frames.size(), 5u);
    EXPECT_EQ(plan.frames[3].kind, FrameKind::dark);
    EXPECT_EQ(plan.frames[2].view, 1u);
    EXPECT_EQ(plan.frames[1].exposure_s, 0.01);
    EXPECT_NEAR(plan.frames[0].directions.phi_r, 0.1, 1e-10);
    ASSERT_EQ(plan.left_out.size(), 1u);
    EXPECT_EQ(plan.left_out[0].why, "within the dead cone");
    EXPECT_EQ(plan_text(plan), read_file(folder / "a.jsonl"));
    EXPECT_NE(plan_text(plan).find("\"theta_r_deg\":45.0,"), std::string::npos);
}

TEST(PlanFile, IsRefusedWithPlaceAndReason) {
    const Scratch folder;
    const std::string text = plan_text(small_plan());
    struct Case {
        std::string what, by, expected;
        int line;
    };
    for (const Case &c : std::vector<Case>{
             {"tsuya-plan 1", "tsuya-plan 2", "the schema is 'tsuya-plan 2'", 1},
             {"half-turn", "half", "unknown symmetry 'half'", 1},
             {"each-view", "each", "unknown white 'each'", 1},
             {"\"kind\":\"cloth\"", "\"kind\":\"silk\"", "unknown kind 'silk'", 4},
             {"\"frame\":1", "\"frame\":2", "the frame has the number 2", 4},
             {"\"view\":2", "\"view\":3", "the view has the number 3", 6},
             {"\"view\":2", "\"view\":-2", "'view' is -2", 6},
             {"\"theta_r_deg\":45", "\"theta_r_deg\":95", "'theta_r_deg' is 95", 3},
             {"\"exposure_s\":0.1", "\"exposure_s\":0", "'exposure_s' is 0", 3},
             {"\"exposure_s\":0.1", "\"exposures\":0.1", "there is no 'exposure_s'", 3},
             {"\"exposure_s\":0.1", "\"exposure_s\":0.1,\"x\":1", "unknown key 'x'", 3},
             {"{\"frame\":2", "[{\"frame\":2", "the line is no JSON object", 5},
         }) {
        write_file(folder / "a.jsonl", replaced(text, c.what, c.by));
        const Problem problem = problem_of([&] { read_plan(folder / "a.jsonl"); });
        EXPECT_TRUE(problem.what.starts_with(c.expected)) << problem.what << ", " << c.expected;
        EXPECT_EQ(problem.where, (folder / "a.jsonl").string() + ":" + std::to_string(c.line));
    }
    write_file(folder / "a.jsonl", "schema = \"tsuya-rig 1\"\n[lamp]\n[camera]\n");
    try {
        read_plan(folder / "a.jsonl");
        FAIL() << "no error";
    } catch (const Error &error) {
        EXPECT_EQ(error.problems().size(), 1u) << "a file that is no plan is one problem";
    }
    write_file(folder / "a.jsonl", text.substr(0, text.size() - 3));
    EXPECT_EQ(problem_of([&] { read_plan(folder / "a.jsonl"); }).what, "the last line is cut off");
    write_file(folder / "a.jsonl", text.substr(0, text.find('\n') + 1));
    EXPECT_EQ(problem_of([&] { read_plan(folder / "a.jsonl"); }).what, "the plan has no frame");
}

std::string text_of(std::vector<JournalEvent> events) {
    std::string text;
    for (std::size_t i = 0; i < events.size(); ++i) {
        events[i].seq = i;
        text += journal_line(events[i]) + "\n";
    }
    return text;
}

JournalEvent ok_of(std::optional<std::size_t> frame, const std::string &file) {
    return {.kind = EventKind::ok,
            .frame = frame,
            .texts = {{"file", file}, {"hash", "0123456789abcdef"}},
            .numbers = {{"middle_s", 1700000000.125},
                        {"exposure_s", 0.1},
                        {"strike", 3},
                        {"lamp_hours", 12.5}},
            .time_s = 1700000001};
}

std::vector<JournalEvent> small_journal() {
    return {{.kind = EventKind::session, .texts = {{"boot", "a\"b\n"}}, .time_s = 0.1 + 0.2},
            {.kind = EventKind::reject,
             .frame = 1,
             .texts = {{"file", "rejected/000001.tif"}, {"why", "no picture"}}},
            ok_of(1, "frames/000001.tif"),
            ok_of({}, "frames/warm-1.tif"),
            ok_of(0, "frames/000000.tif")};
}

// The checksum is that of Python's zlib.crc32.
TEST(Journal, HasTheChecksumOfTheStandard) {
    EXPECT_EQ(journal_line({.texts = {{"what", "x"}}, .seq = 7}),
              "{\"seq\":7,\"time_s\":0.0,\"kind\":\"note\",\"what\":\"x\",\"crc\":\"55b2f3fb\"}");
}

TEST(Journal, IsReadAsItWasWritten) {
    const Scratch folder;
    const std::string text = text_of(small_journal());
    write_file(folder / "a.jsonl", text);
    const Journal journal = read_journal(folder / "a.jsonl");
    EXPECT_FALSE(journal.torn);
    EXPECT_EQ(journal.whole_bytes, text.size());
    EXPECT_EQ(text_of(journal.events), text);
    EXPECT_EQ(journal.events[0].time_s, 0.1 + 0.2);
    EXPECT_EQ(journal.events[0].text("boot"), "a\"b\n");
    EXPECT_EQ(journal.events[2].frame, 1u);
    EXPECT_FALSE(journal.events[3].frame);
    EXPECT_EQ(journal.events[2].number("strike"), 3);
}

// Cut at each byte of its last line, a journal has all lines before.
TEST(Journal, LosesNothingButATornLastLine) {
    const Scratch folder;
    const std::string text = text_of(small_journal());
    const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
    for (std::size_t end = last; end < text.size(); ++end) {
        write_file(folder / "a.jsonl", text.substr(0, end));
        const Journal journal = read_journal(folder / "a.jsonl");
        EXPECT_EQ(journal.events.size(), 4u);
        EXPECT_EQ(journal.torn, end > last);
        EXPECT_EQ(journal.whole_bytes, last);
    }
}

// Every byte of a line but the break at its end is covered by the checksum.
TEST(Journal, AChangedByteIsToldAtItsLine) {
    const Scratch folder;
    const std::string text = text_of(small_journal());
    const std::size_t begin = text.find('\n') + 1, end = text.find('\n', begin);
    for (std::size_t at = begin; at < end; ++at) {
        std::string changed = text;
        changed[at] = static_cast<char>(changed[at] ^ 1);
        write_file(folder / "a.jsonl", changed);
        const Problem problem = problem_of([&] { read_journal(folder / "a.jsonl"); });
        EXPECT_EQ(problem.where, (folder / "a.jsonl").string() + ":2") << problem.what;
    }
    std::vector<JournalEvent> events = small_journal();
    std::string gap = text_of({events[0]});
    events[1].seq = 2;
    gap += journal_line(events[1]) + "\n";
    write_file(folder / "a.jsonl", gap);
    EXPECT_EQ(problem_of([&] { read_journal(folder / "a.jsonl"); }).what, "the line has seq 2");
}

/// A session's folder with the small plan and journal.
class SessionFolder : public testing::Test {
  protected:
    SessionFolder() {
        std::filesystem::create_directories(folder_ / "frames");
        write_file(folder_ / "rig.toml", read_file(TSUYA_RIG_SAMPLE));
        write_plan(small_plan(), folder_ / "plan.jsonl");
        for (const char *name : {"000000.tif", "000001.tif", "warm-1.tif"})
            write_file(folder_ / "frames" / name, name);
        write(small_journal());
    }
    std::filesystem::path journal() const { return folder_ / "journal.jsonl"; }
    void write(const std::vector<JournalEvent> &events) const {
        write_file(journal(), text_of(events));
    }
    std::string error_with(const JournalEvent &event) const {
        std::vector<JournalEvent> events = small_journal();
        events.push_back(event);
        write(events);
        const Problem problem = problem_of([&] { read_session(folder_.folder()); });
        EXPECT_EQ(problem.where, journal().string() + ":6");
        return problem.what;
    }

    Scratch folder_;
};

TEST_F(SessionFolder, IsReadWithWhatCounts) {
    const Session session = read_session(folder_.folder());
    ASSERT_EQ(session.frames.size(), 2u);
    EXPECT_EQ(session.frames[0].number, 0u);
    EXPECT_EQ(session.frames[0].planned.kind, FrameKind::white);
    EXPECT_EQ(session.frames[1].planned, session.plan.frames[1]);
    EXPECT_EQ(read_file(session.frames[1].file), "000001.tif");
    EXPECT_EQ(session.frames[1].time_s, 1700000000.125);
    EXPECT_EQ(session.frames[1].strike, 3);
    EXPECT_EQ(session.frames[1].lamp_hours, 12.5);
    ASSERT_EQ(session.warm_up.size(), 1u);
    EXPECT_EQ(session.warm_up[0].planned.kind, FrameKind::white);
    ASSERT_EQ(session.rejected.size(), 1u);
    EXPECT_EQ(session.rejected[0].why, "no picture");
    EXPECT_EQ(session.missing, (std::vector<std::size_t>{2, 3, 4}));
    EXPECT_EQ(session.rig.camera.black, 512);
    EXPECT_EQ(session.plan_hash, file_hash(folder_ / "plan.jsonl"));
    EXPECT_NE(session.plan_hash, session.journal_hash);
}

TEST_F(SessionFolder, IsRefusedWhereTheJournalAndTheRestDiffer) {
    EXPECT_EQ(error_with(ok_of(5, "frames/000001.tif")), "the plan has no frame 5");
    EXPECT_EQ(error_with(ok_of(1, "frames/000001.tif")), "the frame 1 counts a second time");
    const std::string gone = error_with(ok_of(2, "frames/000002.tif"));
    EXPECT_EQ(gone, "the picture '" + (folder_ / "frames/000002.tif").string() + "' is gone");
}

} // namespace
} // namespace tsuya::lab
