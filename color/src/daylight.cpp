#include "daylight.h"

#include "tables.h"

namespace tsuya {

Spectrum daylight(double kelvin) {
    // [CIE015] Eq. 4.4 to 4.8: chromaticity, then the weights of the components.
    const double t = 1000 / kelvin;
    const double x = kelvin <= 7000 ? 0.244063 + t * (0.09911 + t * (2.9678 - t * 4.6070))
                                    : 0.237040 + t * (0.24748 + t * (1.9018 - t * 2.0064));
    const double y = -3.000 * x * x + 2.870 * x - 0.275;
    const double scale = 1 / (0.0241 + 0.2562 * x - 0.7341 * y);
    const double m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) * scale;
    const double m2 = (0.0300 - 31.4424 * x + 30.0717 * y) * scale;
    constexpr int kFirstNm = 360, kStepNm = 5;
    Spectrum s{{}, {}};
    for (int i = 0; i < tables::kDaylightSamples; ++i) {
        s.wavelength_nm.push_back(kFirstNm + kStepNm * i);
        s.value.push_back(tables::kDaylight[0][i] + m1 * tables::kDaylight[1][i] +
                          m2 * tables::kDaylight[2][i]);
    }
    return s;
}

} // namespace tsuya
