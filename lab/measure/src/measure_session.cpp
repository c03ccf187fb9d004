#include "tsuya/lab/measure_session.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "channel_estimate.h"
#include "tsuya/lab/number_text.h"
#include "tsuya/lab/view_geometry.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "utc_text.h"

namespace tsuya::lab {
namespace {

constexpr double kUnsharpShare = 0.1; // of the usual contrast from pixel to pixel
constexpr double kSureSigmas = 3;
constexpr double kSureContrast = 1e-3;  // squared; below, there is nothing to be sharp
constexpr double kWidestBlur = 1.0 / 3; // of the narrowest lobe

constexpr const char *kNoFlicker =
    "the lamp's flicker is not known, and is in no error: that takes three white frames of one "
    "light or more";

constexpr const char *kNoFlat =
    "the patch moves in the picture, and without a flat field what the lens takes from the "
    "picture's edge is in the values";

std::string degrees_text(double angle) { return number_text(angle / kDegree, 4); }

void check(const MeasureSettings &settings, const Session &session) {
    Problems problems;
    problems.need(settings.jump_limit > 0, "the limit of a jump is not above 0", "jump_limit",
                  "expected a relative difference such as 0.02");
    if (settings.repeat_mm) {
        problems.need((*settings.repeat_mm)[0] > 0 && (*settings.repeat_mm)[1] > 0,
                      "the repeat of the weave is not above 0 mm", "repeat_mm",
                      "expected two lengths such as 0.4, 0.4");
        problems.need(session.rig.camera.pixel_mm > 0,
                      "whole repeats cannot be counted: the rig does not say how large a pixel is",
                      (session.folder / "rig.toml").string() + ": camera.pixel_mm",
                      "expected a length such as 0.05");
    }
    problems.throw_if_any();
}

/// What the black trap shows of the same light, in DN a second: it lies over the cloth, and has no
/// contrast. 0 without a trap.
double stray_light(const SessionLight &light, const DirectionPair &directions) {
    double sum = 0;
    int count = 0;
    for (const ViewLight &trap : light.trap)
        if (std::abs(trap.directions.theta_i - directions.theta_i) < 1e-6 &&
            std::abs(trap.directions.phi_i - directions.phi_i) < 1e-6) {
            sum += trap.colours[0].all.rate;
            ++count;
        }
    return count == 0 ? 0 : sum / count;
}

/// Squared contrast from pixel to pixel of the cloth's own light.
struct Sharpness {
    double value = 0, sigma = 0;
};

/// Nothing where the cloth's own light cannot be told from stray light.
std::optional<Sharpness> sharpness_of(const ViewLight &view, const SessionLight &light) {
    const PatchMean &patch = view.colours[0].middle;
    const double own = patch.rate - stray_light(light, view.directions);
    if (own < kSureSigmas * patch.sigma)
        return std::nullopt;
    const double scale = (patch.rate / own) * (patch.rate / own);
    return Sharpness{patch.sharpness * scale, patch.sharpness_sigma * scale};
}

/// Views with far less contrast from pixel to pixel than others of the same tilt are out of focus,
/// or were moved.
void leave_out_unsharp(SessionLight &light) {
    std::map<long, std::vector<double>> rings;
    const auto ring_of = [](const ViewLight &view) {
        return std::lround(view.directions.theta_r / kDegree);
    };
    for (const ViewLight &view : light.cloth)
        if (const auto sharpness = sharpness_of(view, light))
            rings[ring_of(view)].push_back(sharpness->value);
    for (auto &[ring, values] : rings)
        std::nth_element(values.begin(),
                         values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                         values.end());
    std::erase_if(light.cloth, [&](const ViewLight &view) {
        const auto sharpness = sharpness_of(view, light);
        if (!sharpness)
            return false;
        const std::vector<double> &values = rings[ring_of(view)];
        const double usual = values[values.size() / 2];
        if (usual < kSureContrast ||
            sharpness->value + kSureSigmas * sharpness->sigma >= kUnsharpShare * usual)
            return false;
        light.left_out.push_back({view.view, view.directions, LeftOutReason::unsharp,
                                  "its contrast from pixel to pixel is " +
                                      number_text(sharpness->value / usual, 2) + " of the usual"});
        return true;
    });
}

/// A view that one colour has not is in no table.
void agree(SessionMeasurement &measured) {
    auto &left_out = measured.left_out;
    std::stable_sort(left_out.begin(), left_out.end(),
                     [](const auto &a, const auto &b) { return a.view < b.view; });
    left_out.erase(std::unique(left_out.begin(), left_out.end(),
                               [](const auto &a, const auto &b) { return a.view == b.view; }),
                   left_out.end());
    std::set<std::size_t> views;
    for (const LeftOutView &view : left_out)
        views.insert(view.view);
    for (ChannelMeasurement &channel : measured.channels)
        std::erase_if(channel.views, [&](const auto &view) { return views.contains(view.view); });
}

double difference_of(const std::vector<ChannelMeasurement> &channels) {
    double largest = 0;
    std::vector<double> off(channels.size());
    double sum = 0;
    for (std::size_t i = 0; i < channels[0].views.size(); ++i) {
        double mean = 0;
        for (const ChannelMeasurement &channel : channels)
            mean += channel.views[i].brdf_per_sr / static_cast<double>(channels.size());
        sum += mean;
        for (std::size_t c = 0; c < channels.size(); ++c)
            off[c] += std::abs(channels[c].views[i].brdf_per_sr - mean);
    }
    for (const double total : off)
        largest = std::max(largest, sum > 0 ? total / sum : 0);
    return largest;
}

std::map<std::string, std::string> keys_of(const Session &session,
                                           const ChannelMeasurement &channel) {
    const RigCamera &camera = session.rig.camera;
    const CountedFrame &first = session.frames.front();
    std::map<std::string, std::string> keys{
        {"instrument", "camera goniometer"},
        {"date", utc_text(first.time_s, "%Y-%m-%dT%H:%M:%SZ")},
        {"camera", camera.command.empty() ? "shutter line" : camera.command.front()},
        {"channel", channel.name},
        {"lamp", "serial " +
                     (session.rig.lamp.serial.empty() ? "unknown" : session.rig.lamp.serial) +
                     ", " + number_text(first.lamp_hours) + " h"},
        {"white_standard",
         std::holds_alternative<double>(session.rig.white.rho_std)
             ? number_text(std::get<double>(session.rig.white.rho_std))
             : std::get<std::filesystem::path>(session.rig.white.rho_std).filename().string()},
        {"provenance", "plan " + session.plan_hash + ", rig " + session.rig_hash + ", journal " +
                           session.journal_hash}};
    if (session.dry_run) { // nobody shall take it for a measurement
        keys["instrument"] = "dry run of a camera goniometer";
        keys["camera"] = "virtual camera";
        keys["lamp"] = "none";
    }
    if (session.rig.white.height_mm != 0)
        keys["white_height_mm"] = number_text(session.rig.white.height_mm);
    return keys;
}

void fill_table(ChannelMeasurement &channel, const Session &session) {
    channel.table = {.keys = keys_of(session, channel), .symmetry = session.plan.symmetry};
    for (const MeasuredView &view : channel.views)
        channel.table.rows.push_back({.theta_i = view.directions.theta_i,
                                      .phi_i = view.directions.phi_i,
                                      .theta_r = view.directions.theta_r,
                                      .phi_r = view.directions.phi_r,
                                      .brdf_per_sr = view.brdf_per_sr,
                                      .sigma_per_sr = view.sigma_per_sr()});
}

void add_blur(SessionMeasurement &measured, const RigFile &rig) {
    measured.lamp_angle = disk_angle(rig.lamp.diameter_mm, rig.lamp.distance_mm);
    measured.aperture_angle = disk_angle(rig.camera.aperture_mm, rig.camera.distance_mm);
    measured.narrowest_lobe = narrowest_lobe(measured.channels[0].table);
    const auto warn = [&](const char *what, double angle) {
        const bool wide = angle > kWidestBlur * measured.narrowest_lobe;
        if (wide)
            measured.warnings.push_back(
                std::string(what) + " " + degrees_text(angle) +
                " degrees, more than a third of the narrowest lobe, which is " +
                degrees_text(measured.narrowest_lobe) + " degrees wide");
        return wide;
    };
    const bool lamp = warn("the lamp fills", measured.lamp_angle);
    const bool lens = warn("the camera's lens fills", measured.aperture_angle);
    if (!lamp && !lens) // their widths add up as those of blurs do
        warn("lamp and lens together blur over",
             std::hypot(measured.lamp_angle, measured.aperture_angle));
    for (ChannelMeasurement &channel : measured.channels)
        for (std::size_t i = 0; i < measured.warnings.size(); ++i)
            channel.table.keys["warning" + (i > 0 ? std::to_string(i + 1) : "")] =
                measured.warnings[i];
}

} // namespace

const char *name_of(LeftOutReason reason) {
    constexpr std::array kNames{"saturated", "underexposed",   "missing",   "unsharp",
                                "misplaced", "wrong-exposure", "lamp-jump", "no-reference"};
    return kNames[static_cast<std::size_t>(reason)];
}

double MeasuredView::sigma_per_sr() const {
    return std::sqrt(noise * noise + drift * drift + texture * texture + white * white);
}

SessionMeasurement measure_session(const Session &session, const MeasureSettings &settings,
                                   const Progress &progress) {
    check(settings, session);
    SessionLight light = read_session_light(session, settings, progress);
    leave_out_unsharp(light);
    SessionMeasurement measured{.left_out = light.left_out};
    for (std::size_t c = 0; c < light.colours.size(); ++c) {
        ChannelEstimate estimate = estimate_channel(light, c, session, settings);
        measured.channels.push_back(std::move(estimate.channel));
        measured.left_out.insert(measured.left_out.end(), estimate.left_out.begin(),
                                 estimate.left_out.end());
        if (c == 0)
            measured.warnings = std::move(estimate.warnings);
    }
    agree(measured);
    for (ChannelMeasurement &channel : measured.channels)
        fill_table(channel, session);
    if (light.clipped_white > 0)
        measured.warnings.push_back(
            detail::counted(light.clipped_white, "view") +
            " of the white standard left out: clipped under every exposure");
    if (light.dark_white > 0)
        measured.warnings.push_back(detail::counted(light.dark_white, "view") +
                                    " of the white standard left out: dark");
    if (light.without_monitor > 0)
        measured.warnings.push_back(detail::counted(light.without_monitor, "view") +
                                    " of the white standard or the trap left out: the monitor is "
                                    "clipped or dark there");
    if (session.rig.camera.patch_at.size() > 1 && session.rig.camera.flat.empty())
        measured.warnings.emplace_back(kNoFlat);
    if (measured.channels[0].flicker == 0)
        measured.warnings.emplace_back(kNoFlicker);
    measured.channel_difference = difference_of(measured.channels);
    add_blur(measured, session.rig);
    return measured;
}

} // namespace tsuya::lab
