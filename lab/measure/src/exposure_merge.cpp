#include "tsuya/lab/exposure_merge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1.0 / 12; // variance of a whole number, DN^2

void need_size(std::size_t size, std::size_t expected, const char *where) {
    if (size != expected)
        throw Error({"a frame has " + detail::counted(size, "pixel"), where,
                     "expected " + std::to_string(expected) + ", as in the first"});
}

/// Variance of a pixel that gave `dn` above black, DN^2.
double noise_of(double dn_above_black, const Sensor &sensor) {
    const double electrons = std::max(dn_above_black * sensor.e_per_dn, 0.0);
    return (electrons + sensor.read_noise_e * sensor.read_noise_e) /
               (sensor.e_per_dn * sensor.e_per_dn) +
           kRounding;
}

/// Sums of the exposures of one pixel that can be used.
struct PixelSums {
    double dn = 0, time_s = 0, variance = 0;

    void add(double value, double exposure_s, double dark, int dark_frames, const Sensor &sensor) {
        dn += value - dark;
        time_s += exposure_s;
        variance += noise_of(value - sensor.black, sensor);
        if (dark_frames > 0)
            variance += noise_of(dark - sensor.black, sensor) / dark_frames;
    }
};

/// Squared steps from pixel to pixel, without what noise makes of them.
struct NeighbourSteps {
    double sum = 0, noise = 0;
    int count = 0;

    void add(const PixelRates &pixels, std::size_t i, std::size_t j) {
        const double step = pixels.rate[j] - pixels.rate[i];
        const double variance = pixels.variance[i] + pixels.variance[j];
        sum += step * step - variance;
        noise += variance;
        ++count;
    }
    void put_into(PatchMean &mean) const {
        if (count == 0 || mean.rate <= 0)
            return;
        const double scale = 1 / (count * mean.rate * mean.rate);
        mean.sharpness = sum * scale;
        // Steps of one row share pixels: 3 / count, where independent ones would have 2.
        mean.sharpness_sigma = noise * scale * std::sqrt(3.0 / count);
    }
};

} // namespace

DarkPixels mean_of_dark(std::span<const ExposedPixels> frames) {
    if (frames.empty())
        throw Error({"there is no dark frame", "dark", "expected one or more"});
    DarkPixels dark{.exposure_s = frames[0].exposure_s,
                    .frames = static_cast<int>(frames.size()),
                    .dn = std::vector<double>(frames[0].dn.size())};
    for (const ExposedPixels &frame : frames) {
        need_size(frame.dn.size(), dark.dn.size(), "dark");
        for (std::size_t i = 0; i < dark.dn.size(); ++i)
            dark.dn[i] += frame.dn[i] / dark.frames;
    }
    return dark;
}

PixelRates merge_exposures(std::span<const ExposedPixels> exposures,
                           std::span<const DarkPixels> dark, const Sensor &sensor) {
    if (exposures.empty() || dark.size() != exposures.size())
        throw Error({detail::counted(exposures.size(), "exposure") + " and " +
                         detail::counted(dark.size(), "dark one"),
                     "exposures", "expected one or more, and as many dark ones"});
    const std::size_t size = exposures[0].dn.size();
    for (std::size_t k = 0; k < exposures.size(); ++k) {
        need_size(exposures[k].dn.size(), size, "exposures");
        if (dark[k].frames > 0)
            need_size(dark[k].dn.size(), size, "dark");
    }
    const auto shortest = static_cast<std::size_t>(
        std::min_element(exposures.begin(), exposures.end(),
                         [](const auto &a, const auto &b) { return a.exposure_s < b.exposure_s; }) -
        exposures.begin());
    PixelRates pixels{.rate = std::vector<double>(size, kNoValue),
                      .variance = std::vector<double>(size, kNoValue),
                      .clipped = std::vector<bool>(size)};
    for (std::size_t i = 0; i < size; ++i) {
        PixelSums sums;
        const auto add = [&](std::size_t k) {
            sums.add(exposures[k].dn[i], exposures[k].exposure_s,
                     dark[k].frames > 0 ? dark[k].dn[i] : sensor.black, dark[k].frames, sensor);
        };
        for (std::size_t k = 0; k < exposures.size(); ++k)
            if (exposures[k].dn[i] <= kUsableShare * sensor.saturation)
                add(k);
        if (sums.time_s == 0 && !std::isnan(exposures[shortest].dn[i])) {
            pixels.clipped[i] = true;
            add(shortest);
        }
        if (sums.time_s > 0) {
            pixels.rate[i] = sums.dn / sums.time_s;
            pixels.variance[i] = sums.variance / (sums.time_s * sums.time_s);
        }
    }
    return pixels;
}

PatchMean mean_of_patch(const PixelRates &pixels, int width, int x, int y, int side,
                        std::span<const double> weights) {
    PatchMean mean;
    NeighbourSteps steps;
    double total = 0, variance = 0;
    for (int row = 0; row < side; ++row) {
        std::optional<std::size_t> last; // of the same colour in this row
        for (int column = 0; column < side; ++column) {
            const auto i = static_cast<std::size_t>((y + row) * width + x + column);
            if (std::isnan(pixels.rate[i]))
                continue;
            const double weight = weights[static_cast<std::size_t>(row * side + column)];
            total += weight;
            mean.rate += weight * pixels.rate[i];
            variance += weight * weight * pixels.variance[i];
            mean.clipped += weight > 0 && pixels.clipped[i] ? 1 : 0;
            if (last)
                steps.add(pixels, *last, i);
            last = i;
        }
    }
    if (total <= 0)
        throw Error({"no pixel of the patch counts", "patch", "expected a pixel with a weight"});
    mean.rate /= total;
    mean.sigma = std::sqrt(variance) / total;
    steps.put_into(mean);
    return mean;
}

} // namespace tsuya::lab
