#pragma once
// What the great-circle model does with pairs of directions, as straight-line code: no angle
// functions, no branch on the data, three square roots and three divisions. `to_basic` of
// great_circle.h is the same map, legibly; a test holds one against the other.

#include <cmath>
#include <cstddef>

#include <glm/glm.hpp>

#include "tsuya/sdk/disk_table.h"

namespace tsuya::kernel {

inline float least(float a, float b) { return a < b ? a : b; }
inline float most(float a, float b) { return a > b ? a : b; }

// Polynomials of least relative error, summed in pairs: a chain of products would be waited for.

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

// 1 / sqrt(1 + z), z in [0, 1]; 4e-7
inline float disk_scale(float z) {
    const float z2 = z * z;
    const float low = (0.999999701f - 0.499959877f * z) + (0.37409959f - 0.304589747f * z) * z2;
    const float high = (0.237753768f - 0.151492232f * z) + (0.0638943247f - 0.0125989583f * z) * z2;
    return low + high * (z2 * z2);
}

struct Pair {
    float x, y;           // V0 on the equal-area disk
    float k;              // 2 N.H / V.H
    float facing;         // L.H = V.H
    float half_x, half_y; // of H
};

// Both directions unit with z >= 0.
inline Pair pair_of(float lx, float ly, float lz, float vx, float vy, float vz) {
    // Light from straight above: any azimuth will do
    constexpr float kSmallSquare = 1e-20f, kSmallStep = 1e-10f;
    lx = lx * lx + ly * ly > kSmallSquare ? lx : kSmallStep;
    const float level2 = lx * lx + ly * ly, level = std::sqrt(level2);
    const float along = -(lx * vx + ly * vy), across = lx * vy - ly * vx;
    // |L_xy| times the sine of beta
    const float reach = most(std::sqrt(level2 * vz * vz + across * across), 1e-24f);
    const float inverse = 1 / (level * reach);
    const float over_level = reach * inverse, over_sine = level * level * inverse;
    const float cosine = least(most(along * over_level, -1.0f), 1.0f);
    const float sine = reach * over_level;

    // Angles in quarter turns: beta between R and V; the light's
    // from the horizon, which keeps its precision at grazing
    const float rest = most(lz * angle_over_sine(least(level, 1.0f)), 1e-7f), wide = 2 - rest;
    const float acute = sine * angle_over_sine(std::fabs(cosine));
    const float obtuse = 0.5f - std::copysign(0.5f, cosine); // 1 or 0
    const float beta = most(acute, obtuse * (2 - acute));

    // |L + V|^2 / 2 = 1 + L.V, without the cancellation where they are opposite
    const float hx = lx + vx, hy = ly + vy, hz = lz + vz;
    const float sum = most(0.5f * (hx * hx + hy * hy + hz * hz), 1e-14f);
    const float facing = std::sqrt(0.5f * sum);

    // [Takeda] Eq. 15. Either branch is the lower one where it holds.
    const float shared = 1 / (rest * wide * facing);
    const float towards = beta * (wide * facing * shared);
    const float behind = 2 - (2 - beta) * (rest * facing * shared);
    const float beta0 = most(least(towards, behind), 0.0f);
    const float cosine0 = -sine_of(beta0 - 1), sine0 = cosine_of(beta0 - 1);

    // V0 = cos beta0 R + (sin beta0 / sin beta) (V - cos beta R), by its parts along R, across it
    // and along N: a unit vector also where V is all but R
    const float ratio = sine0 * over_sine;
    const float side = ratio * across * over_level;
    const float over_facing = rest * wide * shared;
    const float scale = disk_scale(least(ratio * vz, 1.0f));
    const float half = 0.5f * over_facing; // 1 / |L + V|
    const float level_scale = over_level * scale;
    return {-(cosine0 * lx + side * ly) * level_scale,
            (side * lx - cosine0 * ly) * level_scale,
            hz * over_facing * over_facing,
            least(facing, 1.0f),
            hx * half,
            hy * half};
}

// rho times the first cosine, from the value of the table at V0: [Takeda] Eq. 14 in its regular
// form.
inline float times_cosine(float at_basic, float f0, const Pair &p, float first, float second) {
    const float m = 1 - p.facing, m2 = m * m;
    const float fresnel = f0 + (1 - f0) * m2 * m2 * m; // [Takeda] Eq. 5
    const float masked = least(1.0f, p.k * least(first, second));
    return at_basic * fresnel * masked / most(second, 1e-18f);
}

// A pair with its value. The directions are unit, finite, with z > 0.
struct Evaluated {
    float f_cos; // rho times the light's cosine, before the limit of energy
    float k, half_x, half_y;
};
float f_cos(const DiskTable &table, float f0, const glm::vec3 &to_light,
            const glm::vec3 &to_viewer);
Evaluated evaluate(const DiskTable &table, float f0, const glm::vec3 &to_light,
                   const glm::vec3 &to_viewer);

// f_cos of many pairs, 0 where one of the two is at or below the horizon.
void evaluate(const DiskTable &table, float f0, const glm::vec3 *to_light,
              const glm::vec3 *to_viewer, float *f_cos, std::size_t count);

} // namespace tsuya::kernel
