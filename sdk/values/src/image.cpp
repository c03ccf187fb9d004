#include "tsuya/sdk/image.h"

#include "tsuya/sdk/spectral_image.h"

namespace tsuya {

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

} // namespace tsuya
