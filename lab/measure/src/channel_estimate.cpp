#include "channel_estimate.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tsuya/lab/number_text.h"
#include "tsuya/lab/view_geometry.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

constexpr double kLambertianUpTo = 45 * kDegree + 1e-9;

long rounded(double angle) { return std::lround(angle / (1e-6)); }

/// Directions as keys: what differs by rounding is the same.
using LightKey = std::pair<long, long>;
LightKey light_key(const DirectionPair &d) { return {rounded(d.theta_i), rounded(d.phi_i)}; }
using ViewKey = std::tuple<long, long, long, long>;
ViewKey view_key(const DirectionPair &d) {
    return {rounded(d.theta_i), rounded(d.phi_i), rounded(d.theta_r), rounded(d.phi_r)};
}

/// The white standard under one direction of light: over time at the reference view, and at other
/// views.
struct LightReference {
    DirectionPair directions{}; ///< of the reference view
    std::vector<WhiteReading> readings{};
    std::map<ViewKey, std::vector<WhiteReading>> views{};
    std::vector<WhiteReading> trap{};
    double stray = 0, stray_sigma = 0; ///< light of the trap over that of the white
};

class ChannelEstimator {
  public:
    ChannelEstimator(const SessionLight &light, std::size_t colour, const Session &session,
                     const MeasureSettings &settings)
        : light_(light), colour_(colour), session_(session), settings_(settings),
          standard_(session.rig.white, light.colours[colour]) {
        estimate_.channel.name = light.colours[colour];
        for (const ViewLight &white : light.white)
            take_white(white);
        for (const ViewLight &trap : light.trap)
            if (const auto at = references_.find(light_key(trap.directions));
                at != references_.end())
                at->second.trap.push_back(reading_of(trap, &PatchLight::all));
        find_flicker();
        for (auto &[key, reference] : references_)
            find_stray(reference);
    }

    ChannelEstimate estimate() {
        for (const ViewLight &cloth : light_.cloth)
            take_cloth(cloth);
        for (const auto &[key, reference] : references_)
            estimate_.channel.lamp.push_back({.theta_i = reference.directions.theta_i,
                                              .phi_i = reference.directions.phi_i,
                                              .readings = reference.readings});
        estimate_.warnings = standard_.warnings();
        return std::move(estimate_);
    }

  private:
    /// Of the white standard the patch that the cloth is seen in, of the black trap all there is.
    WhiteReading reading_of(const ViewLight &view, PatchMean PatchLight::*part) const {
        const PatchLight &light = view.colours[colour_];
        const PatchMean &mean = light.*part;
        return {view.time_s, mean.rate, std::hypot(mean.sigma, light.lamp), view.strike};
    }

    /// The reference view of a light is that of its first white frame.
    void take_white(const ViewLight &white) {
        const auto [at, fresh] = references_.try_emplace(light_key(white.directions));
        LightReference &reference = at->second;
        if (fresh)
            reference.directions = white.directions;
        if (view_key(white.directions) == view_key(reference.directions))
            reference.readings.push_back(reading_of(white, &PatchLight::middle));
        else
            reference.views[view_key(white.directions)].push_back(
                reading_of(white, &PatchLight::middle));
    }

    void find_flicker() {
        std::vector<std::vector<WhiteReading>> lists;
        for (const auto &[key, reference] : references_)
            lists.push_back(reference.readings);
        estimate_.channel.flicker = flicker_of(lists).value_or(0);
    }

    LampDrift drift_of(const LightReference &reference) const {
        return {reference.readings, settings_.jump_limit, estimate_.channel.flicker};
    }

    /// The lamp as the reference view shows it.
    std::optional<LampLight> lamp_at(const LightReference &reference, double time_s,
                                     int strike) const {
        if (settings_.corrections.drift)
            return drift_of(reference).at(time_s, strike);
        const WhiteReading &first = reference.readings.front();
        return LampLight{.rate = first.rate, .sigma = first.sigma};
    }

    void find_stray(LightReference &reference) const {
        if (!settings_.corrections.trap || reference.trap.empty())
            return;
        double variance = 0;
        int count = 0;
        for (const WhiteReading &trap : reference.trap)
            if (const auto lamp = lamp_at(reference, trap.time_s, trap.strike)) {
                reference.stray += trap.rate / lamp->rate;
                variance += trap.sigma * trap.sigma / (lamp->rate * lamp->rate);
                ++count;
            }
        if (count == 0)
            return;
        reference.stray /= count;
        reference.stray_sigma = std::sqrt(variance) / count;
        if (reference.stray >= 1)
            throw Error({"the black trap is as bright as the white standard",
                         session_.folder.string(), "expected frames of a black trap"});
    }

