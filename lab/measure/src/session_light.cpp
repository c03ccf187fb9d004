#include "session_light.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "tsuya/lab/frame_camera.h"
#include "tsuya/lab/number_text.h"
#include "tsuya/lab/view_geometry.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

constexpr double kSureWhite = 10;        // times its noise: what is darker is no standard
constexpr double kLargestUnevenness = 2; // light of two sides of the measured part

/// The mean of all numbers of a dark frame.
double level_of(const DarkFrame &dark) {
    double sum = 0;
    int count = 0;
    for (const DarkPixels &colour : dark.colours)
        for (const double dn : colour.dn)
            if (!std::isnan(dn)) {
                sum += dn;
                ++count;
            }
    return sum / count;
}

using Frames = std::vector<const CountedFrame *>;

class SessionLightReader {
  public:
    SessionLightReader(const Session &session, const MeasureSettings &settings,
                       const Progress &progress)
        : session_(session), settings_(settings), progress_(progress),
          reader_(session.rig.camera), sensor_{session.rig.camera.black,
                                               session.rig.camera.saturation,
                                               session.rig.camera.e_per_dn,
                                               session.rig.camera.read_noise_e} {}

    SessionLight read() {
        note_missing();
        if (settings_.corrections.dark)
            read_dark();
        if (!settings_.corrections.black)
            leave_black();
        const std::filesystem::path &flat = session_.rig.camera.flat;
        if (settings_.corrections.flat && !flat.empty())
            flat_ = FlatField(reader_.read_reach(flat, 1), sensor_, flat);
        std::map<std::size_t, Frames> views;
        for (const CountedFrame &frame : session_.frames)
            if (frame.planned.kind != FrameKind::dark)
                views[frame.planned.view].push_back(&frame);
        for (const auto &[view, frames] : views)
            if (!missing_.contains(view))
                read_view(frames);
        read_warm_up();
        if (light_.cloth.empty() || light_.white.empty())
            throw Error({std::string("the session has no frame of the ") +
                             (light_.cloth.empty() ? "cloth" : "white standard"),
                         session_.folder.string(), "expected a session that has been run"});
        return std::move(light_);
    }

  private:
    void leave_out(const PlannedFrame &planned, LeftOutReason reason, std::string detail) {
        if (planned.kind == FrameKind::cloth)
            light_.left_out.push_back(
                {planned.view, planned.directions, reason, std::move(detail)});
    }

    /// A view of the cloth needs all its frames; of the others, the frames that there are do.
    void note_missing() {
        for (const std::size_t number : session_.missing) {
            const PlannedFrame &planned = session_.plan.frames[number];
            if (planned.kind == FrameKind::cloth && missing_.insert(planned.view).second)
                leave_out(planned, LeftOutReason::missing,
                          "frame " + std::to_string(number) + " was not taken");
        }
    }

    FramePatches read_frame_of(const CountedFrame &frame) {
        const PlannedFrame &planned = frame.planned;
        if (progress_.stopped())
            throw Interrupted("stopped while the session's frames are read");
        progress_("read frames",
                  static_cast<double>(done_++) /
                      static_cast<double>(std::max<std::size_t>(session_.frames.size(), 1)));
        FramePatches patches =
            planned.kind == FrameKind::dark
                ? reader_.read_reach(frame.file, planned.exposure_s)
                : reader_.read(frame.file, planned.exposure_s, planned.directions.theta_r);
        if (!settings_.corrections.monitor)
            patches.monitor.clear();
        std::vector<std::string> colours;
        for (const ColourPixels &colour : patches.colours)
            colours.push_back(colour.name);
        if (light_.colours.empty())
            light_.colours = colours;
        if (light_.colours != colours)
            throw Error({"the picture has other colours than the first", frame.file.string(),
                         "expected pictures of one camera"});
        return patches;
    }

    void read_dark() {
        std::map<double, std::vector<FramePatches>> frames;
        for (const CountedFrame &frame : session_.frames)
            if (frame.planned.kind == FrameKind::dark)
                frames[frame.planned.exposure_s].push_back(read_frame_of(frame));
        const auto means = [](const std::vector<FramePatches> &list,
                              std::vector<ColourPixels> FramePatches::*part) {
            std::vector<DarkPixels> colours;
            for (std::size_t c = 0; c < (list.front().*part).size(); ++c) {
                std::vector<ExposedPixels> pixels;
                for (const FramePatches &patches : list)
                    pixels.push_back((patches.*part)[c].pixels);
                colours.push_back(mean_of_dark(pixels));
            }
            return colours;
        };
        for (const auto &[exposure_s, list] : frames)
            dark_[exposure_s] = {.area = list.front().grid.area,
                                 .colours = means(list, &FramePatches::colours),
                                 .monitor = means(list, &FramePatches::monitor)};
        find_black();
    }

    /// Black as it is now, from dark frames of two exposures: what is left without exposure. Dark
    /// current is electrons and has their noise, black has not.
    void find_black() {
        if (dark_.size() < 2)
            return;
        const auto &[shortest_s, least] = *dark_.begin();
        const auto &[longest_s, most] = *dark_.rbegin();
        const double low = level_of(least),
                     current = (level_of(most) - low) / (longest_s - shortest_s);
        sensor_.black = low - current * shortest_s;
    }

