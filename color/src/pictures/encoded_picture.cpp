#include <algorithm>
#include <cmath>

#include <OpenImageIO/imageio.h>

#include "pictures/oiio_input.h"
#include "pictures/picture_files.h"
#include "tsuya/sdk/detail/srgb_curve.h"

namespace tsuya {

EncodedPicture read_encoded_picture(const std::filesystem::path &path) {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const auto in = open_picture(path, &config);
    const OIIO::ImageSpec &spec = in->spec();
    EncodedPicture picture{.width = spec.width,
                           .height = spec.height,
                           .channels = spec.nchannels,
                           .alpha = spec.alpha_channel};
    const bool floats = spec.format.is_floating_point();
    need_memory_for(path, spec, spec.height, 1 + (floats ? sizeof(float) : 0));
    const std::size_t count = static_cast<std::size_t>(spec.width) *
                              static_cast<std::size_t>(spec.height) *
                              static_cast<std::size_t>(spec.nchannels);
    picture.data.resize(count);
    if (!floats) {
        if (!in->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, picture.data.data()))
            fail_reading(path, in->geterror());
        return picture;
    }
    std::vector<float> linear(count);
    if (!in->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, linear.data()))
        fail_reading(path, in->geterror());
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_alpha =
            static_cast<int>(i % static_cast<std::size_t>(spec.nchannels)) == spec.alpha_channel;
        const double v = std::clamp(static_cast<double>(linear[i]), 0.0, 1.0);
        picture.data[i] =
            static_cast<std::uint8_t>(std::lround(255 * (is_alpha ? v : detail::srgb_code(v))));
    }
    return picture;
}

} // namespace tsuya