    void leave_out(const ViewLight &cloth, LeftOutReason reason, std::string detail) {
        estimate_.left_out.push_back({cloth.view, cloth.directions, reason, std::move(detail)});
    }

    /// The white standard at a view of the cloth and a time, with the reflectance that it has
    /// there.
    struct White {
        double rate = 0, drift = 0; ///< DN a second; its relative error
        double brdf_per_sr = 0;
        bool assumed = false; ///< an ideal diffuser, seen from elsewhere
    };
    White white_at(const LightReference &reference, const LampLight &lamp,
                   const DirectionPair &directions) const {
        const RigFile &rig = session_.rig;
        White white{.rate = lamp.rate, .drift = lamp.sigma / lamp.rate};
        DirectionPair seen = reference.directions;
        const auto own = reference.views.find(view_key(directions));
        if (own != reference.views.end()) {
            double share = 0, variance = 0; // of the reference view's light
            for (const WhiteReading &reading : own->second)
                if (const auto then = lamp_at(reference, reading.time_s, reading.strike)) {
                    share += reading.rate / then->rate;
                    variance += (reading.sigma * reading.sigma + then->sigma * then->sigma) /
                                (then->rate * then->rate);
                }
            const auto count = static_cast<double>(own->second.size());
            white.rate *= share / count;
            white.drift = std::hypot(white.drift, std::sqrt(variance) / share);
            seen = directions;
        }
        white.rate /=
            raised_irradiance(rig.white.height_mm, rig.lamp.spot_mm, rig.lamp.distance_mm, seen);
        white.brdf_per_sr = standard_.brdf_per_sr(seen);
        white.assumed = !standard_.is_table() &&
                        std::max(directions.theta_i, directions.theta_r) > kLambertianUpTo;
        return white;
    }

    void take_cloth(const ViewLight &cloth) {
        const auto at = references_.find(light_key(cloth.directions));
        const auto lamp = at == references_.end() ? std::nullopt
                                                  : lamp_at(at->second, cloth.time_s, cloth.strike);
        if (!lamp)
            return leave_out(cloth, LeftOutReason::no_reference,
                             "the white standard was not seen under this light");
        if (lamp->jump)
            return leave_out(cloth, LeftOutReason::lamp_jump,
                             "the white frames before and after it differ by more than " +
                                 number_text(100 * settings_.jump_limit) + " %");
        const LightReference &reference = at->second;
        const White white = white_at(reference, *lamp, cloth.directions);
        const PatchLight &light = cloth.colours[colour_];
        // [Takeda] Eq. 2, with what the black trap shows taken off both.
        const double stray = reference.stray * lamp->rate;
        const double scale = white.brdf_per_sr / (white.rate - stray);
        MeasuredView view{.view = cloth.view,
                          .directions = cloth.directions,
                          .time_s = cloth.time_s,
                          .brdf_per_sr = scale * (light.middle.rate - stray)};
        view.noise = scale * std::hypot(light.middle.sigma, reference.stray_sigma * lamp->rate);
        if (view.brdf_per_sr <= view.noise) // 0 would be a value, and a wrong one
            return leave_out(cloth, LeftOutReason::underexposed,
                             "the light is " + number_text(light.middle.rate - stray) +
                                 " DN/s, its noise " + number_text(view.noise / scale));
        view.drift = std::hypot(view.brdf_per_sr * white.drift, scale * light.lamp);
        view.texture = scale * light.texture;
        view.white = white.assumed ? view.brdf_per_sr * session_.rig.white.sigma : 0;
        estimate_.channel.views.push_back(view);
    }

    const SessionLight &light_;
    std::size_t colour_;
    const Session &session_;
    const MeasureSettings &settings_;
    WhiteStandard standard_;
    std::map<LightKey, LightReference> references_{};
    ChannelEstimate estimate_{};
};

} // namespace

ChannelEstimate estimate_channel(const SessionLight &light, std::size_t colour,
                                 const Session &session, const MeasureSettings &settings) {
    return ChannelEstimator(light, colour, session, settings).estimate();
}

} // namespace tsuya::lab
