#pragma once
/// \file
/// What a lighting makes of the channels of each light group.

#include <span>
#include <vector>

#include <glm/mat3x3.hpp>

#include "channel_sums.h"
#include "tsuya/color/relight.h"

namespace tsuya {

/// A lighting as `relight` takes it: lamps, and options with the power of each light group.
struct LitBy {
    std::vector<Spectrum> lamps{};
    RelightOptions options{};
};

/// Throws Error as relight where the lighting does not fit the transport.
LitBy lit_by(const SpectralImage &transport, const Lighting &lighting,
             Observer observer = Observer::cie1931);

/// The weights of each light group, for X, Y, Z times a matrix. The lamps and options must fit.
std::vector<std::vector<ChannelWeights>> group_weights(const SpectralImage &transport,
                                                       std::span<const Spectrum> lamps,
                                                       const RelightOptions &options,
                                                       const glm::dmat3 &matrix = glm::dmat3(1.0));

} // namespace tsuya
