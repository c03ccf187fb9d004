#include "tsuya/sdk/detail/yarn_cones.h"

#include <vector>

#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr int kSines = 128;
constexpr int kFixedTurns = 32, kFreeTurns = 64;
constexpr int kTurns = 8; // of half a filament's normals about its axis

} // namespace

// A filament of another slope has its normals at that slope's angle in the upright plane, at less
// beside it.
YarnCones::YarnCones(const YarnLobes &lobes, double width,
                     const std::function<float(float)> &about_yarn) {
    std::vector<double> mass(std::size_t{2} * kSines);
    for (std::size_t axis = 0; axis < 2; ++axis)
        for (int k = 0; k < kYarnSlopes; ++k)
            for (int turn = 0; turn < kTurns; ++turn) {
                const double upright = std::cos((turn + 0.5) / kTurns * kPi / 2);
                const double middle = -std::atan(std::tan(yarn_slope(k)) * upright);
                for (int i = 0; i < kSines; ++i) {
                    const double angle = std::asin((2 * i + 1.0) / kSines - 1);
                    const double off = (angle - middle) / width;
                    mass[axis * kSines + static_cast<std::size_t>(i)] +=
                        lobes.surface[axis][static_cast<std::size_t>(k)] * upright *
                        std::exp(-0.5 * off * off) / std::cos(angle);
                }
            }
    sines_ = Distribution2D(mass, 2, kSines);
    // f cos has the light's cosine over the sum of both
    std::vector<double> turned;
    for (int j = 0; j < kFixedTurns; ++j)
        for (int i = 0; i < kFreeTurns; ++i) {
            const double fixed = std::asin((2 * j + 1.0) / kFixedTurns - 1);
            const double free = std::asin((2 * i + 1.0) / kFreeTurns - 1);
            turned.push_back(about_yarn(static_cast<float>(std::cos(fixed - free))) /
                             (std::cos(fixed) + std::cos(free)));
        }
    turns_ = Distribution2D(turned, kFixedTurns, kFreeTurns);
}

glm::vec3 YarnCones::sample(const glm::vec3 &fixed, const glm::vec3 &u) const {
    const glm::vec2 point = sines_.sample({u.x, u.y}).point;
    const bool of_warp = point.y >= 0.5f;
    const float sine = 2 * point.x - 1;
    const float tangent = sine / std::sqrt(std::max(1 - sine * sine, kLeast));
    const float fixed_along = of_warp ? fixed.y : fixed.x, beside = of_warp ? fixed.x : fixed.y;
    const float fixed_across = std::sqrt(std::max(1 - fixed_along * fixed_along, kLeast));
    // The free direction's phi, then half the angle to the fixed one's
    const float sine_phi = 2 * turns_.sample_along(0.5f + 0.5f * beside / fixed_across, u.z) - 1;
    const float phi = std::sqrt(std::max(1 - sine_phi * sine_phi, 0.0f));
    const float turned = (phi * fixed.z + sine_phi * beside) / fixed_across;
    const float half = tangent * std::sqrt(std::max(0.5f + 0.5f * turned, 0.0f));
    // theta = 2 atan(half) - that of the fixed direction
    const float over = 1 / (1 + half * half), sine2 = 2 * half * over;
    const float cosine2 = (1 - half * half) * over;
    const float along = sine2 * fixed_across - cosine2 * fixed_along;
    const float across = cosine2 * fixed_across + sine2 * fixed_along;
    if (!(across > kLeastAcross))
        return glm::vec3(0);
    return of_warp ? glm::vec3(across * sine_phi, along, across * phi)
                   : glm::vec3(along, across * sine_phi, across * phi);
}

} // namespace tsuya
