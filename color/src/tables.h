#pragma once
/// \file
/// The published tables that other sources of this folder read.

namespace tsuya::tables {

inline constexpr int kObserverCount = 471; ///< 360 to 830 nm, every nm
extern const double kCie1931[kObserverCount][3];
extern const double kCie1964[kObserverCount][3];

inline constexpr int kLampSamples = 81; ///< 380 to 780 nm, every 5 nm
inline constexpr int kLampFirstNm = 380;
inline constexpr int kLampStepNm = 5;
inline constexpr int kLampCount = 30;

struct LampTable {
    const char *name;
    const char *description;
    double value[kLampSamples]; ///< relative spectral power
};
extern const LampTable kLamps[kLampCount];

inline constexpr int kDaylightComponents = 3;
inline constexpr int kDaylightSamples = 95; ///< 360 to 830 nm, every 5 nm
extern const double kDaylight[kDaylightComponents][kDaylightSamples];

inline constexpr int kTestColourCount = 8;
inline constexpr int kTestColourSamples = 95; ///< 360 to 830 nm, every 5 nm
extern const double kTestColours[kTestColourCount][kTestColourSamples];

inline constexpr int kEvaluationCount = 99;
extern const float kEvaluationSamples[kEvaluationCount][kLampSamples];

} // namespace tsuya::tables
