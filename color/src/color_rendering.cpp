#include "tsuya/color/color_rendering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "color_appearance.h"
#include "daylight.h"
#include "tables.h"
#include "tsuya/color/observer.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

/// Spectrum of a row of a table.
template <class Value, std::size_t count>
Spectrum spectrum_of(const Value (&row)[count], int first_nm) {
    constexpr int kStepNm = 5;
    Spectrum s{{}, {}};
    for (std::size_t i = 0; i < count; ++i) {
        s.wavelength_nm.push_back(first_nm + kStepNm * static_cast<int>(i));
        s.value.push_back(static_cast<double>(row[i]));
    }
    return s;
}

/// XYZ of several samples under one lamp; a white has Y = 100.
std::vector<glm::dvec3> colours_under(const Spectrum &lamp, std::span<const Spectrum> samples,
                                      Observer observer) {
    const std::vector<ColorWeight> weights = color_weights(lamp, observer);
    std::vector<glm::dvec3> colours;
    for (const Spectrum &sample : samples) {
        glm::dvec3 sum(0.0);
        for (const ColorWeight &weight : weights)
            sum += sample.at(weight.wavelength_nm) * weight.xyz;
        colours.push_back(100.0 * sum);
    }
    return colours;
}

/// [CIE133] section 5.6: coordinates u, v and, for the adaptation, c, d.
struct Chromaticity1960 {
    double u, v, c, d;
    explicit Chromaticity1960(const glm::dvec3 &xyz) {
        const double sum = xyz.x + 15 * xyz.y + 3 * xyz.z;
        u = 4 * xyz.x / sum;
        v = 6 * xyz.y / sum;
        c = (4 - u - 10 * v) / v;
        d = (1.708 * v + 0.404 - 1.481 * u) / v;
    }
};

/// U*, V*, W* beside the white of the reference.
glm::dvec3 uvw(double u, double v, double y, const Chromaticity1960 &white) {
    const double w = 25 * std::cbrt(y) - 17;
    return {13 * w * (u - white.u), 13 * w * (v - white.v), w};
}

// [CIE133] sections 5.7 to 5.9
double general_index(const Spectrum &lamp, const Spectrum &reference) {
    std::vector<Spectrum> samples;
    for (const auto &row : tables::kTestColours)
        samples.push_back(spectrum_of(row, kObserverFirstNm));
    const auto tested = colours_under(lamp, samples, Observer::cie1931);
    const auto wanted = colours_under(reference, samples, Observer::cie1931);
    const Chromaticity1960 white(white_of(reference)), lit(white_of(lamp));
    double sum = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Chromaticity1960 seen(tested[i]), right(wanted[i]);
        const double c = white.c / lit.c * seen.c, d = white.d / lit.d * seen.d;
        const double scale = 1 / (16.518 + 1.481 * c - d);
        const glm::dvec3 a =
            uvw((10.872 + 0.404 * c - 4 * d) * scale, 5.520 * scale, tested[i].y, white);
        const glm::dvec3 b = uvw(right.u, right.v, wanted[i].y, white);
        sum += 100 - 4.6 * glm::distance(a, b);
    }
    return sum / static_cast<double>(samples.size());
}

Spectrum reference_of_ra(double kelvin) {
    return kelvin < 5000 ? black_body(kelvin) : daylight(std::min(kelvin, 25'000.0));
}

// [CIE224] section 4.3: between 4000 and 5000 K a mixture by luminous power.
Spectrum reference_of_rf(double kelvin) {
    if (kelvin <= 4000)
        return black_body(kelvin);
    if (kelvin >= 5000)
        return daylight(std::min(kelvin, 25'000.0));
    Spectrum mixture = black_body(kelvin);
    const Spectrum day = daylight(kelvin);
    const double share = (kelvin - 4000) / 1000;
    const double of_body = (1 - share) / luminous_power(mixture),
                 of_day = share / luminous_power(day);
    for (std::size_t i = 0; i < mixture.value.size(); ++i)
        mixture.value[i] = of_body * mixture.value[i] + of_day * day.at(mixture.wavelength_nm[i]);
    return mixture;
}

std::vector<glm::dvec3> appearances(const Spectrum &lamp, std::span<const Spectrum> samples) {
    const AppearanceModel model(100.0 * white_of(lamp, Observer::cie1964));
    std::vector<glm::dvec3> all;
    for (const glm::dvec3 &xyz : colours_under(lamp, samples, Observer::cie1964))
        all.push_back(model.uniform(xyz));
    return all;
}

constexpr std::size_t kHueBins = 16;

/// Area of the polygon of mean a', b' in each bin of hue of the reference. [TM30] section 4.4
double gamut_area(std::span<const glm::dvec3> colours, std::span<const glm::dvec3> reference) {
    std::array<glm::dvec2, kHueBins> sums{};
    std::array<int, kHueBins> counts{};
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const double turn = std::atan2(reference[i].z, reference[i].y) / (2 * kPi);
        const auto bin =
            static_cast<std::size_t>((turn < 0 ? turn + 1 : turn) * kHueBins) % kHueBins;
        sums[bin] += glm::dvec2(colours[i].y, colours[i].z);
        ++counts[bin];
    }
    std::vector<glm::dvec2> corners;
    for (std::size_t i = 0; i < kHueBins; ++i)
        if (counts[i] > 0)
            corners.push_back(sums[i] / static_cast<double>(counts[i]));
    double area = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        area += (a.x * b.y - a.y * b.x) / 2;
    }
    return area;
}

void add_fidelity(const Spectrum &lamp, LampFigures &figures) {
    std::vector<Spectrum> samples;
    for (const auto &row : tables::kEvaluationSamples)
        samples.push_back(spectrum_of(row, tables::kLampFirstNm));
    const auto tested = appearances(lamp, samples);
    const auto wanted = appearances(reference_of_rf(figures.temperature->kelvin), samples);
    double sum = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
        sum += glm::distance(tested[i], wanted[i]);
    // [CIE224] Eq. 23 and 24: never below 0.
    const double linear = 100 - 6.73 * sum / static_cast<double>(samples.size());
    figures.rf = 10 * std::log1p(std::exp(linear / 10));
    figures.rg = 100 * gamut_area(tested, wanted) / gamut_area(wanted, wanted);
}

} // namespace

LampFigures lamp_figures(const Spectrum &lamp) {
    LampFigures figures{.xy = chromaticity(white_of(lamp))};
    figures.temperature = color_temperature(figures.xy);
    if (!figures.temperature)
        return figures;
    figures.ra = general_index(lamp, reference_of_ra(figures.temperature->kelvin));
    add_fidelity(lamp, figures);
    return figures;
}

} // namespace tsuya
