#include "tsuya/lab/session_page.h"

#include <cmath>
#include <regex>

#include <gtest/gtest.h>

#include "chart.h"
#include "lab/virtual_session.h"
#include "samples/scratch.h"
#include "session_charts.h"
#include "tsuya/sdk/file.h"

namespace tsuya::lab {
namespace {

using scene::Scratch, test::VirtualSession;

std::size_t count(const std::string &text, const std::string &part) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
        ++found;
    return found;
}

VirtualSession small_session() {
    VirtualSession made;
    for (const double theta_i : {0.0, 30.0})
        for (const double theta_r : {20.0, 40.0, 60.0})
            made.directions.pairs.push_back(
                {theta_i * kDegree, 0, theta_r * kDegree, 120 * kDegree});
    made.scene.cloth = [](const DirectionPair &) { return 0.02; };
    made.glint_view = 2;
    made.white_every = 2;
    return made;
}

/// Puts events before and after those of the journal, whose numbers follow.
void surround(const Session &session, std::vector<JournalEvent> before,
              const std::vector<JournalEvent> &after) {
    const std::filesystem::path file = session.folder / "journal.jsonl";
    for (const JournalEvent &event : read_journal(file).events)
        before.push_back(event);
    before.insert(before.end(), after.begin(), after.end());
    std::string text;
    for (std::size_t i = 0; i < before.size(); ++i) {
        before[i].seq = i;
        text += journal_line(before[i]) + "\n";
    }
    write_file(file, text);
}

constexpr const char *kMarkup = "<script>alert('x')</script> & \"more\"";

std::string page_of_a_troubled_session(const Scratch &folder) {
    Session session = make_virtual_session(folder / "s <b>", small_session());
    const double begin_s = session.frames.front().time_s - 100,
                 end_s = session.frames.back().time_s + 100;
    surround(session,
             {{.kind = EventKind::session, .time_s = begin_s},
              {.kind = EventKind::lamp, .numbers = {{"on", 1}}, .time_s = begin_s}},
             {{.kind = EventKind::reject,
               .frame = 3,
               .texts = {{"file", "rejected/000003-1.tif"}, {"why", kMarkup}},
               .time_s = end_s - 50},
              {.kind = EventKind::fault,
               .texts = {{"where", "camera"}, {"why", "no answer"}},
               .time_s = end_s - 20},
              {.kind = EventKind::lamp, .numbers = {{"on", 0}}, .time_s = end_s},
              {.kind = EventKind::session, .time_s = end_s + 5000}});
    session = read_session(folder / "s <b>");
    session.plan.left_out = {{.directions = {.theta_r = 1.5}, .why = "axes.camera: too far"}};
    return session_page(session, measure_session(session));
}

TEST(SessionPage, TellsWhatHappenedAndNeedsNoOtherFile) {
    const Scratch folder;
    const std::string page = page_of_a_troubled_session(folder);
    for (const char *part :
         {"Session s &lt;b&gt;", "UTC, ended at once", "Drift of the white standard", "no answer",
          "rejected/000003-1.tif", "saturated", "axes.camera", "Pictures put aside and faults"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    EXPECT_NE(page.find("&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt; &amp; &quot;more&quot;"),
              std::string::npos);
    for (const char *part : {"<script", "<b>", "src=", "href", "@import", "url(", "<link"})
        EXPECT_EQ(page.find(part), std::string::npos) << part;
    EXPECT_EQ(count(page, "http"), count(page, "http://www.w3.org/2000/svg") + 1)
        << "and the security policy";
    for (const std::string tag : {"table", "tr", "td", "th", "div", "svg", "p", "h2", "title"})
        EXPECT_EQ(count(page, "<" + tag + ">") + count(page, "<" + tag + " "),
                  count(page, "</" + tag + ">"))
            << tag;
    EXPECT_EQ(count(page, "<svg"), 1u + 1 + 1 + 1) << "run, lighting, errors, table";
}

/// The first bar of a colour: its left side and its width.
std::array<double, 2> bar(const std::string &svg, const std::string &colour) {
    std::smatch found;
    const std::regex shape("<rect x=\"([0-9.]+)\"[^>]*width=\"([0-9.]+)\"[^>]*fill=\"" + colour);
    return std::regex_search(svg, found, shape)
               ? std::array{std::stod(found[1]), std::stod(found[2])}
               : std::array{-1.0, -1.0};
}

// A run of 100 minutes, whose chart is 860 wide from 80 on.
TEST(SessionPage, TheTimelineHasLampAndFramesWhereTheyWere) {
    Plan plan{.frames = {{.kind = FrameKind::cloth, .exposure_s = 1},
                         {.kind = FrameKind::dark, .view = 1, .exposure_s = 1}}};
    const Journal journal{
        .events = {{.kind = EventKind::session, .time_s = 1000},
                   {.kind = EventKind::lamp, .numbers = {{"on", 1}}, .time_s = 1600},
                   {.kind = EventKind::open, .frame = 0, .time_s = 2200},
                   {.kind = EventKind::close, .frame = 0, .time_s = 2800},
                   {.kind = EventKind::ok, .frame = 0, .time_s = 2800},
                   {.kind = EventKind::open, .frame = 1, .time_s = 3400},
                   {.kind = EventKind::close, .frame = 1, .time_s = 3900},
                   {.kind = EventKind::lamp, .numbers = {{"on", 0}}, .time_s = 4600},
                   {.kind = EventKind::fault, .texts = {{"why", "cable"}}, .time_s = 4000},
                   {.kind = EventKind::note, .time_s = 7000}}};
    const std::vector<RunEvents> runs = runs_of(journal);
    ASSERT_EQ(runs.size(), 1u);
    const std::string svg = timeline(runs[0], plan);
    const auto lamp = bar(svg, "#e0a000"), shutter = bar(svg, "#555555"),
               cloth = bar(svg, "#1f6fd0");
    EXPECT_NEAR(lamp[0], 80 + 86, 1);
    EXPECT_NEAR(lamp[1], 430, 1);
    EXPECT_NEAR(shutter[0], 80 + 172, 1);
    EXPECT_NEAR(shutter[1], 86, 1) << "and not during the dark frame";
    EXPECT_EQ(count(svg, "#555555"), 1u);
    EXPECT_NEAR(cloth[0], 80 + 258, 1);
    EXPECT_EQ(bar(svg, "#222222")[0], -1) << "the dark frame did not count";
    EXPECT_NE(svg.find("<title>cable</title>"), std::string::npos);
    Journal cut = journal;
    cut.events.resize(6);
    const auto lit = bar(timeline(runs_of(cut)[0], plan), "#e0a000");
    EXPECT_NEAR(lit[0] + lit[1], 80 + 860, 1) << "a run that was cut off: lit to its end";
}

TEST(SessionPage, ChartsOfDriftAndErrorsHaveTheirValues) {
    ChannelMeasurement channel;
    channel.views = {{.brdf_per_sr = 0.1, .noise = 0.001, .drift = 0.01},
                     {.brdf_per_sr = 0, .noise = 1}};
    channel.lamp.emplace_back().readings = {{.time_s = 0, .rate = 99, .strike = 1},
                                            {.time_s = 60, .rate = 101, .strike = 1},
                                            {.time_s = 0, .rate = 50, .strike = 2}};
    EXPECT_EQ(white_chart(channel, 2), "") << "one reading drifts nowhere";
    const std::string drift = white_chart(channel, 1);
    EXPECT_NE(drift.find("phi 0°: -1 %"), std::string::npos) << drift;
    EXPECT_NE(drift.find("phi 0°: 1 %"), std::string::npos);
    // The frame is 220 high from 30 on, for 0.01 to 100 %: four powers of ten.
    const std::string errors = sigma_chart(channel);
    EXPECT_EQ(count(errors, "<circle"), 2u) << "neither texture nor white, nor a view of 0";
    EXPECT_NE(errors.find("cy=\"140\" r=\"3\" fill=\"#1f6fd0\""), std::string::npos) << "1 %";
    EXPECT_NE(errors.find("cy=\"85\" r=\"3\" fill=\"#1d9a4b\""), std::string::npos) << "10 %";
}

TEST(Chart, HasRoundTicks) {
    EXPECT_EQ(ticks_of({.low = 0, .high = 10}), (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(ticks_of({.low = -1.1, .high = 1.1}), (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
    EXPECT_EQ(ticks_of({.low = 0.01, .high = 10, .logarithmic = true}).size(), 4u);
    EXPECT_EQ(scale_colour(0), "#3a105c");
    EXPECT_EQ(scale_colour(2), scale_colour(1));
}

} // namespace
} // namespace tsuya::lab
