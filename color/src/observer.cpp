#include "tsuya/color/observer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>

#include "tables.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

/// Whole nanometres and all samples between them, each once, in order.
std::vector<double> integration_nodes(const Spectrum &lamp, std::span<const double> more_nm) {
    std::vector<double> nodes;
    for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm)
        nodes.push_back(nm);
    for (const std::span<const double> samples :
         {std::span<const double>(lamp.wavelength_nm), more_nm})
        for (const double nm : samples)
            if (nm > kObserverFirstNm && nm < kObserverLastNm && nm != std::floor(nm))
                nodes.push_back(nm);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

glm::dvec3 matching_between(Observer observer, double nm) {
    const double floor_nm = std::floor(nm);
    const auto whole_nm = static_cast<int>(floor_nm);
    const glm::dvec3 below = color_matching(observer, whole_nm);
    return nm == floor_nm ? below
                          : glm::mix(below, color_matching(observer, whole_nm + 1), nm - floor_nm);
}

/// Powers near the ends of the range of a double would overflow or vanish in sums: their scale.
double unit_of(const Spectrum &lamp) {
    constexpr double kLargest = 1e100;
    double peak = 0;
    for (const double value : lamp.value)
        peak = std::max(peak, value);
    return peak > kLargest || (peak > 0 && peak < 1 / kLargest) ? peak : 1;
}

/// lamp / unit x observer by the trapezoidal rule.
std::vector<ColorWeight> terms(const Spectrum &lamp, Observer observer,
                               std::span<const double> more_nm, double unit) {
    const std::vector<double> nodes = integration_nodes(lamp, more_nm);
    std::vector<ColorWeight> all;
    all.reserve(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        // The outermost whole nanometres stand for a nanometre each, as in the sum at 1 nm.
        const double before = i > 0 ? nodes[i - 1] : nodes.front() - 1;
        const double after = i + 1 < nodes.size() ? nodes[i + 1] : nodes.back() + 1;
        all.push_back({nodes[i], 0.5 * (after - before) * (lamp.at(nodes[i]) / unit) *
                                     matching_between(observer, nodes[i])});
    }
    return all;
}

} // namespace

glm::dvec3 color_matching(Observer observer, int wavelength_nm) {
    if (wavelength_nm < kObserverFirstNm || wavelength_nm > kObserverLastNm)
        return glm::dvec3(0.0);
    const auto &table = observer == Observer::cie1931 ? tables::kCie1931 : tables::kCie1964;
    const double *row = table[wavelength_nm - kObserverFirstNm];
    return {row[0], row[1], row[2]};
}

std::vector<ColorWeight> color_weights(const Spectrum &lamp, Observer observer,
                                       std::span<const double> more_nm) {
    std::vector<ColorWeight> weights = terms(lamp, observer, more_nm, unit_of(lamp));
    double white_y = 0;
    for (const ColorWeight &weight : weights)
        white_y += weight.xyz.y;
    if (!(white_y > 0))
        throw Error({"the lamp has no visible power", "lamp",
                     "expected a spectrum with positive power between 360 and 830 nm"});
    for (ColorWeight &weight : weights)
        weight.xyz /= white_y;
    return weights;
}

double luminous_power(const Spectrum &lamp, Observer observer) {
    const double unit = unit_of(lamp);
    double power = 0;
    for (const ColorWeight &weight : terms(lamp, observer, {}, unit))
        power += weight.xyz.y;
    return power * unit;
}

glm::dvec3 xyz_of(const Spectrum &lamp, const Spectrum &reflectance, Observer observer) {
    glm::dvec3 sum(0.0);
    for (const ColorWeight &weight : color_weights(lamp, observer, reflectance.wavelength_nm))
        sum += reflectance.at(weight.wavelength_nm) * weight.xyz;
    return sum;
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