    /// Dark frames hold black and dark current: takes the first out of them.
    void leave_black() {
        for (auto &[exposure_s, dark] : dark_)
            for (auto *const part : {&dark.colours, &dark.monitor})
                for (DarkPixels &colour : *part)
                    for (double &dn : colour.dn)
                        dn -= sensor_.black;
        sensor_.black = 0;
    }

    void read_view(const Frames &frames) {
        const PlannedFrame &planned = frames.front()->planned;
        ViewLight view{.view = planned.view,
                       .directions = planned.directions,
                       .strike = frames.front()->strike};
        std::vector<FramePatches> patches;
        double exposure_s = 0;
        for (const CountedFrame *frame : frames) {
            try {
                patches.push_back(read_frame_of(*frame));
            } catch (const Error &error) {
                if (planned.kind != FrameKind::cloth)
                    throw;
                return leave_out(planned, LeftOutReason::missing, error.what());
            }
            const double said = patches.back().exposure_s.value_or(frame->planned.exposure_s);
            if (std::abs(said / frame->planned.exposure_s - 1) > kExposureTolerance)
                return leave_out(planned, LeftOutReason::wrong_exposure,
                                 frame->file.string() + " says " + number_text(said) +
                                     " s, the plan " + number_text(frame->planned.exposure_s) +
                                     " s");
            view.time_s += frame->time_s * frame->planned.exposure_s;
            exposure_s += frame->planned.exposure_s;
        }
        view.time_s /= exposure_s;
        const auto shares = monitor_.shares_of(patches, dark_, sensor_);
        if (shares.empty() && planned.kind != FrameKind::cloth)
            ++light_.without_monitor;
        if (shares.empty())
            return leave_out(planned, LeftOutReason::no_reference,
                             "the monitor is clipped or dark in each of its frames");
        view.colours = light_of(
            patches, shares,
            {.dark = dark_, .sensor = sensor_, .flat = flat_, .window = window_of(planned)});
        keep(planned, std::move(view));
    }

    void keep(const PlannedFrame &planned, ViewLight view) {
        if (planned.kind == FrameKind::white && is_clipped(view))
            ++light_.clipped_white;
        else if (planned.kind == FrameKind::white && is_dark(view))
            ++light_.dark_white;
        else if (planned.kind == FrameKind::white)
            light_.white.push_back(std::move(view));
        else if (planned.kind == FrameKind::trap)
            light_.trap.push_back(std::move(view));
        else if (!rejected(planned, view))
            light_.cloth.push_back(std::move(view));
    }

    static bool is_clipped(const ViewLight &view) {
        return std::any_of(view.colours.begin(), view.colours.end(),
                           [](const PatchLight &colour) { return colour.middle.clipped > 0; });
    }

    static bool is_dark(const ViewLight &view) {
        return std::any_of(view.colours.begin(), view.colours.end(), [](const PatchLight &colour) {
            return colour.middle.rate < kSureWhite * colour.middle.sigma;
        });
    }

    bool rejected(const PlannedFrame &planned, const ViewLight &view) {
        const double patch_mm =
                         patch_length_mm(session_.rig.camera.patch * session_.rig.camera.pixel_mm,
                                         planned.directions.theta_r),
                     spot_mm = spot_length_mm(session_.rig.lamp.spot_mm, planned.directions);
        const auto leave = [&](LeftOutReason reason, std::string detail) {
            leave_out(planned, reason, std::move(detail));
            return true;
        };
        if (spot_mm > 0 && patch_mm > spot_mm)
            return leave(LeftOutReason::misplaced, "the patch is " + number_text(patch_mm) +
                                                       " mm long on the cloth, the lit spot " +
                                                       number_text(spot_mm));
        for (const PatchLight &colour : view.colours) {
            if (colour.middle.clipped > 0)
                return leave(LeftOutReason::saturated,
                             detail::counted(colour.middle.clipped, "pixel of the patch is",
                                             "pixels of the patch are") +
                                 " clipped under every exposure");
            if (colour.uneven > kLargestUnevenness)
                return leave(LeftOutReason::misplaced, "one side of the patch has " +
                                                           number_text(colour.uneven) +
                                                           " times the light of the other");
        }
        return false;
    }

    PatchWindow window_of(const PlannedFrame &planned) const {
        const int side = session_.rig.camera.patch;
        const double pixel_mm = session_.rig.camera.pixel_mm;
        if (!settings_.repeat_mm || planned.kind != FrameKind::cloth)
            return even_window(side);
        return repeat_window(
            side, lattice_in_picture(*settings_.repeat_mm, pixel_mm, planned.directions));
    }

    /// White frames beside the plan, each a view of its own. That some are clipped is no warning:
    /// so a run finds the longest exposure that the standard allows.
    void read_warm_up() {
        const int clipped = light_.clipped_white;
        for (const CountedFrame &frame : session_.warm_up)
            read_view({&frame});
        light_.clipped_white = clipped;
    }

    const Session &session_;
    const MeasureSettings &settings_;
    const Progress &progress_;
    PatchReader reader_;
    Sensor sensor_;
    DarkFrames dark_{};
    FlatField flat_{};
    LampMonitor monitor_{};
    std::set<std::size_t> missing_{};
    std::size_t done_ = 0;
    SessionLight light_{};
};

} // namespace

SessionLight read_session_light(const Session &session, const MeasureSettings &settings,
                                const Progress &progress) {
    return SessionLightReader(session, settings, progress).read();
}

} // namespace tsuya::lab
