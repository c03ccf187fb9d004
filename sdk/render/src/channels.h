#pragma once
// K spectral channels as a value; plain loops that the compiler vectorises.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tsuya {

inline constexpr std::size_t kMostChannels = 32;

// One value a channel, for any number of channels.
using ChannelValues = std::array<float, kMostChannels>;

// Means over the first, middle and last third of k channels.
inline std::array<float, 3> thirds(const float *values, int k) {
    std::array<float, 3> means{};
    for (int band = 0; band < 3; ++band) {
        const int from = band * k / 3, to = (band + 1) * k / 3;
        for (int i = from; i < to; ++i)
            means[static_cast<std::size_t>(band)] += values[i] / static_cast<float>(to - from);
    }
    return means;
}

template <int K> struct Channels {
    std::array<float, K> v{};

    static Channels filled(float value) {
        Channels c;
        c.v.fill(value);
        return c;
    }
    // this += a * b * s
    void add(const Channels &a, const Channels &b, float s) {
        for (std::size_t k = 0; k < K; ++k)
            v[k] += a.v[k] * b.v[k] * s;
    }
    // this += a * s
    void add(const Channels &a, float s) {
        for (std::size_t k = 0; k < K; ++k)
            v[k] += a.v[k] * s;
    }
    void add(const ChannelValues &a, float s) {
        for (std::size_t k = 0; k < K; ++k)
            v[k] += a[k] * s;
    }
    void multiply(const Channels &a) {
        for (std::size_t k = 0; k < K; ++k)
            v[k] *= a.v[k];
    }
    void scale(float s) {
        for (std::size_t k = 0; k < K; ++k)
            v[k] *= s;
    }
    float largest() const { return *std::max_element(v.begin(), v.end()); }
    float mean() const {
        float sum = 0;
        for (std::size_t k = 0; k < K; ++k)
            sum += v[k];
        return sum / K;
    }
    bool finite() const { return std::isfinite(mean()); }
};

} // namespace tsuya
