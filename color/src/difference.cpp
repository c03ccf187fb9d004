#include "tsuya/color/difference.h"
#include "tsuya/sdk/angle.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace tsuya {
namespace {

// [CIE015] section 8.2.1: the cube root, with a straight piece near black.
double lab_root(double t) {
    constexpr double kEdge = 24.0 / 116.0;
    return t > kEdge * kEdge * kEdge ? std::cbrt(t) : 841.0 / 108.0 * t + 16.0 / 116.0;
}

// Its inverse.
double lab_power(double root) {
    constexpr double kEdge = 24.0 / 116.0;
    return root > kEdge ? root * root * root : 108.0 / 841.0 * (root - 16.0 / 116.0);
}

// Hue angle in degrees, [0, 360); 0 where there is no chroma. [Sharma] Eq. 7
double hue_deg(double a, double b) {
    if (a == 0 && b == 0)
        return 0;
    const double h = std::atan2(b, a) / kDegree;
    return h < 0 ? h + 360 : h;
}

// x^7 / (x^7 + 25^7), rooted.
double chroma_weight(double chroma) {
    const double c7 = std::pow(chroma, 7);
    return std::sqrt(c7 / (c7 + 6103515625.0));
}

/// The two hues: their signed difference and their mean, in degrees.
struct HuePair {
    double difference_deg = 0;
    double mean_deg = 0;
};

// [Sharma] Eq. 10 and 14; a colour without chroma takes the hue of the other.
HuePair compare_hues(double h1, double h2, bool neutral) {
    if (neutral)
        return {0, h1 + h2};
    const double d = h2 - h1, sum = h1 + h2;
    if (std::abs(d) <= 180)
        return {d, sum / 2};
    return {d > 180 ? d - 360 : d + 360, sum < 360 ? (sum + 360) / 2 : (sum - 360) / 2};
}

} // namespace

glm::dvec3 lab_of(const glm::dvec3 &xyz, const glm::dvec3 &white) {
    const double x = lab_root(xyz.x / white.x), y = lab_root(xyz.y / white.y),
                 z = lab_root(xyz.z / white.z);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

glm::dvec3 xyz_of_lab(const glm::dvec3 &lab, const glm::dvec3 &white) {
    const double y = (lab.x + 16) / 116;
    return white * glm::dvec3(lab_power(y + lab.y / 500), lab_power(y), lab_power(y - lab.z / 200));
}

double ciede2000(const glm::dvec3 &lab_a, const glm::dvec3 &lab_b) {
    // Chroma and hue with a* stretched near grey: [Sharma] Eq. 2-7
    const double mean_c = (std::hypot(lab_a.y, lab_a.z) + std::hypot(lab_b.y, lab_b.z)) / 2;
    const double stretch = 1 + 0.5 * (1 - chroma_weight(mean_c));
    const double a1 = stretch * lab_a.y, a2 = stretch * lab_b.y;
    const double c1 = std::hypot(a1, lab_a.z), c2 = std::hypot(a2, lab_b.z);
    const HuePair hue =
        compare_hues(hue_deg(a1, lab_a.z), hue_deg(a2, lab_b.z), c1 == 0 || c2 == 0);

    // Differences: [Sharma] Eq. 8-11
    const double d_l = lab_b.x - lab_a.x, d_c = c2 - c1;
    const double d_h = 2 * std::sqrt(c1 * c2) * std::sin(hue.difference_deg / 2 * kDegree);

    // Weights: [Sharma] Eq. 12-21
    const double l = (lab_a.x + lab_b.x) / 2, c = (c1 + c2) / 2, h = hue.mean_deg;
    const double t = 1 - 0.17 * std::cos((h - 30) * kDegree) + 0.24 * std::cos(2 * h * kDegree) +
                     0.32 * std::cos((3 * h + 6) * kDegree) -
                     0.20 * std::cos((4 * h - 63) * kDegree);
    const double l50 = (l - 50) * (l - 50);
    const double s_l = 1 + 0.015 * l50 / std::sqrt(20 + l50);
    const double s_c = 1 + 0.045 * c, s_h = 1 + 0.015 * c * t;
    const double turn_deg = 30 * std::exp(-(h - 275) / 25 * ((h - 275) / 25));
    const double rotation = -std::sin(2 * turn_deg * kDegree) * 2 * chroma_weight(c);

    // [Sharma] Eq. 22
    const double l_part = d_l / s_l, c_part = d_c / s_c, h_part = d_h / s_h;
    return std::sqrt(std::max(0.0, l_part * l_part + c_part * c_part + h_part * h_part +
                                       rotation * c_part * h_part));
}

double cie76(const glm::dvec3 &lab_a, const glm::dvec3 &lab_b) {
    return glm::distance(lab_a, lab_b);
}

// [ISO105J03] section 4
double cmc(const glm::dvec3 &standard, const glm::dvec3 &sample, double lightness, double chroma) {
    const double c1 = std::hypot(standard.y, standard.z), c2 = std::hypot(sample.y, sample.z);
    const double d_l = sample.x - standard.x, d_c = c2 - c1;
    const double d_a = sample.y - standard.y, d_b = sample.z - standard.z;
    const double d_h_squared = std::max(0.0, d_a * d_a + d_b * d_b - d_c * d_c);

    const double hue = hue_deg(standard.y, standard.z);
    const double t = hue >= 164 && hue <= 345
                         ? 0.56 + std::abs(0.2 * std::cos((hue + 168) * kDegree))
                         : 0.36 + std::abs(0.4 * std::cos((hue + 35) * kDegree));
    const double c4 = c1 * c1 * c1 * c1, f = std::sqrt(c4 / (c4 + 1900));
    const double s_l = standard.x < 16 ? 0.511 : 0.040975 * standard.x / (1 + 0.01765 * standard.x);
    const double s_c = 0.0638 * c1 / (1 + 0.0131 * c1) + 0.638;
    const double s_h = s_c * (f * t + 1 - f);
    return std::hypot(d_l / (lightness * s_l), d_c / (chroma * s_c), std::sqrt(d_h_squared) / s_h);
}

double color_difference(DifferenceFormula formula, const glm::dvec3 &standard,
                        const glm::dvec3 &sample) {
    switch (formula) {
    case DifferenceFormula::cie76:
        return cie76(standard, sample);
    case DifferenceFormula::cmc:
        return cmc(standard, sample);
    case DifferenceFormula::ciede2000:
        break;
    }
    return ciede2000(standard, sample);
}

std::string to_string(DifferenceFormula formula) {
    switch (formula) {
    case DifferenceFormula::cie76:
        return "CIE76";
    case DifferenceFormula::cmc:
        return "CMC(2:1)";
    case DifferenceFormula::ciede2000:
        break;
    }
    return "CIEDE2000";
}

} // namespace tsuya
