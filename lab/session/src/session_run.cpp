#include "tsuya/lab/session_run.h"

#include "frame_taker.h"

#include <algorithm>
#include <deque>

namespace tsuya::lab {
namespace {

using std::chrono::nanoseconds;

constexpr Seconds kPause{1};              // before a second try; before a third twice that
constexpr Seconds kWhiteInterval{60};     // from one white frame to the next while the lamp warms
constexpr std::size_t kWhiteAgree = 3;    // frames
constexpr double kWhiteTolerance = 0.003; // between the largest and the smallest of them
constexpr int kMostWhite = 60;            // frames, then the lamp is no lamp to measure by
constexpr double kWellExposed = 0.9;      // of the way from black to saturation

class SessionRun {
  public:
    SessionRun(const Session &session, SessionJournal &journal, const RigFile &rig,
               const SessionHardware &hardware, const SessionSettings &settings,
               const Progress &progress)
        : session_(session), journal_(journal), rig_(rig), hardware_(hardware), settings_(settings),
          progress_(progress), store_(session, rig.camera, hardware.read, hardware.clock, journal_),
          lamp_(rig.lamp, hardware.lamp, settings.lamp_log, hardware.clock, journal_,
                hardware.moments),
          taker_(rig, hardware, store_, journal_, lamp_, progress.stop),
          counted_(session.frames.size()) {}

    SessionResult run() {
        begin();
        OffGuard off({hardware_.lamp, hardware_.shutter});
        std::exception_ptr failure;
        try {
            if (!session_.missing.empty())
                work();
        } catch (...) {
            failure = std::current_exception();
        }
        std::vector<Problem> problems = off.drive_off(); // before anything else
        end(failure, problems);
        if (!problems.empty())
            throw Error(std::move(problems));
        if (failure)
            std::rethrow_exception(failure);
        return {.planned = session_.plan.frames.size(), .counted = counted_};
    }

  private:
    void begin();
    void work();
    void take_frame(std::size_t number);
    void warm_up();
    PlannedFrame white_frame() const;
    double white_exposure(PlannedFrame white);
    std::optional<double> take(const Shot &shot);
    bool attempt(std::optional<std::size_t> number, const std::function<void()> &step);
    void recover_from(std::optional<std::size_t> number, const Error &error, int tried);
    void end(const std::exception_ptr &failure, std::vector<Problem> &problems);
    void end_by(const SessionFault &fault, std::vector<Problem> &problems);
    void leave(const std::string &how);

