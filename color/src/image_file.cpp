#include "tsuya/color/image_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "channels.h"
#include "pictures.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

template <class Sample> std::vector<Sample> quantize(const Image &image) {
    constexpr float kMost = sizeof(Sample) == 1 ? 255.0f : 65535.0f;
    std::vector<Sample> samples(image.data.size());
    std::transform(image.data.begin(), image.data.end(), samples.begin(), [](float v) {
        return static_cast<Sample>(std::lround(std::clamp(v, 0.0f, 1.0f) * kMost));
    });
    return samples;
}

void check_display_image(const Image &image, const std::string &where) {
    check_image(image, where);
    const std::size_t channels = image.channels.size();
    if (channels != 1 && channels != 3 && channels != 4)
        throw Error({"the picture has " + detail::counted(channels, "channel"), where,
                     "expected 1 (grey), 3 (RGB) or 4 (RGBA) for a PNG"});
    const auto nan =
        std::find_if(image.data.begin(), image.data.end(), [](float v) { return std::isnan(v); });
    if (nan == image.data.end())
        return;
    const auto pixel = static_cast<std::size_t>(nan - image.data.begin()) / channels;
    const auto width = static_cast<std::size_t>(image.width);
    throw Error({"the pixel at column " + std::to_string(pixel % width) + ", row " +
                     std::to_string(pixel / width) + " is not a number",
                 where, "expected finite values"});
}

} // namespace

void check_pictures() { picture_writer(); }

void write_png(const std::filesystem::path &path, const Image &image, int bits) {
    check_display_image(image, path.string());
    if (bits == 8)
        picture_writer().write_png(path, image, bits, quantize<std::uint8_t>(image).data());
    else if (bits == 16)
        picture_writer().write_png(path, image, bits, quantize<std::uint16_t>(image).data());
    else
        throw Error({"a PNG has no samples of " + std::to_string(bits) + " bits", path.string(),
                     "expected 8 or 16"});
}

Image read_image(const std::filesystem::path &path) { return picture_reader().read(path).image; }

void write_exr(const std::filesystem::path &path, const Image &image, const ExrOptions &options) {
    check_image(image, path.string());
    OutputPicture picture{.width = image.width,
                          .height = image.height,
                          .channels = image.channels,
                          .samples = options.samples};
    for (const auto &[key, value] : options.metadata)
        picture.attributes["tsuya:meta:" + key] = value;
    const std::size_t row = static_cast<std::size_t>(image.width) * image.channels.size();
    picture.fill_row = [&](int y, float *out) { std::copy_n(image.pixel(0, y), row, out); };
    picture_writer().write_exr(path, picture);
}

} // namespace tsuya
