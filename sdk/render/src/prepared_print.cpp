#include "prepared_print.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tsuya {
namespace {

// Shares of the eight corners of the cube of colours, trilinear.
std::array<float, 8> corner_shares(const glm::vec3 &colour) {
    std::array<float, 8> shares{};
    for (std::size_t corner = 0; corner < 8; ++corner) {
        shares[corner] = 1;
        for (int c = 0; c < 3; ++c)
            shares[corner] *= (corner >> c) & 1u ? colour[c] : 1 - colour[c];
    }
    return shares;
}

} // namespace

PreparedPrint::PreparedPrint(const Print &print, const std::vector<MipTexture> &textures,
                             const SpectralBasis &basis)
    : place_(print.placement, textures[print.layers.front().picture.value].width_over_height()),
      repeat_(print.placement.repeat), channels_(basis.count) {
    for (const PrintLayer &layer : print.layers) {
        PreparedLayer &made =
            layers_.emplace_back(PreparedLayer{&textures[layer.picture.value], {}});
        for (const Spectrum &ink : layer.inks) {
            const std::vector<float> projected = project(ink, basis);
            ChannelValues &values = made.inks.emplace_back();
            // Least squares may leave the range where a spectrum has a steep edge
            std::transform(projected.begin(), projected.end(), values.begin(),
                           [](float v) { return std::min(v, 1.0f); });
        }
    }
}

void PreparedPrint::dye(glm::vec2 uv, float footprint, ChannelValues &weft,
                        ChannelValues &warp) const {
    const glm::vec2 place = place_.at(uv);
    for (const PreparedLayer &layer : layers_) {
        const glm::vec4 pixel =
            layer.picture->at(place, footprint * place_.widths_per_metre(), repeat_);
        if (!(pixel.w > 0))
            continue;
        const ChannelValues of_layer = ink(layer, pixel);
        cover(pixel.w, of_layer, weft);
        cover(pixel.w, of_layer, warp);
    }
}

void PreparedPrint::mean_dye(ChannelValues &dye) const {
    for (const PreparedLayer &layer : layers_) {
        const glm::vec4 mean = layer.picture->mean();
        cover(mean.w, ink(layer, mean), dye);
    }
}

ChannelValues PreparedPrint::ink(const PreparedLayer &layer, const glm::vec4 &pixel) const {
    if (layer.inks.size() == 1)
        return layer.inks.front();
    ChannelValues mixed{};
    const std::array<float, 8> shares = corner_shares(glm::vec3(pixel));
    for (std::size_t corner = 0; corner < 8; ++corner)
        for (std::size_t k = 0; k < static_cast<std::size_t>(channels_); ++k)
            mixed[k] += shares[corner] * layer.inks[corner][k];
    return mixed;
}

void PreparedPrint::cover(float share, const ChannelValues &ink, ChannelValues &dye) const {
    for (std::size_t k = 0; k < static_cast<std::size_t>(channels_); ++k)
        dye[k] += share * (ink[k] - dye[k]);
}

} // namespace tsuya
