#include "tsuya/lab/session_page.h"

#include <algorithm>
#include <map>
#include <set>

#include "drawing.h"
#include "session_charts.h"
#include "tsuya/lab/number_text.h"
#include "tsuya/lab/session_pictures.h"
#include "tsuya/sdk/detail/counted.h"
#include "utc_text.h"

namespace tsuya::lab {
namespace {

constexpr std::size_t kMostRows = 200; // of a table
constexpr std::size_t kMostRuns = 12;

constexpr const char *kHead = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'">
<style>
body { font: 16px/1.45 "DejaVu Sans", sans-serif; color: #222; background: #fff; margin: 0 auto;
       max-width: 1040px; padding: 1rem; }
h1 { font-size: 1.5rem; overflow-wrap: anywhere; }
h2 { font-size: 1.15rem; margin-top: 2.2rem; }
table { border-collapse: collapse; }
td, th { text-align: left; padding: .2rem .9rem .2rem 0; border-bottom: 1px solid #e2e2e2;
         vertical-align: top; }
td:last-child { min-width: 12rem; }
th { font-weight: 600; }
.figure, .rows { overflow-x: auto; }
.figure svg { width: 100%; min-width: 680px; height: auto; display: block; }
.warning { border-left: 4px solid #d9730d; padding: .3rem .8rem; margin: .5rem 0;
           background: #fff6ec; }
</style>
)";

using Cells = std::vector<std::string>;

std::string row(const Cells &cells, const char *tag = "td") {
    std::string text = "<tr>";
    for (const std::string &cell : cells)
        text += std::string("<") + tag + ">" + escaped(cell) + "</" + tag + ">";
    return text + "</tr>\n";
}

/// A table; of many rows the first.
std::string table(const Cells &head, const std::vector<Cells> &rows) {
    std::string text = "<div class=\"rows\"><table>\n" + row(head, "th");
    for (std::size_t i = 0; i < std::min(rows.size(), kMostRows); ++i)
        text += row(rows[i]);
    text += "</table></div>\n";
    if (rows.size() > kMostRows)
        text += "<p>" + std::to_string(rows.size() - kMostRows) +
                " more are in the report as JSON and in the journal.</p>\n";
    return text;
}

std::string title(const std::string &words) { return "<h2>" + escaped(words) + "</h2>\n"; }

std::string figure(const std::string &svg) {
    return svg.empty() ? "" : "<div class=\"figure\">\n" + svg + "</div>\n";
}

std::string time_of(double time_s) { return utc_text(time_s, "%Y-%m-%d %H:%M:%S UTC"); }

Cells angles_of(const DirectionPair &at) {
    Cells cells;
    for (const double angle : {at.theta_i, at.phi_i, at.theta_r, at.phi_r})
        cells.push_back(number_text(angle / kDegree, 5));
    return cells;
}

class Page {
  public:
    Page(const Session &session, const SessionMeasurement &measured)
        : session_(session), measured_(measured),
          journal_(read_journal(session.folder / "journal.jsonl")), runs_(runs_of(journal_)) {}

    std::string text() const {
        const std::string name = session_.folder.lexically_normal().filename().string();
        return kHead + ("<title>Session " + escaped(name) + "</title>\n</head>\n<body>\n<h1>") +
               (session_.dry_run ? "Dry run " : "Session ") + escaped(name) + "</h1>\n" + facts() +
               warnings() + runs() + white() + errors() + map() + left_out() + faults() +
               "</body>\n</html>\n";
    }

  private:
    std::string facts() const;
    std::string warnings() const;
    std::string runs() const;
    std::string run(std::size_t i) const;
    std::string white() const;
    std::string errors() const;
    std::string map() const;
    std::string left_out() const;
    std::string faults() const;

