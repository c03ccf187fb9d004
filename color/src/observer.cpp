#include "tsuya/color/observer.h"

#include <cassert>

#include "tables.h"
#include "tsuya/sdk/error.h"

namespace tsuya {

glm::dvec3 color_matching(Observer observer, int wavelength_nm) {
    if (wavelength_nm < kObserverFirstNm || wavelength_nm > kObserverLastNm)
        return glm::dvec3(0.0);
    const auto &table = observer == Observer::cie1931 ? tables::kCie1931 : tables::kCie1964;
    const double *row = table[wavelength_nm - kObserverFirstNm];
    return {row[0], row[1], row[2]};
}

glm::dvec3 xyz_of(const Spectrum &lamp, const Spectrum &reflectance, Observer observer) {
    glm::dvec3 sum(0.0);
    double white_y = 0;
    for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm) {
        const glm::dvec3 weight = lamp.at(nm) * color_matching(observer, nm);
        sum += reflectance.at(nm) * weight;
        white_y += weight.y;
    }
    if (!(white_y > 0))
        throw Error({"the lamp has no visible power", "lamp",
                     "expected a spectrum with positive power between 360 and 830 nm"});
    return sum / white_y;
}

glm::dvec3 white_of(const Spectrum &lamp, Observer observer) {
    return xyz_of(lamp, Spectrum::constant(1.0), observer);
}

glm::dvec2 chromaticity(const glm::dvec3 &xyz) {
    const double sum = xyz.x + xyz.y + xyz.z;
    return sum == 0 ? glm::dvec2(0.0) : glm::dvec2(xyz.x / sum, xyz.y / sum);
}

glm::dvec3 xyz_of_chromaticity(const glm::dvec2 &xy) {
    assert(xy.y > 0);
    return {xy.x / xy.y, 1.0, (1.0 - xy.x - xy.y) / xy.y};
}

} // namespace tsuya
