#pragma once
/// \file
/// The published tables that `observer.cpp` and `lamp.cpp` read.

namespace tsuya::tables {

inline constexpr int kObserverCount = 471; ///< 360 to 830 nm, every nm
extern const double kCie1931[kObserverCount][3];
extern const double kCie1964[kObserverCount][3];

inline constexpr int kLampSamples = 81; ///< 380 to 780 nm, every 5 nm
inline constexpr int kLampFirstNm = 380;
inline constexpr int kLampStepNm = 5;
inline constexpr int kLampCount = 12;

struct LampTable {
    const char *name;
    const char *description;
    double value[kLampSamples]; ///< relative spectral power
};
extern const LampTable kLamps[kLampCount];

} // namespace tsuya::tables
