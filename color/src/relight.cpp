#include "tsuya/color/relight.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "channel_sums.h"
#include "group_weights.h"
#include "rows.h"
#include "tsuya/color/picture_region.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

void check(const SpectralImage &transport, std::span<const Spectrum> lamps,
           const RelightOptions &options) {
    const std::size_t groups = transport.groups.size();
    const std::string number = detail::counted(groups, "light group");
    if (lamps.size() != 1 && lamps.size() != groups)
        throw Error({detail::counted(lamps.size(), "lamp") + " for " + number, "lamps",
                     "expected one lamp, or one for each light group"});
    if (!options.group_scale.empty() && options.group_scale.size() != groups)
        throw Error({detail::counted(options.group_scale.size(), "scale") + " for " + number,
                     "group_scale", "expected none, or one for each light group"});
    for (std::size_t g = 0; g < options.group_scale.size(); ++g)
        if (!(options.group_scale[g] >= 0) || std::isinf(options.group_scale[g]))
            throw Error({"the scale is " + std::to_string(options.group_scale[g]),
                         "group_scale." + transport.groups[g], "expected 0 or more"});
    if (transport.emissive && !std::all_of(lamps.begin(), lamps.end(),
                                           [](const Spectrum &lamp) { return lamp.is_constant(); }))
        throw Error({"the picture is radiance, with the light of its lamp in it", "lamps",
                     "expected the lamp E, which leaves it as it is"});
}

/// The mean of the channels of each light group over the pixels of the garment that are finite, and
/// where there are none over all.
std::vector<double> group_levels(const SpectralImage &transport) {
    std::vector<char> counts = garment_pixels(transport);
    if (std::find(counts.begin(), counts.end(), 1) == counts.end())
        std::fill(counts.begin(), counts.end(), 1);
    const auto channels = static_cast<std::size_t>(transport.basis.count);
    std::vector<double> levels(transport.groups.size(), 0.0);
    for (std::size_t g = 0; g < levels.size(); ++g) {
        const float *t = transport.pixel(g, 0, 0);
        for (std::size_t pixel = 0; pixel < counts.size(); ++pixel, t += channels) {
            const double sum = counts[pixel] ? std::accumulate(t, t + channels, 0.0) : 0.0;
            levels[g] += std::isfinite(sum) ? std::max(sum, 0.0) : 0.0;
        }
    }
    return levels;
}

} // namespace

std::vector<std::vector<ChannelWeights>> group_weights(const SpectralImage &transport,
                                                       std::span<const Spectrum> lamps,
                                                       const RelightOptions &options,
                                                       const glm::dmat3 &matrix) {
    std::vector<std::vector<ChannelWeights>> all;
    for (std::size_t g = 0; g < transport.groups.size(); ++g) {
        const double scale = options.group_scale.empty() ? 1.0 : options.group_scale[g];
        const Spectrum &lamp = lamps[lamps.size() == 1 ? 0 : g];
        all.push_back(channel_weights(transport.depths
                                          ? lamp_matrix(lamp, *transport.depths, options.observer)
                                          : lamp_matrix(lamp, transport.basis, options.observer),
                                      matrix, scale));
    }
    return all;
}

std::vector<glm::dvec3> lamp_matrix(const Spectrum &lamp, const SpectralBasis &basis,
                                    Observer observer) {
    std::vector<glm::dvec3> matrix(static_cast<std::size_t>(basis.count), glm::dvec3(0.0));
    const BasisWeights weights(basis);
    for (const ColorWeight &weight : color_weights(lamp, observer)) {
        const std::vector<double> of_channels = weights.at_nm(weight.wavelength_nm);
        for (std::size_t k = 0; k < matrix.size(); ++k)
            matrix[k] += of_channels[k] * weight.xyz;
    }
    return matrix;
}

