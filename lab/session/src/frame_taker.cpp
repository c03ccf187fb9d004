#include "frame_taker.h"

#include <algorithm>
#include <cmath>

namespace tsuya::lab {
namespace {

using std::chrono::nanoseconds;

constexpr std::chrono::milliseconds kLook{20};  // at a camera that is busy
constexpr std::chrono::milliseconds kWake{300}; // of a half-pressed camera, before the exposure

nanoseconds nanoseconds_of(Seconds time) { return std::chrono::round<nanoseconds>(time); }

} // namespace

FrameTaker::FrameTaker(const RigFile &rig, const SessionHardware &hardware, FrameStore &store,
                       SessionJournal &journal, const LampKeeper &lamp,
                       const std::atomic<bool> *stop)
    : rig_(rig), hardware_(hardware), store_(store), journal_(journal), lamp_(lamp), stop_(stop) {}

void FrameTaker::sleep(Seconds time) {
    if (!hardware_.clock.sleep_until(hardware_.clock.now() + nanoseconds_of(time), stop_))
        throw Interrupted("stopped between two frames");
}

void FrameTaker::place(FrameKind kind) {
    if (kind == FrameKind::dark || sample_ == kind)
        return;
    sample_.reset(); // until it is there
    hardware_.mechanics.place(kind);
    sample_ = kind;
}

void FrameTaker::go_to(const PlannedFrame &frame) {
    hardware_.clock.check();
    place(frame.kind);
    AxisAngles from{};
    for (std::size_t i = 0; i < kAxes; ++i)
        from[i] = at_[i].value_or(0);
    const AxisAngles to = positions_deg(rig_, frame.directions, from);
    JournalEvent move{.kind = EventKind::move};
    for (std::size_t i = 0; i < kAxes; ++i)
        if (!at_[i] || *at_[i] != to[i])
            move.numbers[name_of(static_cast<AxisName>(i))] = to[i];
    if (move.numbers.empty())
        return;
    journal_.note(move);
    Seconds settle{0};
    for (std::size_t i = 0; i < kAxes; ++i) {
        if (at_[i] && *at_[i] == to[i])
            continue;
        at_[i].reset();
        hardware_.mechanics.move(static_cast<AxisName>(i), to[i]);
        at_[i] = to[i];
        settle = std::max(settle, rig_.axes[i].settle);
    }
    sleep(settle);
    journal_.note({.kind = EventKind::arrived});
}

void FrameTaker::wait_for_camera() {
    const nanoseconds deadline = hardware_.clock.now() + nanoseconds_of(rig_.camera.timeout);
    while (hardware_.busy && hardware_.busy->active()) {
        if (hardware_.clock.now() >= deadline)
            throw Error({"the camera stays busy", hardware_.busy->name(),
                         "expected it to be free within its timeout_s"});
        sleep(kLook);
    }
}

/// The shutter's shortest interval and largest duty.
void FrameTaker::wait_for_shutter() {
    if (next_opening_ && !hardware_.clock.sleep_until(*next_opening_, stop_))
        throw Interrupted("stopped between two frames");
}

void FrameTaker::set_shutter(bool open) {
    if (!hardware_.shutter)
        return;
    try {
        hardware_.shutter->set(open);
    } catch (const Error &error) {
        throw SessionFault(error.problems().front(), false);
    }
}

FrameTaker::Exposure FrameTaker::expose(Shot &shot) {
    const OffGuard released({hardware_.half_press});
    if (hardware_.half_press) {
        hardware_.half_press->set(true);
        sleep(kWake);
    }
    const bool opens = shot.planned.kind != FrameKind::dark && hardware_.shutter;
    const Seconds lag = opens ? rig_.shutter.lag : Seconds(0);
    const bool triggers = rig_.camera.command.empty();
    if (opens) {
        const Seconds open = Seconds(shot.planned.exposure_s) + (triggers ? Seconds(0) : lag);
        const Seconds pause = std::max(rig_.shutter.min_interval, open / rig_.shutter.max_duty);
        next_opening_ = hardware_.clock.now() + nanoseconds_of(pause);
        set_shutter(true);
        if (!triggers)
            sleep(lag); // no picture begins before the blades are open
    }
    const OffGuard closed({opens ? hardware_.shutter : nullptr});
    // What the line triggers begins and ends late by the same time.
    const double late_s = triggers ? lag.count() : 0;
    shot.time_s = journal_.now_s() + late_s;
    hardware_.camera.expose(shot);
    const Exposure exposure{.begin_s = shot.time_s, .end_s = journal_.now_s() + late_s};
    if (opens) {
        set_shutter(false);
        sleep(lag); // nothing moves before the blades are shut
    }
    return exposure;
}

double FrameTaker::take(const Shot &asked) {
    wait_for_camera();
    wait_for_shutter();
    hardware_.clock.check();
    Shot shot = asked;
    shot.file = store_.place_for(shot.number);
    journal_.note_lasting({.kind = EventKind::open,
                           .frame = shot.number,
                           .numbers = {{"exposure_s", shot.planned.exposure_s}}});
    try {
        const Exposure exposure = expose(shot);
        hardware_.clock.check(); // an exposure during which the housing was opened never counts
        journal_.note({.kind = EventKind::close, .frame = shot.number});
        hardware_.camera.collect(shot);
        const FrameStore::Checked checked = store_.check(shot, stop_);
        journal_.note_lasting(count_event(shot, checked.facts, checked.hash,
                                          0.5 * (exposure.begin_s + exposure.end_s)));
        store_.keep(checked.hash);
        return checked.facts.patch_mean;
    } catch (const SessionFault &) {
        throw;
    } catch (const Error &error) {
        close_shutter();
        store_.reject(shot.number, shot.file, error.problems().front().what);
        throw;
    }
}

JournalEvent FrameTaker::count_event(const Shot &shot, const FrameFacts &facts,
                                     const std::string &hash, double middle_s) const {
    const PlannedFrame &planned = shot.planned;
    JournalEvent event{.kind = EventKind::ok,
                       .frame = shot.number,
                       .texts = {{"file", store_.name_of(shot.file)}, {"hash", hash}},
                       .numbers = {{"middle_s", middle_s},
                                   {"exposure_s", facts.exposure_s.value_or(planned.exposure_s)},
                                   {"patch_mean", facts.patch_mean},
                                   {"strike", lamp_.strike()},
                                   {"lamp_hours", lamp_.hours()}}};
    if (!shot.number) {
        event.numbers["planned_s"] = planned.exposure_s;
        event.numbers["theta_i_deg"] = planned.directions.theta_i / kDegree;
        event.numbers["phi_i_deg"] = planned.directions.phi_i / kDegree;
        event.numbers["theta_r_deg"] = planned.directions.theta_r / kDegree;
        event.numbers["phi_r_deg"] = planned.directions.phi_r / kDegree;
    }
    return event;
}

} // namespace tsuya::lab
