#include "tsuya/scene/aov_picture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

// Cloth in a tile of the places on it, metres.
constexpr float kTile = 0.1f;
constexpr double kShown = 0.98; // share of the pixels that are no brighter than white

/// Channels of an AOV as the transport of light groups.
SpectralImage as_transport(const SpectralImage &image, const Image &aov,
                           std::vector<std::string> groups) {
    SpectralImage transport =
        SpectralImage::make(image.width, image.height, image.basis, std::move(groups));
    transport.depths = image.depths;
    const auto channels = static_cast<std::size_t>(image.basis.count);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (std::size_t g = 0; g < transport.groups.size(); ++g)
                std::copy_n(aov.pixel(x, y) + g * channels, channels, transport.pixel(g, x, y));
    return transport;
}

/// A value of pixels that are above 0: the largest of most of them, 1 where there are none.
float brightest_of(const Image &aov) {
    std::vector<float> values;
    for (const float v : aov.data)
        if (v > 0)
            values.push_back(v);
    if (values.empty())
        return 1;
    const auto rank = static_cast<std::ptrdiff_t>(kShown * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

/// A bright colour for the float that stands for a name.
std::array<float, 3> colour_of_id(float id) {
    const auto bits = std::bit_cast<std::uint32_t>(id);
    const float hue = static_cast<float>(bits % 1021) / 1021;
    std::array<float, 3> colour{};
    for (std::size_t c = 0; c < 3; ++c) {
        const float turn = hue + static_cast<float>(c) / 3;
        const float wave = std::abs(2 * (turn - std::floor(turn)) - 1);
        colour[c] = 0.2f + 0.75f * wave;
    }
    return colour;
}

using Pixel = std::array<float, 3>;

template <class F> Image each_pixel(const Image &aov, F &&colour) {
    Image picture = Image::make(aov.width, aov.height, {"R", "G", "B"});
    for (int y = 0; y < aov.height; ++y)
        for (int x = 0; x < aov.width; ++x) {
            const Pixel pixel = colour(aov.pixel(x, y));
            std::transform(pixel.begin(), pixel.end(), picture.pixel(x, y),
                           [](float v) { return std::clamp(v, 0.0f, 1.0f); });
        }
    return picture;
}

Image picture_of_depth(const Image &aov) {
    const float farthest = brightest_of(aov);
    float nearest = farthest;
    for (const float v : aov.data)
        nearest = v > 0 ? std::min(nearest, v) : nearest;
    const float range = farthest > nearest ? farthest - nearest : 1;
    return each_pixel(aov, [&](const float *v) {
        const float shown = *v > 0 ? 1 - (*v - nearest) / range : 0.0f;
        return Pixel{shown, shown, shown};
    });
}

Image picture_of_ids(const Image &aov) {
    return each_pixel(aov, [&](const float *v) {
        Pixel mixed{};
        for (std::size_t r = 0; r + 1 < aov.channels.size(); r += 2)
            for (std::size_t c = 0; c < 3; ++c)
                mixed[c] += v[r + 1] * colour_of_id(v[r])[c];
        return mixed;
    });
}

Image picture_of_values(const Image &aov) {
    const float white = brightest_of(aov);
    const std::size_t count = aov.channels.size();
    return each_pixel(aov, [&](const float *v) {
        Pixel pixel{};
        for (std::size_t c = 0; c < 3; ++c)
            pixel[c] = v[std::min(c, count - 1)] / white;
        return pixel;
    });
}

} // namespace

Image aov_picture(const SpectralImage &transport, std::size_t number, const NamedLamp &lamp,
                  const DisplayOptions &look) {
    if (number >= transport.aovs.size())
        throw Error({"the picture has no AOV " + std::to_string(number), "aov",
                     "expected a number below " + std::to_string(transport.aovs.size())});
    const Image &aov = transport.aovs[number];
    const auto spectral = static_cast<std::size_t>(transport.basis.count);
    const std::vector<std::string> names =
        channel_names(transport.basis, transport.depths.has_value());
    if (aov.channels.size() == spectral * transport.groups.size() &&
        aov.channels.front() == transport.groups.front() + '.' + names.front())
        return picture_under(as_transport(transport, aov, transport.groups), {&lamp, 1}, look);
    if (aov.channels == names)
        return picture_under(as_transport(transport, aov, {"light"}), {&lamp, 1}, look);
    if (transport.aov_names[number].starts_with("Crypto"))
        return picture_of_ids(aov);
    if (aov.channels == std::vector<std::string>{"X", "Y", "Z"})
        return each_pixel(aov, [](const float *v) {
            const bool is_none = v[0] == 0 && v[1] == 0 && v[2] == 0;
            return is_none ? Pixel{}
                           : Pixel{0.5f + 0.5f * v[0], 0.5f + 0.5f * v[1], 0.5f + 0.5f * v[2]};
        });
    if (aov.channels == std::vector<std::string>{"U", "V"})
        return each_pixel(aov, [](const float *v) {
            const float u = v[0] / kTile, w = v[1] / kTile;
            return Pixel{u - std::floor(u), w - std::floor(w), 0};
        });
    return transport.aov_names[number] == "depth" ? picture_of_depth(aov) : picture_of_values(aov);
}

} // namespace tsuya::scene
