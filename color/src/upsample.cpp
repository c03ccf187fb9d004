#include "tsuya/color/upsample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "tsuya/color/difference.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/relight.h"
#include "tsuya/color/srgb.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr SpectralBasis kNodes{.count = 36, .first_nm = 380, .last_nm = 730};
constexpr std::size_t kCount = 36;
constexpr std::size_t kSize = kCount + 3; // and one multiplier for each of X, Y, Z

using Vector = std::array<double, kSize>;
using Matrix = std::array<Vector, kSize>;

/// Solves m x = b by elimination with row exchange; nothing if m is singular.
std::optional<Vector> solve(Matrix m, Vector b) {
    for (std::size_t i = 0; i < kSize; ++i) {
        std::size_t pivot = i;
        for (std::size_t row = i + 1; row < kSize; ++row)
            if (std::abs(m[row][i]) > std::abs(m[pivot][i]))
                pivot = row;
        if (!(std::abs(m[pivot][i]) > 0))
            return std::nullopt;
        std::swap(m[i], m[pivot]);
        std::swap(b[i], b[pivot]);
        for (std::size_t row = i + 1; row < kSize; ++row) {
            const double factor = m[row][i] / m[i][i];
            for (std::size_t column = i; column < kSize; ++column)
                m[row][column] -= factor * m[i][column];
            b[row] -= factor * b[i];
        }
    }
    for (std::size_t i = kSize; i-- > 0;) {
        for (std::size_t column = i + 1; column < kSize; ++column)
            b[i] -= m[i][column] * b[column];
        b[i] /= m[i][i];
    }
    return b;
}

double reflectance(double z) { return 0.5 * (std::tanh(z) + 1); }

/// Newton's method on the Lagrangian of [Burns] section "LHTSS": unknowns z at the nodes, with
/// R = (tanh z + 1) / 2, and three multipliers. Returns true if `state` has come to `xyz`.
bool fit(const std::vector<glm::dvec3> &weights, const glm::dvec3 &xyz, Vector &state) {
    constexpr int kMostSteps = 60;
    constexpr double kTolerance = 1e-10;
    for (int step = 0; step < kMostSteps; ++step) {
        Matrix m{};
        Vector residual{};
        for (int c = 0; c < 3; ++c)
            residual[kCount + static_cast<std::size_t>(c)] = -xyz[c];
        for (std::size_t i = 0; i < kCount; ++i) {
            // Slope: the sum of (z_i+1 - z_i)^2.
            for (const std::size_t j : {i - 1, i + 1})
                if (j < kCount) {
                    m[i][i] += 2;
                    m[i][j] -= 2;
                    residual[i] += 2 * (state[i] - state[j]);
                }
            // Colour: the sum of weights R equals xyz.
            const double t = std::tanh(state[i]), slope = 0.5 * (1 - t * t);
            for (int c = 0; c < 3; ++c) {
                const std::size_t row = kCount + static_cast<std::size_t>(c);
                const double w = weights[i][c];
                residual[i] += w * slope * state[row];
                residual[row] += w * 0.5 * (t + 1);
                m[i][i] -= w * 2 * t * slope * state[row];
                m[i][row] = m[row][i] = w * slope;
            }
        }
        double worst = 0;
        for (const double r : residual)
            worst = std::max(worst, std::abs(r));
        if (worst < kTolerance)
            return true;
        const std::optional<Vector> change = solve(m, residual);
        if (!change || !std::isfinite((*change)[0]))
            return false;
        for (std::size_t i = 0; i < kSize; ++i)
            state[i] -= (*change)[i];
    }
    return false;
}

/// The reflectance of that colour; strong colours are reached by way of weaker ones.
Spectrum smoothest(const glm::dvec3 &xyz, const Spectrum &lamp, Observer observer,
                   const std::string &where) {
    const std::vector<glm::dvec3> weights = lamp_matrix(lamp, kNodes, observer);
    const glm::dvec3 grey = xyz.y * white_of(lamp, observer);
    for (const int legs : {1, 4, 16, 64, 256}) {
        Vector state{};
        bool there = true;
        for (int leg = 1; there && leg <= legs; ++leg)
            there = fit(weights, grey + (xyz - grey) * (static_cast<double>(leg) / legs), state);
        if (!there)
            continue;
        Spectrum s{{}, {}};
        for (std::size_t i = 0; i < kCount; ++i) {
            s.wavelength_nm.push_back(kNodes.centre_nm(static_cast<int>(i)));
            s.value.push_back(reflectance(state[i]));
        }
        return s;
    }
    throw Error({"no smooth reflectance has this colour under its lamp", where,
                 "expected a colour that is less bright or less saturated"});
}

} // namespace

Spectrum reflectance_of_srgb(const glm::dvec3 &rgb, const std::string &where) {
    for (int c = 0; c < 3; ++c)
        if (!(rgb[c] >= 0 && rgb[c] <= 1))
            throw Error({"the colour has the part " + std::to_string(rgb[c]), where,
                         "expected 0 to 1 for red, green and blue"});
    if (rgb.x == rgb.y && rgb.y == rgb.z)
        return Spectrum::constant(rgb.x);
    const Spectrum d65 = lamp("D65");
    // The rounded white of sRGB is not quite that of D65: scaled, so that greys are constant.
    const glm::dvec3 white_ratio = white_of(d65) / srgb_white();
    return smoothest(white_ratio * (xyz_from_srgb() * rgb), d65, Observer::cie1931, where);
}

Spectrum reflectance_of_lab(const glm::dvec3 &lab, const Spectrum &lamp, Observer observer,
                            const std::string &where) {
    if (!(lab.x >= 0 && lab.x <= 100) || !std::isfinite(lab.y) || !std::isfinite(lab.z))
        throw Error({"the colour has L* = " + std::to_string(lab.x), where,
                     "expected 0 to 100 for L*, and finite a* and b*"});
    const glm::dvec3 white = white_of(lamp, observer), xyz = xyz_of_lab(lab, white);
    if (lab.y == 0 && lab.z == 0)
        return Spectrum::constant(std::clamp(xyz.y, 0.0, 1.0));
    return smoothest(xyz, lamp, observer, where);
}

} // namespace tsuya