std::vector<glm::dvec3> lamp_matrix(const Spectrum &lamp, const DyeDepths &depths,
                                    Observer observer) {
    std::vector<double> samples_nm;
    for (const DyeVariable &dye : depths.dyes)
        samples_nm.insert(samples_nm.end(), dye.dye.wavelength_nm.begin(),
                          dye.dye.wavelength_nm.end());
    std::vector<glm::dvec3> matrix(depths.node.size(), glm::dvec3(0.0));
    const DepthWeights weights(depths);
    for (const ColorWeight &weight : color_weights(lamp, observer, samples_nm)) {
        const std::vector<double> of_channels = weights.at_nm(weight.wavelength_nm);
        for (std::size_t k = 0; k < matrix.size(); ++k)
            matrix[k] += of_channels[k] * weight.xyz;
    }
    return matrix;
}

Image relight(const SpectralImage &transport, std::span<const Spectrum> lamps,
              const RelightOptions &options) {
    check(transport, lamps, options);
    const auto weights = group_weights(transport, lamps, options);
    Image xyz = Image::make(transport.width, transport.height, {"X", "Y", "Z"});
    const auto channels = static_cast<std::size_t>(transport.basis.count);
    const std::size_t row = static_cast<std::size_t>(transport.width) * channels;
    for_rows(transport.height, row * weights.size(), [&](int first, int end) {
        for (std::size_t g = 0; g < weights.size(); ++g)
            for (int y = first; y < end; ++y)
                add_channel_sums(transport.pixel(g, 0, y), weights[g], transport.width,
                                 xyz.pixel(0, y));
    });
    return xyz;
}

void divide_by_alpha(Image &xyz, const Image &alpha) {
    const std::size_t channels = xyz.channels.size();
    for (std::size_t p = 0; p < alpha.data.size(); ++p)
        for (std::size_t c = 0; c < channels; ++c) {
            float &value = xyz.data[p * channels + c];
            value = alpha.data[p] > 0 ? value / alpha.data[p] : 0.0f;
        }
}

Image relight(const SpectralImage &transport, const Spectrum &lamp, const RelightOptions &options) {
    return relight(transport, std::span<const Spectrum>(&lamp, 1), options);
}

LitBy lit_by(const SpectralImage &transport, const Lighting &lighting, Observer observer) {
    LitBy lit{.options = {.observer = observer}};
    for (const NamedLamp &lamp : lighting.lamps) {
        lit.lamps.push_back(lamp.spectrum);
        lit.options.group_scale.push_back(lamp.factor);
    }
    if (lighting.lamps.size() == 1)
        lit.options.group_scale.assign(transport.groups.size(), lighting.lamps[0].factor);
    check(transport, lit.lamps, lit.options);
    return lit;
}

void check_lighting(const SpectralImage &transport, const Lighting &lighting) {
    lit_by(transport, lighting);
}

Lighting lighting_of(const NamedLamp &lamp) { return {lamp.name, lamp.caption, {lamp}}; }

Image relight(const SpectralImage &transport, const Lighting &lighting, Observer observer) {
    const LitBy lit = lit_by(transport, lighting, observer);
    return relight(transport, lit.lamps, lit.options);
}

glm::dvec3 adopted_white(const SpectralImage &transport, const Lighting &lighting,
                         Observer observer) {
    check_lighting(transport, lighting);
    const std::vector<NamedLamp> &lamps = lighting.lamps;
    if (std::all_of(lamps.begin(), lamps.end(),
                    [&](const NamedLamp &lamp) { return lamp.spectrum == lamps[0].spectrum; }))
        return white_of(lamps[0].spectrum, observer);
    const std::vector<double> levels = group_levels(transport);
    glm::dvec3 sum(0.0), plain(0.0);
    for (std::size_t g = 0; g < lamps.size(); ++g) {
        const glm::dvec3 white = white_of(lamps[g].spectrum, observer);
        sum += lamps[g].factor * levels[g] * white;
        plain += white;
    }
    return sum.y > 0 ? sum / sum.y : plain / plain.y; // a picture without light: all alike
}

} // namespace tsuya
