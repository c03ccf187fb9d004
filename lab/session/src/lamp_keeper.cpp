#include "lamp_keeper.h"

#include <algorithm>
#include <cmath>

namespace tsuya::lab {
namespace {

using std::chrono::nanoseconds;

constexpr int kReports = 100; // of a wait's progress

int strikes_of(const Journal &journal) {
    int strikes = 0;
    for (const JournalEvent &event : journal.events)
        if (event.kind == EventKind::lamp)
            strikes = std::max(strikes, static_cast<int>(event.number("strike")));
    return strikes;
}

std::string minutes_text(Seconds time) {
    const auto seconds = std::lround(std::ceil(time.count()));
    return std::to_string(seconds / 60) + " min " + std::to_string(seconds % 60) + " s";
}

} // namespace

LampKeeper::LampKeeper(const RigLamp &lamp, OutputLine *line, const std::filesystem::path &log,
                       SafetyClock &clock, SessionJournal &journal, const Moments &moments)
    : lamp_(lamp), line_(line), clock_(clock), journal_(journal), moments_(moments),
      log_(log, lamp.serial, moments, strikes_of(journal.before())) {}

void LampKeeper::sleep(Seconds time, const char *stage, const Progress &progress) {
    const nanoseconds begin = clock_.now();
    for (int i = 1; i <= kReports; ++i) {
        const auto part = std::chrono::round<nanoseconds>(time * i / kReports);
        if (!clock_.sleep_until(begin + part, progress.stop))
            throw Interrupted("stopped while the lamp was waited for");
        progress(stage, static_cast<double>(i) / kReports);
    }
}

void LampKeeper::light(bool wait, const Progress &progress) {
    if (const Seconds left = restrike_left(log_.state(), lamp_.restrike, moments_());
        left.count() > 0) {
        if (!wait)
            throw SessionFault({"the lamp may not be lit again for " + minutes_text(left),
                                "lamp " + lamp_.serial, "expected a later call, or to wait"},
                               false);
        sleep(left, "lamp cools", progress);
    }
    clock_.check();
    log_.light(); // first: a lamp that is lit is in its log, whatever comes next
    note();
    lit_at_ = clock_.now();
    if (line_)
        line_->set(true);
    sleep(lamp_.warm_up, "lamp warms up", progress);
}

void LampKeeper::wait_min_on(const Progress &progress) {
    const Seconds lit = clock_.now() - lit_at_;
    if (line_ && lit < lamp_.min_on)
        sleep(lamp_.min_on - lit, "lamp is lit for its shortest time", progress);
}

void LampKeeper::went_out() {
    if (!lit())
        return;
    log_.put_out();
    note();
}

void LampKeeper::note() {
    journal_.note_lasting(
        {.kind = EventKind::lamp,
         .numbers = {{"on", lit() ? 1.0 : 0.0}, {"strike", strike()}, {"hours", hours()}}});
}

} // namespace tsuya::lab
