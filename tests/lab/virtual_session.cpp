#include "lab/virtual_session.h"

#include <cmath>
#include <map>

#include "tsuya/sdk/file.h"

namespace tsuya::test {
namespace {

using lab::FrameKind, lab::PlannedFrame;

constexpr double kStart_s = 1.8e9; // seconds since 1970

std::string rig_text(const VirtualSession &settings) {
    std::string text = "schema = \"tsuya-rig 1\"\n"
                       "[lamp]\nkind = \"metal-halide\"\nserial = \"MH-1\"\n"
                       "[camera]\ncommand = [\"camera\", \"{file}\", \"{exposure}\"]\n"
                       "black = 512\nsaturation = 15800\npatch = 16\npixel_mm = 0.05\n"
                       "e_per_dn = " +
                       std::to_string(settings.e_per_dn) +
                       "\nread_noise_e = " + std::to_string(settings.read_noise_e) + "\n" +
                       settings.camera_lines + "[white]\n" + settings.white_lines;
    if (settings.white_lines.find("rho_std") == std::string::npos)
        text += "rho_std = 0.99\n";
    for (const char *axis : {"lamp_theta", "lamp_phi", "camera", "stage"})
        text +=
            std::string("[axes.") + axis + "]\ndrive = \"operator\"\nlimits_deg = [-360, 360]\n";
    return text + settings.rig_lines;
}

/// Adds views with all exposures.
class Planner {
  public:
    Planner(const lab::RigFile &rig, const VirtualSession &settings)
        : exposures_(rig.camera.exposures_s), settings_(settings) {
        plan_.symmetry = settings.directions.symmetry;
        plan_.white = settings.white;
        plan_.views = "test";
    }

    lab::Plan plan() {
        dark();
        const auto &pairs = settings_.directions.pairs;
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const bool new_light = i == 0 || pairs[i].theta_i != pairs[i - 1].theta_i ||
                                   pairs[i].phi_i != pairs[i - 1].phi_i;
            if (new_light && i > 0)
                add(FrameKind::white, reference(pairs[i - 1]));
            if (new_light || i % settings_.white_every == 0)
                add(FrameKind::white, reference(pairs[i]));
            if (new_light)
                add(FrameKind::trap, reference(pairs[i]));
            if (settings_.white == lab::WhiteUse::each_view)
                add(FrameKind::white, pairs[i]);
            add(FrameKind::cloth, pairs[i]);
        }
        add(FrameKind::white, reference(pairs.back()));
        dark();
        return plan_;
    }

  private:
    static DirectionPair reference(const DirectionPair &at) {
        return {at.theta_i, at.phi_i, 45 * kDegree, at.phi_i + 90 * kDegree};
    }
    void add(FrameKind kind, const DirectionPair &at) {
        for (const double exposure_s : exposures_)
            plan_.frames.push_back({kind, view_, at, exposure_s});
        ++view_;
    }
    void dark() {
        for (int i = 0; i < settings_.dark_frames; ++i)
            add(FrameKind::dark, {});
    }

    std::vector<double> exposures_;
    const VirtualSession &settings_;
    lab::Plan plan_{};
    std::size_t view_ = 0;
};

std::set<std::size_t> missing_frames(const lab::Plan &plan, const VirtualSession &settings) {
    std::set<std::size_t> numbers;
    for (const std::size_t n : settings.missing_views) {
        std::size_t last = 0;
        for (std::size_t number = 0; number < plan.frames.size(); ++number)
            if (plan.frames[number].view == plan_view(plan, n))
                last = number;
        numbers.insert(last);
    }
    return numbers;
}

} // namespace

std::size_t plan_view(const lab::Plan &plan, std::size_t n) {
    std::set<std::size_t> views;
    for (const PlannedFrame &frame : plan.frames)
        if (frame.kind == FrameKind::cloth)
            views.insert(frame.view);
    return *std::next(views.begin(), static_cast<std::ptrdiff_t>(n));
}

lab::Session make_virtual_session(const std::filesystem::path &folder,
                                  const VirtualSession &settings) {
    std::filesystem::create_directories(folder / "frames");
    write_file(folder / "rig.toml", rig_text(settings));
    const lab::RigFile rig = lab::read_rig_file(folder / "rig.toml");
    const lab::Plan plan = Planner(rig, settings).plan();
    lab::write_plan(plan, folder / "plan.jsonl");
    const std::set<std::size_t> missing = missing_frames(plan, settings);
    lab::VirtualScene scene = settings.scene;
    if (settings.glint_view)
        scene.glint_view = plan_view(plan, *settings.glint_view);
    lab::VirtualScene after = scene;
    after.white_dn_per_s *= settings.jump;
    lab::VirtualCameraSettings camera_after = settings.camera;
    camera_after.monitor_dn_per_s *= settings.jump;
    lab::VirtualCamera before_jump(scene, rig.camera, settings.camera),
        after_jump(after, rig.camera, camera_after);
    const double jump_view =
        settings.jump_at < 1e8
            ? static_cast<double>(plan_view(plan, static_cast<std::size_t>(settings.jump_at)))
            : 1e9;
    std::string journal;
    std::uint64_t seq = 0;
    double time_s = kStart_s;
    for (std::size_t number = 0; number < plan.frames.size(); ++number) {
        const PlannedFrame &planned = plan.frames[number];
        if (number > 0 && planned.view != plan.frames[number - 1].view)
            time_s += settings.seconds_a_view;
        const std::string name = "frames/" + std::to_string(number) + ".tif";
        const lab::Shot shot{
            .number = number, .planned = planned, .file = folder / name, .time_s = time_s};
        time_s += planned.exposure_s;
        if (missing.contains(number))
            continue;
        lab::VirtualCamera &camera =
            static_cast<double>(planned.view) >= jump_view ? after_jump : before_jump;
        camera.expose(shot);
        camera.collect(shot);
        journal +=
            lab::journal_line({.kind = lab::EventKind::ok,
                               .frame = number,
                               .texts = {{"file", name}, {"hash", "0"}},
                               .numbers = {{"middle_s", shot.time_s + planned.exposure_s / 2},
                                           {"exposure_s", planned.exposure_s},
                                           {"strike", 1},
                                           {"lamp_hours", 100}},
                               .seq = seq++,
                               .time_s = time_s}) +
            "\n";
    }
    write_file(folder / "journal.jsonl", journal);
    return lab::read_session(folder);
}

std::function<double(const DirectionPair &)> looked_up(const ReflectanceTable &table) {
    const auto key = [](const DirectionPair &d) {
        const auto r = [](double angle) { return std::lround(angle * 1e6); };
        return std::array{r(d.theta_i), r(d.phi_i), r(d.theta_r), r(d.phi_r)};
    };
    std::map<std::array<long, 4>, double> values;
    for (const ReflectanceRow &row : table.rows)
        values[key({row.theta_i, row.phi_i, row.theta_r, row.phi_r})] = row.brdf_per_sr;
    return [values, key](const DirectionPair &d) { return values.at(key(d)); };
}

} // namespace tsuya::test
