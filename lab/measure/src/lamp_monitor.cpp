#include "lamp_monitor.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tsuya::lab {
namespace {

constexpr double kSureSigmas = 10; // of a monitor that tells anything

/// DN a second of all the monitor's pixels; nothing where it is clipped or too dark to tell.
std::optional<LampShare> light_of(const ExposedPixels &pixels, const DarkPixels &dark,
                                  const Sensor &sensor) {
    const PixelRates rates = merge_exposures({&pixels, 1}, {&dark, 1}, sensor);
    double sum = 0, variance = 0;
    int count = 0;
    for (std::size_t i = 0; i < rates.rate.size(); ++i) {
        if (std::isnan(rates.rate[i]))
            continue;
        if (rates.clipped[i])
            return std::nullopt;
        sum += rates.rate[i];
        variance += rates.variance[i];
        ++count;
    }
    if (count == 0 || sum < kSureSigmas * std::sqrt(variance))
        return std::nullopt;
    return LampShare{sum / count, std::sqrt(variance) / count};
}

/// Puts the mean of those that are there, weighted by exposure, in the place of the others.
bool fill_gaps(std::vector<std::optional<LampShare>> &lights,
               const std::vector<FramePatches> &frames) {
    double sum = 0, variance = 0, time_s = 0;
    for (std::size_t k = 0; k < lights.size(); ++k)
        if (lights[k]) {
            sum += lights[k]->value * frames[k].planned_s;
            variance += std::pow(lights[k]->sigma * frames[k].planned_s, 2);
            time_s += frames[k].planned_s;
        }
    if (time_s == 0)
        return false;
    for (auto &light : lights)
        if (!light)
            light = LampShare{sum / time_s, std::sqrt(variance) / time_s};
    return true;
}

} // namespace

std::vector<std::vector<LampShare>> LampMonitor::shares_of(const std::vector<FramePatches> &frames,
                                                           const DarkFrames &dark,
                                                           const Sensor &sensor) {
    const std::size_t colours = frames.front().colours.size();
    std::vector<std::vector<LampShare>> shares(colours, std::vector<LampShare>(frames.size()));
    if (frames.front().monitor.empty())
        return shares;
    first_.resize(colours);
    for (std::size_t c = 0; c < colours; ++c) {
        std::vector<std::optional<LampShare>> lights;
        for (const FramePatches &frame : frames) {
            const auto at = dark.find(frame.planned_s);
            lights.push_back(light_of(frame.monitor[c].pixels,
                                      at == dark.end() ? DarkPixels{} : at->second.monitor[c],
                                      sensor));
        }
        if (!fill_gaps(lights, frames))
            return {};
        if (first_[c] == 0)
            first_[c] = lights.front()->value;
        for (std::size_t k = 0; k < frames.size(); ++k)
            shares[c][k] = {lights[k]->value / first_[c], lights[k]->sigma / first_[c]};
    }
    return shares;
}

} // namespace tsuya::lab
