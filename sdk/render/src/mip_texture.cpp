#include "mip_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tsuya/sdk/detail/srgb_curve.h"

namespace tsuya {
namespace {

std::uint8_t encoded(float linear) {
    const double code = detail::srgb_code(static_cast<double>(linear));
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(code, 0.0, 1.0)));
}

const std::array<float, 256> &decoding() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i)
            t[i] = static_cast<float>(detail::srgb_light(static_cast<double>(i) / 255));
        return t;
    }();
    return table;
}

// The pixel that lies at an index of the endless row.
int wrapped(int i, int size, Repeat repeat) {
    if (repeat == Repeat::once)
        return std::clamp(i, 0, size - 1);
    const int period = repeat == Repeat::mirror ? 2 * size : size;
    const int in_period = ((i % period) + period) % period;
    return in_period < size ? in_period : period - 1 - in_period;
}

} // namespace

MipTexture::MipTexture(const Texture &texture) : channels_(texture.channels) {
    levels_.push_back({texture.width, texture.height, texture.data});
    while (levels_.back().width > 1 || levels_.back().height > 1) {
        const Level &last = levels_.back();
        const int width = std::max(last.width / 2, 1), height = std::max(last.height / 2, 1);
        smaller_.push_back(halved(last, width, height));
        levels_.push_back({width, height, smaller_.back()});
    }
}

glm::vec4 MipTexture::pixel(const Level &level, int x, int y) const {
    const auto at = [&](int channel) {
        return level.data[(static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) +
                           static_cast<std::size_t>(x)) *
                              static_cast<std::size_t>(channels_) +
                          static_cast<std::size_t>(channel)];
    };
    const auto cover = [&](int channel) { return static_cast<float>(at(channel)) / 255; };
    if (channels_ == 1)
        return {0, 0, 0, cover(0)};
    const auto &linear = decoding();
    return {linear[at(0)], linear[at(1)], linear[at(2)], channels_ == 4 ? cover(3) : 1.0f};
}

// Each pixel is the mean of what it covers, in linear light; colours by their coverage.
std::vector<std::uint8_t> MipTexture::halved(const Level &from, int width, int height) const {
    std::vector<std::uint8_t> made;
    made.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                 static_cast<std::size_t>(channels_));
    const float step_x = static_cast<float>(from.width) / static_cast<float>(width);
    const float step_y = static_cast<float>(from.height) / static_cast<float>(height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float left = static_cast<float>(x) * step_x, right = left + step_x;
            const float top = static_cast<float>(y) * step_y, bottom = top + step_y;
            glm::vec3 colour(0);
            float coverage = 0, area = 0;
            for (int j = static_cast<int>(top); static_cast<float>(j) < bottom && j < from.height;
                 ++j)
                for (int i = static_cast<int>(left);
                     static_cast<float>(i) < right && i < from.width; ++i) {
                    const float share = (std::min(right, static_cast<float>(i + 1)) -
                                         std::max(left, static_cast<float>(i))) *
                                        (std::min(bottom, static_cast<float>(j + 1)) -
                                         std::max(top, static_cast<float>(j)));
                    const glm::vec4 p = pixel(from, i, j);
                    colour += share * p.w * glm::vec3(p);
                    coverage += share * p.w;
                    area += share;
                }
            if (channels_ > 1) {
                if (coverage > 0)
                    colour /= coverage;
                for (int c = 0; c < 3; ++c)
                    made.push_back(encoded(colour[c]));
            }
            if (channels_ != 3)
                made.push_back(static_cast<std::uint8_t>(std::lround(255 * coverage / area)));
        }
    return made;
}

glm::vec4 MipTexture::interpolated(const Level &level, glm::vec2 place, Repeat repeat) const {
    const float x = place.x * static_cast<float>(level.width) - 0.5f;
    const float y = (1 - place.y) * static_cast<float>(level.height) - 0.5f;
    const float left = std::floor(x), top = std::floor(y);
    const float across = x - left, down = y - top;
    glm::vec4 sum(0); // of colours times their coverage
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const float share = (i == 0 ? 1 - across : across) * (j == 0 ? 1 - down : down);
            const glm::vec4 p =
                pixel(level, wrapped(static_cast<int>(left) + i, level.width, repeat),
                      wrapped(static_cast<int>(top) + j, level.height, repeat));
            sum += share * glm::vec4(p.w * glm::vec3(p), p.w);
        }
    if (sum.w > 0)
        for (int c = 0; c < 3; ++c)
            sum[c] /= sum.w;
    return sum;
}

glm::vec4 MipTexture::at(glm::vec2 place, float footprint, Repeat repeat) const {
    if (repeat == Repeat::once && (place.x < 0 || place.x > 1 || place.y < 0 || place.y > 1))
        return glm::vec4(0);
    // Far from the origin pixels would be lost in rounding
    const float period = repeat == Repeat::mirror ? 2.0f : 1.0f;
    if (repeat != Repeat::once)
        place -= period * glm::floor(place / period);
    const float level =
        std::clamp(std::log2(std::max(footprint * static_cast<float>(levels_.front().width), 1.0f)),
                   0.0f, static_cast<float>(levels_.size() - 1));
    const auto finer = static_cast<std::size_t>(level);
    const glm::vec4 a = interpolated(levels_[finer], place, repeat);
    const float rest = level - static_cast<float>(finer);
    if (!(rest > 0))
        return a;
    const glm::vec4 b = interpolated(levels_[finer + 1], place, repeat);
    const float coverage = (1 - rest) * a.w + rest * b.w;
    if (!(coverage > 0))
        return glm::vec4(0);
    const glm::vec3 colour =
        ((1 - rest) * a.w * glm::vec3(a) + rest * b.w * glm::vec3(b)) / coverage;
    return {colour, coverage};
}

} // namespace tsuya
