#include "view_light.h"

#include <algorithm>
#include <cmath>

namespace tsuya::lab {
namespace {

// Of the variance of 9 means over that of noise: it stays below in 95 % of the cases.
constexpr double kNoiseExplains = 1.94;

/// One row or column of patches at the edge of the grid.
struct GridSide {
    double light = 0, variance = 0;

    void add(const PatchMean &patch) {
        light += patch.rate;
        variance += patch.sigma * patch.sigma;
    }
    /// Not less than what noise makes of no light.
    double at_least_noise() const { return std::max(light, 3 * std::sqrt(variance)); }
};

/// Larger over smaller light of opposite sides of the grid.
double unevenness(const std::vector<PatchMean> &patches, int across) {
    if (across < 3)
        return 1;
    double worst = 1;
    for (const auto &[along, step] : {std::pair{1, across}, {across, 1}}) {
        GridSide low, high;
        for (int i = 0; i < across; ++i) {
            low.add(patches[static_cast<std::size_t>(i * along)]);
            high.add(patches[static_cast<std::size_t>(i * along + (across - 1) * step)]);
        }
        const double ratio = low.at_least_noise() / high.at_least_noise();
        worst = std::max({worst, ratio, 1 / ratio});
    }
    return worst;
}

std::vector<PatchMean> patches_of(const PixelRates &pixels, const PatchGrid &grid,
                                  const PatchWindow &window) {
    std::vector<PatchMean> patches;
    for (int y = 0; y < grid.across; ++y)
        for (int x = 0; x < grid.across; ++x)
            patches.push_back(mean_of_patch(pixels, grid.width(), x * grid.side, y * grid.side,
                                            grid.side, window.weights));
    return patches;
}

PatchMean mean_of(const std::vector<PatchMean> &patches) {
    const auto count = static_cast<double>(patches.size());
    PatchMean mean;
    double variance = 0;
    for (const PatchMean &patch : patches) {
        mean.rate += patch.rate / count;
        variance += patch.sigma * patch.sigma;
    }
    mean.sigma = std::sqrt(variance) / count;
    return mean;
}

} // namespace

double texture_error(const std::vector<PatchMean> &patches, bool whole_repeats) {
    const auto count = static_cast<double>(patches.size());
    if (patches.size() < 4)
        return 0;
    double mean = 0, noise = 0, variance = 0;
    for (const PatchMean &patch : patches) {
        mean += patch.rate / count;
        noise += patch.sigma * patch.sigma / count;
    }
    for (const PatchMean &patch : patches)
        variance += (patch.rate - mean) * (patch.rate - mean) / (count - 1);
    if (variance <= noise * (whole_repeats ? kNoiseExplains : 1))
        return 0;
    return std::sqrt(variance - noise);
}

std::vector<PatchLight> light_of(const std::vector<FramePatches> &frames, const DarkFrames &dark,
                                 const Sensor &sensor, const PatchGrid &grid,
                                 const PatchWindow &window) {
    std::vector<PatchLight> colours;
    for (std::size_t c = 0; c < frames.front().colours.size(); ++c) {
        std::vector<ExposedPixels> exposures;
        std::vector<DarkPixels> darks;
        for (const FramePatches &frame : frames) {
            exposures.push_back(frame.colours[c].pixels);
            const auto at = dark.find(exposures.back().exposure_s);
            darks.push_back(at == dark.end() ? DarkPixels{} : at->second[c]);
        }
        const std::vector<PatchMean> patches =
            patches_of(merge_exposures(exposures, darks, sensor), grid, window);
        colours.push_back({.middle = patches[patches.size() / 2],
                           .all = mean_of(patches),
                           .texture = texture_error(patches, window.whole_repeats),
                           .uneven = unevenness(patches, grid.across)});
    }
    return colours;
}

} // namespace tsuya::lab
