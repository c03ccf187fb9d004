#include "session_charts.h"

#include <algorithm>
#include <cmath>

#include "chart.h"
#include "tsuya/lab/number_text.h"

namespace tsuya::lab {
namespace {

constexpr double kLeft = 80, kWidth = 860, kTop = 12, kRow = 24;
constexpr int kColumns = 860; // of one pixel: what falls into one is drawn once
constexpr const char *kFault = "#d01818";

/// How much of each column of the time something is there, 0 to 1.
class Columns {
  public:
    Columns(double begin_s, double end_s)
        : begin_s_(begin_s), column_s_((end_s - begin_s) / kColumns) {}

    void add(double from_s, double to_s) {
        const double from = std::clamp((from_s - begin_s_) / column_s_, 0.0, kColumns - 1.0),
                     to = std::clamp((to_s - begin_s_) / column_s_, from, double{kColumns});
        for (auto i = static_cast<std::size_t>(from); i < kColumns && double(i) <= to; ++i)
            shares_[i] += std::min(to, double(i) + 1) - std::max(from, double(i));
    }
    void mark(double at_s) {
        const double at = (at_s - begin_s_) / column_s_;
        shares_[static_cast<std::size_t>(std::clamp(at, 0.0, kColumns - 1.0))] = 1;
    }
    /// Neighbours that are alike as one bar.
    void draw(Drawing &drawing, double bottom, double height, const char *colour) const {
        const auto rounded = [&](std::size_t i) { return std::ceil(10 * shares_[i] - 1e-6) / 10; };
        for (std::size_t i = 0, end; i < kColumns; i = end) {
            for (end = i + 1; end < kColumns && rounded(end) == rounded(i);)
                ++end;
            const double share = std::min(rounded(i), 1.0);
            if (share > 0)
                drawing.rectangle({kLeft + kWidth * double(i) / kColumns, bottom - height * share},
                                  {kWidth * double(end - i) / kColumns, height * share}, colour);
        }
    }

  private:
    double begin_s_, column_s_;
    std::array<double, kColumns> shares_{};
};

struct Row {
    const char *name;
    const char *colour;
};
enum RowIndex : std::size_t { kLamp, kShutter, kCloth, kWhite, kDark, kTrap, kRejected, kRows };
constexpr std::array<Row, kRows> kRowTable{{{"lamp", "#e0a000"},
                                            {"shutter", "#555555"},
                                            {"cloth", "#1f6fd0"},
                                            {"white", "#9b30c0"},
                                            {"dark", "#222222"},
                                            {"trap", "#1d9a4b"},
                                            {"rejected", kFault}}};

RowIndex row_of(const JournalEvent &ok, const Plan &plan) {
    if (!ok.frame) // beside the plan, while the lamp warms up
        return kWhite;
    switch (plan.frames.at(*ok.frame).kind) {
    case FrameKind::cloth:
        return kCloth;
    case FrameKind::white:
        return kWhite;
    case FrameKind::dark:
        return kDark;
    case FrameKind::trap:
        return kTrap;
    }
    return kCloth;
}

/// Fills the rows with the events of a run.
class Rows {
  public:
    Rows(const RunEvents &run, const Plan &plan) : plan_(plan) {
        rows_.fill(Columns(run.begin_s(), run.end_s()));
        for (const JournalEvent *event : run.events)
            take(*event);
        if (lit_since_) // whoever put it out could not note it
            rows_[kLamp].add(*lit_since_, run.end_s());
    }
    const Columns &row(std::size_t i) const { return rows_[i]; }

  private:
    void take(const JournalEvent &event) {
        switch (event.kind) {
        case EventKind::lamp:
            if (event.number("on") != 0) {
                lit_since_ = event.time_s;
            } else if (lit_since_) {
                rows_[kLamp].add(*lit_since_, event.time_s);
                lit_since_.reset();
            }
            break;
        case EventKind::open:
            opened_ = &event;
            break;
        case EventKind::close:
            if (opened_ && !is_dark(*opened_))
                rows_[kShutter].add(opened_->time_s, event.time_s);
            opened_ = nullptr;
            break;
        case EventKind::ok:
            rows_[row_of(event, plan_)].mark(event.time_s);
            break;
        case EventKind::reject:
            rows_[kRejected].mark(event.time_s);
            break;
        default:
            break;
        }
    }
    bool is_dark(const JournalEvent &open) const {
        return open.frame && plan_.frames.at(*open.frame).kind == FrameKind::dark;
    }

    const Plan &plan_;
    std::array<Columns, kRows> rows_{Columns(0, 1), Columns(0, 1), Columns(0, 1), Columns(0, 1),
                                     Columns(0, 1), Columns(0, 1), Columns(0, 1)};
    std::optional<double> lit_since_{};
    const JournalEvent *opened_ = nullptr;
};

} // namespace

std::vector<RunEvents> runs_of(const Journal &journal) {
    std::vector<RunEvents> runs;
    for (const JournalEvent &event : journal.events) {
        if (event.kind == EventKind::session || runs.empty())
            runs.emplace_back();
        runs.back().events.push_back(&event);
    }
    return runs;
}

std::string timeline(const RunEvents &run, const Plan &plan) {
    const double height = kRow * double{kRows};
    const double minutes = (run.end_s() - run.begin_s()) / 60;
    Drawing drawing(kLeft + kWidth + 24, kTop + height + 44);
    const Chart chart(drawing, {kLeft, kTop}, {kWidth, height},
                      {.words = "minutes", .low = 0, .high = minutes}, {});
    const Rows rows(run, plan);
    for (std::size_t i = 0; i < kRows; ++i) {
        const double bottom = kTop + kRow * (double(i) + 1);
        drawing.write({kLeft - 8, bottom - 7}, kRowTable[i].name, {.anchor = "end"});
        rows.row(i).draw(drawing, bottom - 2, kRow - 6, kRowTable[i].colour);
    }
    for (const JournalEvent *event : run.events)
        if (event->kind == EventKind::fault) {
            const glm::dvec2 at = chart.at((event->time_s - run.begin_s()) / 60, 1);
            drawing.line(at, at + glm::dvec2(0, height), {.colour = kFault});
            drawing.dot(at, 4, kFault, event->text("why"));
        }
    return drawing.svg();
}

} // namespace tsuya::lab