    const Session &session_;
    SessionJournal &journal_;
    const RigFile &rig_;
    const SessionHardware &hardware_;
    const SessionSettings &settings_;
    const Progress &progress_;
    FrameStore store_;
    LampKeeper lamp_;
    FrameTaker taker_;
    std::size_t counted_;
    std::optional<nanoseconds> failing_since_{};
};

void SessionRun::begin() {
    journal_.note_lasting({.kind = EventKind::session,
                           .texts = {{"plan", session_.plan_hash},
                                     {"rig", session_.rig_hash},
                                     {"named", session_.named_hash},
                                     {"boot", hardware_.moments().boot}}});
    if (settings_.fault_log.empty())
        return;
    if (const auto fault = latched_fault(settings_.fault_log))
        throw Error({"a fault was not acknowledged yet: " + *fault, settings_.fault_log.string(),
                     "expected `tsuya lab reset` once its cause is removed"});
}

void SessionRun::work() {
    lamp_.light(settings_.wait, progress_);
    warm_up();
    for (const std::size_t number : session_.missing) {
        take_frame(number);
        progress_("frames",
                  static_cast<double>(counted_) / static_cast<double>(session_.plan.frames.size()));
    }
    lamp_.wait_min_on(progress_);
}

void SessionRun::take_frame(std::size_t number) {
    const PlannedFrame &planned = session_.plan.frames[number];
    const auto step = [&] {
        taker_.go_to(planned);
        taker_.take({.number = number, .planned = planned});
    };
    if (attempt(number, step))
        ++counted_;
}

/// Tries a step until it succeeds or has failed too often.
bool SessionRun::attempt(std::optional<std::size_t> number, const std::function<void()> &step) {
    for (int tried = 1; tried <= settings_.tries; ++tried) {
        if (progress_.stopped())
            throw Interrupted("stopped between two frames");
        try {
            step();
            failing_since_.reset();
            return true;
        } catch (const SessionFault &) {
            throw;
        } catch (const Error &error) {
            recover_from(number, error, tried);
        }
    }
    return false;
}

/// The shutter is shut and the lamp stays lit: to light it again costs more than to wait.
void SessionRun::recover_from(std::optional<std::size_t> number, const Error &error, int tried) {
    taker_.close_shutter();
    const Problem &problem = error.problems().front();
    journal_.note_lasting({.kind = EventKind::fault,
                           .frame = number,
                           .texts = {{"why", problem.what}, {"where", problem.where}},
                           .numbers = {{"safety", 0}, {"tried", tried}}});
    const nanoseconds now = hardware_.clock.now();
    failing_since_ = failing_since_.value_or(now);
    if (now - *failing_since_ > rig_.lamp.hold)
        throw SessionFault({"nothing has succeeded for the lamp's hold_s; at last: " + problem.what,
                            problem.where, "expected a rig that works, then resume"},
                           false);
    const auto pause = std::chrono::round<nanoseconds>(kPause * tried);
    if (!hardware_.clock.sleep_until(now + pause, progress_.stop))
        throw Interrupted("stopped between two tries");
}

std::optional<double> SessionRun::take(const Shot &shot) {
    double mean = 0;
    const auto step = [&] {
        taker_.go_to(shot.planned);
        mean = taker_.take(shot);
    };
    return attempt(shot.number, step) ? std::optional(mean) : std::nullopt;
}

/// The first white frame of the plan under the next light, else under any.
PlannedFrame SessionRun::white_frame() const {
    const std::vector<PlannedFrame> &frames = session_.plan.frames;
    const DirectionPair &next = frames[session_.missing.front()].directions;
    const PlannedFrame *any = nullptr;
    for (const PlannedFrame &frame : frames) {
        if (frame.kind != FrameKind::white)
            continue;
        if (frame.directions.theta_i == next.theta_i && frame.directions.phi_i == next.phi_i)
            return frame;
        any = any ? any : &frame;
    }
    if (!any)
        throw Error({"the plan has no white frame", (session_.folder / "plan.jsonl").string(),
                     "expected one at least"});
    return *any;
}

/// The longest exposure of the camera that does not clip the standard.
double SessionRun::white_exposure(PlannedFrame white) {
    const double most = kWellExposed * (rig_.camera.saturation - rig_.camera.black);
    for (auto exposure = rig_.camera.exposures_s.rbegin();
         exposure != rig_.camera.exposures_s.rend(); ++exposure) {
        white.exposure_s = *exposure;
        if (const auto mean = take({.planned = white}); mean && *mean <= most)
            return *exposure;
    }
    throw SessionFault({"no exposure of the camera shows the white standard unclipped",
                        "camera.exposures_s", "expected a shorter one, or a darker lamp"},
                       false);
}

/// The lamp has burned for its time; now white frames must agree.
void SessionRun::warm_up() {
    PlannedFrame white = white_frame();
    white.exposure_s = white_exposure(white);
    std::deque<double> means;
    for (int i = 0; i < kMostWhite; ++i) {
        if (const auto mean = take({.planned = white}))
            means.push_back(*mean);
        if (means.size() > kWhiteAgree)
            means.pop_front();
        const auto [least, most] = std::minmax_element(means.begin(), means.end());
        if (means.size() == kWhiteAgree && *most - *least <= kWhiteTolerance * *least)
            return;
        progress_("white frames until the lamp is steady", static_cast<double>(i) / kMostWhite);
        const auto pause = std::chrono::round<nanoseconds>(kWhiteInterval);
        if (!hardware_.clock.sleep_until(hardware_.clock.now() + pause, progress_.stop))
            throw Interrupted("stopped while the lamp warmed up");
    }
    throw SessionFault(
        {"white frames do not agree to 0.3 % after " + std::to_string(kMostWhite) + " of them",
         "lamp " + rig_.lamp.serial, "expected a steady lamp"},
        false);
}

/// Lamp and shutter are off, or may still be on as `problems` says: then the failure follows there.
void SessionRun::end(const std::exception_ptr &failure, std::vector<Problem> &problems) {
    if (!failure)
        return leave("finished");
    try {
        std::rethrow_exception(failure);
    } catch (const SessionFault &fault) {
        end_by(fault, problems);
        if (!problems.empty())
            problems.push_back(fault.problems().front());
    } catch (const Interrupted &) {
        leave("stopped");
    } catch (const std::exception &error) {
        leave("ended by an error");
        if (!problems.empty())
            problems.push_back({.what = error.what()});
    }
}

/// What can still be written is; a fault that cannot be latched is a problem of its own.
void SessionRun::end_by(const SessionFault &fault, std::vector<Problem> &problems) {
    const Problem &problem = fault.problems().front();
    try {
        if (fault.safety() && !settings_.fault_log.empty())
            latch_fault(settings_.fault_log, problem.where + ": " + problem.what, journal_.now_s());
    } catch (const Error &error) {
        problems.push_back({"the fault is not latched: " + error.problems().front().what,
                            settings_.fault_log.string(), error.problems().front().accepted});
    }
    try {
        journal_.note_lasting({.kind = EventKind::fault,
                               .texts = {{"why", problem.what}, {"where", problem.where}},
                               .numbers = {{"safety", fault.safety() ? 1.0 : 0.0}}});
    } catch (const Error &) { // the journal itself may be what failed
    }
    leave("ended by a fault");
}

void SessionRun::leave(const std::string &how) {
    try {
        lamp_.went_out();
        journal_.note_lasting({.kind = EventKind::note, .texts = {{"what", how}}});
    } catch (const Error &) { // the error that ends the session is the one that is told
    }
}

} // namespace

SessionResult run_session(const std::filesystem::path &folder, const RigFile &rig,
                          const SessionHardware &hardware, const SessionSettings &settings,
                          const Progress &progress) {
    SessionJournal journal(folder, hardware.moments); // first: no other run changes it from here
    const Session session = read_session(folder);
    return SessionRun(session, journal, rig, hardware, settings, progress).run();
}

} // namespace tsuya::lab
