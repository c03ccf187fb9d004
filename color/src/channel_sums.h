#pragma once
/// \file
/// The sums that make colours of channels, for a row of pixels.

#include <array>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace tsuya {

/// Three colours of one channel; the fourth lane is padding so that one register holds them.
using ChannelWeights = std::array<float, 4>;

/// Weights of channels: those of a lamp_matrix, by a matrix and a factor.
std::vector<ChannelWeights> channel_weights(const std::vector<glm::dvec3> &lamp_matrix,
                                            const glm::dmat3 &matrix, double factor);

/// Adds to three colours of each pixel the sum of its channels times their weights.
/// \param transport width x weights.size() values
/// \param colors width x 3 values
void add_channel_sums(const float *transport, const std::vector<ChannelWeights> &weights, int width,
                      float *colors);

} // namespace tsuya