    const Session &session_;
    const SessionMeasurement &measured_;
    Journal journal_;
    std::vector<RunEvents> runs_;
};

std::string Page::facts() const {
    const ChannelMeasurement &channel = measured_.channels[0];
    const CountedFrame &first = session_.frames.front(), &last = session_.frames.back();
    const auto degrees = [](double angle) {
        return angle > 0 ? number_text(angle / kDegree, 3) + "°" : "not known";
    };
    return table(
        {"what", "value"},
        {{"views asked for", session_.plan.views},
         {"views measured", std::to_string(channel.views.size())},
         {"views left out", std::to_string(measured_.left_out.size()) + " by the pictures, " +
                                std::to_string(session_.plan.left_out.size()) + " by the plan"},
         {"frames", std::to_string(session_.frames.size()) + " of " +
                        std::to_string(session_.plan.frames.size()) + ", " +
                        detail::counted(session_.rejected.size(), "picture") + " put aside"},
         {"from", time_of(first.time_s)},
         {"to", time_of(last.time_s)},
         {"lamp", (session_.rig.lamp.serial.empty() ? "no serial" : session_.rig.lamp.serial) +
                      ", " + number_text(first.lamp_hours, 5) + " to " +
                      number_text(last.lamp_hours, 5) + " hours"},
         {"flicker of single frames", number_text(100 * channel.flicker, 2) + " %"},
         {"the lamp fills", degrees(measured_.lamp_angle)},
         {"the lens fills", degrees(measured_.aperture_angle)},
         {"narrowest lobe", degrees(measured_.narrowest_lobe)},
         {"plan, rig, journal",
          session_.plan_hash + ", " + session_.rig_hash + ", " + session_.journal_hash}});
}

std::string Page::warnings() const {
    std::string text;
    for (const std::string &warning : measured_.warnings)
        text += "<p class=\"warning\">" + escaped(warning) + "</p>\n";
    return text;
}

std::string Page::runs() const {
    std::string text = title("Lamp, shutter and frames");
    const std::size_t drawn = std::min(runs_.size(), kMostRuns);
    for (std::size_t i = 0; i < drawn; ++i)
        text += run(i);
    if (drawn < runs_.size())
        text += "<p>" + std::to_string(runs_.size() - drawn) + " more runs are not drawn.</p>\n";
    return text;
}

std::string Page::run(std::size_t i) const {
    const RunEvents &run = runs_[i];
    const std::string from = "<p>Run " + std::to_string(i + 1) + ", from " + time_of(run.begin_s());
    if (run.end_s() - run.begin_s() < 1)
        return from + ", ended at once</p>\n";
    return from + "</p>\n" + figure(timeline(run, session_.plan));
}

std::string Page::white() const {
    std::set<int> strikes;
    for (const LampCourse &light : measured_.channels[0].lamp)
        for (const WhiteReading &reading : light.readings)
            strikes.insert(reading.strike);
    std::string text = title("Drift of the white standard");
    for (const int strike : strikes)
        if (const std::string chart = white_chart(measured_.channels[0], strike); !chart.empty())
            text += "<p>Lighting " + std::to_string(strike) + " of the lamp</p>\n" + figure(chart);
    return text;
}

std::string Page::errors() const {
    std::string text = title("Errors of the views");
    for (const ChannelMeasurement &channel : measured_.channels) {
        if (measured_.channels.size() > 1)
            text += "<p>Channel " + escaped(channel.name) + "</p>\n";
        text += figure(sigma_chart(channel));
        std::vector<Cells> rows;
        for (const SigmaPart &part : kSigmaParts) {
            std::vector<double> shares;
            for (const MeasuredView &view : channel.views)
                if (view.brdf_per_sr > 0)
                    shares.push_back(100 * view.*part.value / view.brdf_per_sr);
            std::sort(shares.begin(), shares.end());
            const auto at = [&](double share) {
                return shares.empty() ? std::string("none")
                                      : number_text(shares[static_cast<std::size_t>(
                                                        share * double(shares.size() - 1))],
                                                    3);
            };
            rows.push_back({part.name, at(0.5), at(0.95), at(1)});
        }
        text += table({"part of the error, %", "median", "95th percentile", "largest"}, rows);
    }
    return text;
}

std::string Page::map() const {
    return title("The table") + figure(table_picture(session_, measured_));
}

std::string Page::left_out() const {
    std::string text = title("Views that are left out");
    if (measured_.left_out.empty())
        text += "<p>The pictures gave every view.</p>\n";
    std::vector<Cells> rows;
    for (const LeftOutView &view : measured_.left_out) {
        Cells cells{std::to_string(view.view), name_of(view.reason)};
        const Cells angles = angles_of(view.directions);
        cells.insert(cells.end(), angles.begin(), angles.end());
        cells.push_back(view.detail);
        rows.push_back(std::move(cells));
    }
    if (!rows.empty())
        text += table({"view", "reason", "theta_i", "phi_i", "theta_r", "phi_r", "why"}, rows);
    std::map<std::string, std::size_t> reasons;
    for (const LeftOut &view : session_.plan.left_out)
        ++reasons[reason_of(view)];
    rows.clear();
    for (const auto &[reason, count] : reasons)
        rows.push_back({reason, std::to_string(count)});
    if (!rows.empty())
        text += "<p>Not planned:</p>\n" + table({"what of the rig", "views"}, rows);
    return text;
}

std::string Page::faults() const {
    std::vector<Cells> rows;
    for (const JournalEvent &event : journal_.events)
        if (event.kind == EventKind::reject || event.kind == EventKind::fault)
            rows.push_back(
                {time_of(event.time_s), name_of(event.kind),
                 event.frame ? std::to_string(*event.frame) : "",
                 event.kind == EventKind::fault ? event.text("where") : event.text("file"),
                 event.text("why")});
    return title("Pictures put aside and faults") +
           (rows.empty() ? "<p>None.</p>\n"
                         : table({"time", "event", "frame", "where", "why"}, rows));
}

} // namespace

std::string session_page(const Session &session, const SessionMeasurement &measured) {
    return Page(session, measured).text();
}

} // namespace tsuya::lab
