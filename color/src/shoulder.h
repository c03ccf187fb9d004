#pragma once
/// \file
/// The shoulder of the view Soft, in stops above mid grey: straight to a knee, then an exponential
/// that nears white but never reaches it.

#include <cmath>

namespace tsuya {

inline constexpr double kMidGrey = 0.18, kKnee = 0.5;

inline double knee_stops() { return std::log2(kKnee / kMidGrey); }

/// From the knee to white.
inline double shoulder_room() { return std::log2(1 / kKnee); }

inline double shoulder_stops(double stops) {
    const double above = stops - knee_stops(), room = shoulder_room();
    return above <= 0 ? stops : knee_stops() + room * (1 - std::exp(-above / room));
}

inline double shoulder_slope(double stops) {
    const double above = stops - knee_stops();
    return above <= 0 ? 1 : std::exp(-above / shoulder_room());
}

} // namespace tsuya
