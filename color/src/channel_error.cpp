#include "tsuya/color/channel_error.h"

#include <algorithm>
#include <cmath>

#include "tsuya/color/difference.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/relight.h"

namespace tsuya {

double channel_error(const Spectrum &reflectance, const SpectralBasis &basis) {
    constexpr int kMeetings = 2;
    const std::vector<float> channels = project(reflectance, basis);
    double largest = 0;
    for (const char *const name : {"D65", "A", "FL11"}) {
        const Spectrum light = lamp(name);
        const glm::dvec3 white = white_of(light);
        const std::vector<glm::dvec3> matrix = lamp_matrix(light, basis);
        const auto weights = color_weights(light, Observer::cie1931, reflectance.wavelength_nm);
        for (int meetings = 1; meetings <= kMeetings; ++meetings) {
            glm::dvec3 shown(0), exact(0);
            for (std::size_t k = 0; k < matrix.size(); ++k)
                shown += std::pow(static_cast<double>(channels[k]), meetings) * matrix[k];
            for (const ColorWeight &weight : weights)
                exact += std::pow(reflectance.at(weight.wavelength_nm), meetings) * weight.xyz;
            largest = std::max(largest, ciede2000(lab_of(shown, white), lab_of(exact, white)));
        }
    }
    return largest;
}

} // namespace tsuya
