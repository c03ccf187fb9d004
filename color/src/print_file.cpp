#include "tsuya/color/print_file.h"

#include <utility>

#include "pictures.h"
#include "tsuya/color/upsample.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

std::size_t pixels(const EncodedPicture &picture) {
    return static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
}

int colours(const EncodedPicture &picture) {
    return picture.alpha >= 0 ? picture.channels - 1 : picture.channels;
}

std::uint8_t sample(const EncodedPicture &picture, std::size_t pixel, int channel) {
    return picture.data[pixel * static_cast<std::size_t>(picture.channels) +
                        static_cast<std::size_t>(channel)];
}

EncodedPicture grey_or_rgb(EncodedPicture picture, const std::filesystem::path &path) {
    if (colours(picture) != 1 && colours(picture) != 3)
        throw Error({"the picture has " + std::to_string(colours(picture)) + " colour channels",
                     path.string(), "expected grey or R, G, B, and alpha if wanted"});
    return picture;
}

Texture coverage_of(const EncodedPicture &samples) {
    Texture texture{.width = samples.width, .height = samples.height, .channels = 1};
    texture.data.reserve(pixels(samples));
    for (std::size_t p = 0; p < pixels(samples); ++p) {
        if (samples.alpha >= 0) {
            texture.data.push_back(sample(samples, p, samples.alpha));
            continue;
        }
        int sum = 0;
        for (int c = 0; c < samples.channels; ++c)
            sum += sample(samples, p, c);
        texture.data.push_back(
            static_cast<std::uint8_t>((sum + samples.channels / 2) / samples.channels));
    }
    return texture;
}

} // namespace

Texture read_artwork(const std::filesystem::path &path) {
    EncodedPicture samples =
        grey_or_rgb(picture_reader().read_encoded(path, FloatCode::srgb), path);
    const bool grey = colours(samples) == 1;
    Texture texture{
        .width = samples.width, .height = samples.height, .channels = samples.alpha >= 0 ? 4 : 3};
    if (!grey && (samples.alpha < 0 || samples.alpha == 3)) {
        texture.data = std::move(samples.data);
        return texture;
    }
    for (std::size_t p = 0; p < pixels(samples); ++p) {
        int colour = 0;
        for (int c = 0; c < 3; ++c, colour += grey ? 0 : 1) {
            if (colour == samples.alpha)
                ++colour;
            texture.data.push_back(sample(samples, p, colour));
        }
        if (samples.alpha >= 0)
            texture.data.push_back(sample(samples, p, samples.alpha));
    }
    return texture;
}

Texture read_coverage(const std::filesystem::path &path) {
    return coverage_of(grey_or_rgb(picture_reader().read_encoded(path, FloatCode::linear), path));
}

Texture decode_coverage(std::string_view bytes, const std::string &name) {
    return coverage_of(grey_or_rgb(picture_reader().decode_png(bytes, name), name));
}

std::vector<Spectrum> rgb_inks() {
    std::vector<Spectrum> inks;
    for (int corner = 0; corner < 8; ++corner)
        inks.push_back(
            reflectance_of_srgb({corner & 1, corner >> 1 & 1, corner >> 2 & 1}, "corner of RGB"));
    return inks;
}

} // namespace tsuya
