#include "tsuya/sdk/image.h"

#include <algorithm>
#include <cstdio>

#include "tsuya/sdk/spectral_image.h"

namespace tsuya {
namespace {

// [Fichet] dots separate layers, so the decimal sign is a comma
std::string wavelength_text(double wavelength_nm) {
    char number[32];
    std::snprintf(number, sizeof number, "%.3f", wavelength_nm);
    std::string text = number;
    std::replace(text.begin(), text.end(), '.', ',');
    return text + "nm";
}

} // namespace

Image Image::make(int width, int height, std::vector<std::string> channels) {
    const std::size_t size =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels.size();
    return {width, height, std::move(channels), std::vector<float>(size)};
}

SpectralImage SpectralImage::make(int width, int height, SpectralBasis basis,
                                  std::vector<std::string> groups) {
    SpectralImage image{
        .width = width, .height = height, .basis = basis, .groups = std::move(groups)};
    image.transport.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                           static_cast<std::size_t>(basis.count) * image.groups.size());
    return image;
}

std::vector<std::string> channel_names(const SpectralBasis &basis, bool at_depths, bool emissive) {
    std::vector<std::string> names;
    for (int k = 0; k < basis.count; ++k)
        names.push_back((emissive ? "S0." : "T.") +
                        (at_depths ? std::string("depth.") + (k < 10 ? "0" : "") + std::to_string(k)
                                   : wavelength_text(basis.centre_nm(k))));
    return names;
}

} // namespace tsuya
