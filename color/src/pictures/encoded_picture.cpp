#include <algorithm>
#include <cmath>

#include <OpenImageIO/imageio.h>

#include "pictures/oiio_input.h"
#include "pictures/reader_parts.h"
#include "tsuya/sdk/detail/srgb_curve.h"
#include "tsuya/sdk/error.h"

namespace tsuya {

namespace {

[[noreturn]] void refuse_nan(const std::filesystem::path &path, std::size_t pixel,
                             std::size_t width) {
    throw Error({"the pixel at column " + std::to_string(pixel % width) + ", row " +
                     std::to_string(pixel / width) + " is not a number",
                 path.string(), "expected values from 0 to 1"});
}

OIIO::ImageSpec plain_alpha() {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    return config;
}

EncodedPicture read_samples(OIIO::ImageInput &in, const std::filesystem::path &path,
                            FloatCode floats) {
    const OIIO::ImageSpec &spec = in.spec();
    EncodedPicture picture{.width = spec.width,
                           .height = spec.height,
                           .channels = spec.nchannels,
                           .alpha = spec.alpha_channel};
    const bool has_floats = spec.format.is_floating_point();
    need_memory_for(path, spec, spec.height, 1 + (has_floats ? sizeof(float) : 0));
    const std::size_t count = static_cast<std::size_t>(spec.width) *
                              static_cast<std::size_t>(spec.height) *
                              static_cast<std::size_t>(spec.nchannels);
    picture.data.resize(count);
    if (!has_floats) {
        if (!in.read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, picture.data.data()))
            fail_reading(path, in.geterror());
        return picture;
    }
    std::vector<float> linear(count);
    if (!in.read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, linear.data()))
        fail_reading(path, in.geterror());
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    for (std::size_t i = 0; i < count; ++i) {
        if (std::isnan(linear[i]))
            refuse_nan(path, i / channels, static_cast<std::size_t>(spec.width));
        const bool is_alpha = static_cast<int>(i % channels) == spec.alpha_channel;
        const double v = std::clamp(static_cast<double>(linear[i]), 0.0, 1.0);
        const double code = is_alpha || floats == FloatCode::linear ? v : detail::srgb_code(v);
        picture.data[i] = static_cast<std::uint8_t>(std::lround(255 * code));
    }
    return picture;
}

} // namespace

EncodedPicture read_encoded_picture(const std::filesystem::path &path, FloatCode floats) {
    const OIIO::ImageSpec config = plain_alpha();
    return read_samples(*open_picture(path, &config), path, floats);
}

EncodedPicture decode_png_bytes(std::string_view bytes, const std::string &name) {
    OIIO::Filesystem::IOMemReader proxy(bytes.data(), bytes.size());
    return read_samples(*open_png(proxy, name, plain_alpha()), name, FloatCode::linear);
}

} // namespace tsuya
