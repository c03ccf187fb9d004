#pragma once
/// \file
/// From the light of one colour to reflectance.

#include "session_light.h"
#include "white_standard.h"

namespace tsuya::lab {

/// Values of one colour, and why views of it have none.
struct ChannelEstimate {
    ChannelMeasurement channel{};
    std::vector<LeftOutView> left_out{};
    std::vector<std::string> warnings{}; ///< about the white standard
};

/// [Takeda] Eq. 2 for each view of the cloth. Throws Error where a direction of light has stray
/// light as large as the white standard's, and as WhiteStandard.
ChannelEstimate estimate_channel(const SessionLight &light, std::size_t colour,
                                 const Session &session, const MeasureSettings &settings);

} // namespace tsuya::lab
