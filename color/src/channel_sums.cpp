#include "channel_sums.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__)
#define TSUYA_EVERY_PROCESSOR                                                                      \
    __attribute__((flatten, target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define TSUYA_EVERY_PROCESSOR
#endif

namespace tsuya {
namespace {

// Four sums at a time: their additions do not wait for one another.
inline void add_pixel(const float *t, const ChannelWeights *weights, std::size_t channels,
                      float *color) {
    std::array<ChannelWeights, 4> sum{};
    std::size_t k = 0;
    for (; k + 4 <= channels; k += 4)
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t c = 0; c < 4; ++c)
                sum[j][c] += t[k + j] * weights[k + j][c];
    for (; k < channels; ++k)
        for (std::size_t c = 0; c < 4; ++c)
            sum[0][c] += t[k] * weights[k][c];
    for (std::size_t c = 0; c < 3; ++c)
        color[c] += (sum[0][c] + sum[1][c]) + (sum[2][c] + sum[3][c]);
}

TSUYA_EVERY_PROCESSOR void add_row(const float *transport, const ChannelWeights *weights,
                                   std::size_t channels, int width, float *colors) {
    for (int x = 0; x < width; ++x, transport += channels, colors += 3)
        add_pixel(transport, weights, channels, colors);
}

} // namespace

std::vector<ChannelWeights> channel_weights(const std::vector<glm::dvec3> &lamp_matrix,
                                            const glm::dmat3 &matrix, double factor) {
    std::vector<ChannelWeights> weights;
    for (const glm::dvec3 &xyz : lamp_matrix) {
        const glm::vec3 color(factor * (matrix * xyz));
        weights.push_back({color.x, color.y, color.z, 0.0f});
    }
    return weights;
}

void add_channel_sums(const float *transport, const std::vector<ChannelWeights> &weights, int width,
                      float *colors) {
    add_row(transport, weights.data(), weights.size(), width, colors);
}

} // namespace tsuya
