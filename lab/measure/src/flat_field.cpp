#include "flat_field.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/error.h"

namespace tsuya::lab {

FlatField::FlatField(const FramePatches &flat, const Sensor &sensor,
                     const std::filesystem::path &file)
    : area_(flat.grid.area) {
    for (const ColourPixels &colour : flat.colours) {
        ExposedPixels picture = colour.pixels;
        picture.exposure_s = 1;
        const DarkPixels no_dark;
        const PixelRates pixels = merge_exposures({&picture, 1}, {&no_dark, 1}, sensor);
        double sum = 0;
        int count = 0;
        for (std::size_t i = 0; i < pixels.rate.size(); ++i) {
            if (std::isnan(pixels.rate[i]))
                continue;
            if (pixels.clipped[i] || pixels.rate[i] <= 3 * std::sqrt(pixels.variance[i]))
                throw Error({std::string("the flat field has a pixel that is ") +
                                 (pixels.clipped[i] ? "clipped" : "dark"),
                             file.string(),
                             "expected an even surface in even light, within the camera's range"});
            sum += pixels.rate[i];
            ++count;
        }
        Colour of{.gain = pixels.rate, .sigma = pixels.variance};
        for (std::size_t i = 0; i < of.gain.size(); ++i) {
            of.gain[i] *= count / sum;
            of.sigma[i] = std::sqrt(of.sigma[i]) * count / sum;
        }
        colours_.push_back(std::move(of));
    }
}

void FlatField::apply(PixelRates &pixels, std::size_t colour, const PixelArea &area) const {
    if (colours_.empty())
        return;
    const std::vector<double> gain = part_of(colours_[colour].gain, area_, area),
                              sigma = part_of(colours_[colour].sigma, area_, area);
    for (std::size_t i = 0; i < gain.size(); ++i) {
        pixels.rate[i] /= gain[i];
        const double own = pixels.rate[i] * sigma[i] / gain[i];
        pixels.variance[i] = pixels.variance[i] / (gain[i] * gain[i]) + own * own;
    }
}

} // namespace tsuya::lab
