#include "tsuya/color/print_file.h"

#include <algorithm>
#include <cmath>

#include <OpenImageIO/imageio.h>

#include "oiio_input.h"
#include "tsuya/color/srgb.h"
#include "tsuya/color/upsample.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

// A picture of 8 bits a sample as the file has it, but for floats, which are encoded.
struct Samples {
    int width = 0, height = 0, channels = 0;
    int alpha = -1; // its channel; -1: none
    std::vector<std::uint8_t> data{};

    std::uint8_t at(std::size_t pixel, int channel) const {
        return data[pixel * static_cast<std::size_t>(channels) + static_cast<std::size_t>(channel)];
    }
    std::size_t pixels() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    int colours() const { return alpha >= 0 ? channels - 1 : channels; }
};

bool is_float(const OIIO::TypeDesc &type) {
    return type.basetype == OIIO::TypeDesc::HALF || type.basetype == OIIO::TypeDesc::FLOAT ||
           type.basetype == OIIO::TypeDesc::DOUBLE;
}

Samples read_samples(const std::filesystem::path &path) {
    // Pictures with alpha are not to be multiplied with it: what is covered little keeps its colour
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const auto in = open_picture(path, &config);
    const OIIO::ImageSpec &spec = in->spec();
    Samples samples{.width = spec.width,
                    .height = spec.height,
                    .channels = spec.nchannels,
                    .alpha = spec.alpha_channel};
    if (samples.colours() != 1 && samples.colours() != 3)
        throw Error({"the picture has " + std::to_string(samples.colours()) + " colour channels",
                     path.string(), "expected grey or R, G, B, and alpha if wanted"});
    const std::size_t count = samples.pixels() * static_cast<std::size_t>(samples.channels);
    samples.data.resize(count);
    if (!is_float(spec.format)) {
        if (!in->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, samples.data.data()))
            fail_reading(path, in->geterror());
        return samples;
    }
    std::vector<float> linear(count);
    if (!in->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, linear.data()))
        fail_reading(path, in->geterror());
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_alpha =
            static_cast<int>(i % static_cast<std::size_t>(samples.channels)) == samples.alpha;
        const double v = std::clamp(static_cast<double>(linear[i]), 0.0, 1.0);
        samples.data[i] =
            static_cast<std::uint8_t>(std::lround(255 * (is_alpha ? v : srgb_encode(v))));
    }
    return samples;
}

} // namespace

Texture read_artwork(const std::filesystem::path &path) {
    Samples samples = read_samples(path);
    const bool grey = samples.colours() == 1;
    Texture texture{
        .width = samples.width, .height = samples.height, .channels = samples.alpha >= 0 ? 4 : 3};
    if (!grey && (samples.alpha < 0 || samples.alpha == 3)) {
        texture.data = std::move(samples.data);
        return texture;
    }
    for (std::size_t p = 0; p < samples.pixels(); ++p) {
        int colour = 0;
        for (int c = 0; c < 3; ++c, colour += grey ? 0 : 1) {
            if (colour == samples.alpha)
                ++colour;
            texture.data.push_back(samples.at(p, colour));
        }
        if (samples.alpha >= 0)
            texture.data.push_back(samples.at(p, samples.alpha));
    }
    return texture;
}

Texture read_coverage(const std::filesystem::path &path) {
    const Samples samples = read_samples(path);
    Texture texture{.width = samples.width, .height = samples.height, .channels = 1};
    texture.data.reserve(samples.pixels());
    for (std::size_t p = 0; p < samples.pixels(); ++p) {
        if (samples.alpha >= 0) {
            texture.data.push_back(samples.at(p, samples.alpha));
            continue;
        }
        int sum = 0;
        for (int c = 0; c < samples.channels; ++c)
            sum += samples.at(p, c);
        texture.data.push_back(
            static_cast<std::uint8_t>((sum + samples.channels / 2) / samples.channels));
    }
    return texture;
}

std::vector<Spectrum> rgb_inks() {
    std::vector<Spectrum> inks;
    for (int corner = 0; corner < 8; ++corner)
        inks.push_back(
            reflectance_of_srgb({corner & 1, corner >> 1 & 1, corner >> 2 & 1}, "corner of RGB"));
    return inks;
}

} // namespace tsuya
