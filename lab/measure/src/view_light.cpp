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

/// One colour of a view.
class ColourLight {
  public:
    ColourLight(const std::vector<FramePatches> &frames, std::size_t colour,
                const LightSettings &settings)
        : grid_(frames.front().grid), colour_(colour), settings_(settings) {
        for (const FramePatches &frame : frames) {
            exposures_.push_back(frame.colours[colour].pixels);
            const auto at = settings.dark.find(frame.planned_s);
            if (at == settings.dark.end()) {
                darks_.emplace_back();
                continue;
            }
            darks_.push_back(at->second.colours[colour]);
            darks_.back().dn = part_of(darks_.back().dn, at->second.area, grid_.area);
        }
    }

    PatchLight light(const std::vector<LampShare> &shares) {
        for (std::size_t k = 0; k < exposures_.size(); ++k)
            exposures_[k].exposure_s *= shares[k].value;
        const std::vector<PatchMean> patches = patches_now();
        double lamp = 0;
        for (std::size_t k = 0; k < exposures_.size(); ++k)
            if (shares[k].sigma > 0) { // what one standard error of this exposure's light does
                const double exposure_s = exposures_[k].exposure_s;
                exposures_[k].exposure_s *= 1 + shares[k].sigma / shares[k].value;
                lamp = std::hypot(lamp, middle_of(patches_now()).rate - middle_of(patches).rate);
                exposures_[k].exposure_s = exposure_s;
            }
        return {.middle = middle_of(patches),
                .all = mean_of(patches),
                .texture = texture_error(patches, settings_.window.whole_repeats),
                .lamp = lamp,
                .uneven = unevenness(patches, grid_.across)};
    }

  private:
    static const PatchMean &middle_of(const std::vector<PatchMean> &patches) {
        return patches[patches.size() / 2];
    }
    std::vector<PatchMean> patches_now() const {
        PixelRates pixels = merge_exposures(exposures_, darks_, settings_.sensor);
        settings_.flat.apply(pixels, colour_, grid_.area);
        return patches_of(pixels, grid_, settings_.window);
    }

    PatchGrid grid_;
    std::size_t colour_;
    const LightSettings &settings_;
    std::vector<ExposedPixels> exposures_{};
    std::vector<DarkPixels> darks_{};
};

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

std::vector<PatchLight> light_of(const std::vector<FramePatches> &frames,
                                 const std::vector<std::vector<LampShare>> &shares,
                                 const LightSettings &settings) {
    std::vector<PatchLight> colours;
    for (std::size_t c = 0; c < frames.front().colours.size(); ++c)
        colours.push_back(ColourLight(frames, c, settings).light(shares[c]));
    return colours;
}

} // namespace tsuya::lab
