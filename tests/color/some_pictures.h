#pragma once
// Pictures for tests of files.

#include <cstring>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tsuya/sdk/image.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya::test {

inline Image ramp(int width, int height, std::vector<std::string> channels) {
    Image image = Image::make(width, height, std::move(channels));
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = static_cast<float>(i % 256) / 255.0f;
    return image;
}

inline SpectralImage some_transport() {
    SpectralImage image = SpectralImage::make(37, 29, {.count = 16}, {"key", "a fill.left"});
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1.0f, 40.0f);
    for (float &t : image.transport)
        t = uniform(random);
    image.aov_names = {"coverage", "normal"};
    image.aovs = {ramp(37, 29, {"Y"}), ramp(37, 29, {"z", "x", "R"})};
    image.metadata = {{"samples_per_pixel", "64"}, {"note", "K = 16; \"quoted\""}};
    return image;
}

inline bool same_bits(const std::vector<float> &a, const std::vector<float> &b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

} // namespace tsuya::test
