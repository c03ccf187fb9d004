#pragma once
// What the great-circle model does with pairs of directions, as straight-line code: no angle
// functions, no branch on the data, three square roots and three divisions. `to_basic` of
// great_circle.h is the same map, legibly; a test holds one against the other.

#include <cmath>
#include <cstddef>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/disk_table.h"
#include "tsuya/sdk/detail/distribution.h"

namespace tsuya::kernel {

inline float least(float a, float b) { return a < b ? a : b; }
inline float most(float a, float b) { return a > b ? a : b; }

// Polynomials of least relative error by Estrin's scheme: Horner's is latency-bound.

// acos(x) / sqrt(1 - x^2) in quarter turns, x in [0, 1]; relative error 2e-7
inline float angle_over_sine(float x) {
    const float x2 = x * x, x4 = x2 * x2;
    const float low = (0.99999993f - 0.636608f * x) + (0.499670623f - 0.420785073f * x) * x2;
    const float high = (0.354310567f - 0.269652571f * x) + (0.160473212f - 0.0619147639f * x) * x2;
    return low + (high + 0.0111258927f * x4) * x4;
}

// sin of d quarter turns, d in [-1, 1]; 2e-7
inline float sine_of(float d) {
    const float q = d * d, q2 = q * q;
    const float low = 1.57079632f - 0.645963711f * q, high = 0.0796896789f - 0.00467376661f * q;
    return d * (low + (high + 0.00015148513f * q2) * q2);
}

// cos of d quarter turns, d in [-1, 1]; 1e-7, also where it vanishes
inline float cosine_of(float d) {
    const float q = d * d, q2 = q * q;
    const float low = 1.0f - 0.233700502f * q, high = 0.0199685861f - 0.000893502661f * q;
    return (1 - d) * (1 + d) * (low + (high + 2.35839046e-05f * q2) * q2);
}

struct Pair {
    float x, y;           // V0 on the disk of the table
    float facing;         // L.H = V.H
    float facing2;        // its square
    float half_x, half_y; // of L + V
    float half_z;
};

// Both directions unit with z >= 0. The operations are in the order of the critical path:
// sqrt and division by the level first, the two arcs next, all else beside them.
inline Pair pair_of(float lx, float ly, float lz, float vx, float vy, float vz) {
    // Light from straight above: any azimuth will do
    lx += std::copysign(1e-10f, lx);
    const float level2 = lx * lx + ly * ly, level = std::sqrt(level2), over_level = 1 / level;
    const float along = -(lx * vx + ly * vy), across = lx * vy - ly * vx;
    // Beta between R and V, which is R cos beta + sin beta (up N + aside (N x R))
    const float cosine = along * over_level;
    const float reach = most(std::sqrt(level2 * vz * vz + across * across), 1e-24f);
    const float sine = reach * over_level, over_reach = 1 / reach;
    const float up = level * vz * over_reach, aside = across * over_reach;

    // [Takeda] Eq. 15 for beta0 - 1, angles in quarter turns. The light's from the horizon keeps
    // its precision at grazing; `acute` is beta where the cosine is positive, 2 - beta elsewhere.
    const float rest = most(lz * angle_over_sine(level), 1e-7f), wide = 2 - rest;
    const float inverse = 1 / (rest * wide), behind = rest * inverse;
    const float acute = sine * angle_over_sine(std::fabs(cosine));
    const float sign = std::copysign(1.0f, cosine);
    // Either branch is the lower one where it holds; behind R only the second does
    const float first = acute * (wide * inverse) + (1 - 2 * sign);
    const float second = acute * (sign * behind) + (1 - (1 + sign) * behind);
    const float d = most(least(first, second), -1.0f);
    const float minus_cosine0 = sine_of(d), sine0 = cosine_of(d);

    // V0: a unit vector also where V is all but R
    const float scale = DiskTable::scale_of(sine0 * up) * over_level, side = sine0 * aside;
    const float hx = lx + vx, hy = ly + vy, hz = lz + vz;
    // |L + V|^2 / 4 = (1 + L.V) / 2, without the cancellation where they are opposite
    const float facing2 = most(0.25f * (hx * hx + hy * hy + hz * hz), 5e-15f);
    return {(minus_cosine0 * lx - side * ly) * scale,
            (minus_cosine0 * ly + side * lx) * scale,
            std::sqrt(facing2),
            facing2,
            hx,
            hy,
            hz};
}

// rho times the first cosine, from the value of the table at V0: [Takeda] Eq. 14 in its regular
// form.
inline float times_cosine(float at_basic, float f0, const Pair &p, float first, float second) {
    const float m = 1 - p.facing, m2 = m * m;
    const float fresnel = f0 + (1 - f0) * m2 * m2 * m; // [Takeda] Eq. 5
    const float masked = least(p.facing2, p.half_z * least(first, second));
    return at_basic * (fresnel * masked / (p.facing2 * most(second, 1e-18f)));
}

// rho times the light's cosine, before the limit of energy. The directions are unit, finite, with
// z > 0, here and below.
float f_cos(const DiskTable &table, float f0, const glm::vec3 &to_light,
            const glm::vec3 &to_viewer);

// A view near grazing sees the peak of rho0 by facets of all tilts up to 30 degrees: V0 is N where
// V is as far from R as the light from the horizon, and the tangent of that tilt is sqrt(2 r - 1) /
// (r + 1), r the light's elevation over the view's. Beyond, V0 leaves N slowly. So facets nearer to
// level than 50 degrees are sampled alike in that share of the samples.
constexpr float kNearLevel2 = 0.587f; // sin^2
inline float near_level_share(float view_cosine) {
    const float m = 1 - view_cosine, m2 = m * m, m4 = m2 * m2;
    return 0.4f * m4 * m4;
}

// The same with the density of the light where H is sampled from `halves`, which is over the square
// about the disk of its horizontal part, and by near_level_share.
struct Weighed {
    float f_cos, density_per_sr;
};
Weighed weigh(const DiskTable &table, const Distribution2D &halves, float f0,
              const glm::vec3 &to_light, const glm::vec3 &to_viewer);

// f_cos of many pairs, 0 where one of the two is at or below the horizon. Returns whether a light
// may have a cosine below `low`.
bool evaluate(const DiskTable &table, float f0, float low, const glm::vec3 *to_light,
              const glm::vec3 *to_viewer, float *f_cos, std::size_t count);

} // namespace tsuya::kernel
