// The functions below are compiled for three instruction sets, of which the program takes the
// widest that the processor has; and without regard to NaN (see CMakeLists.txt), which the callers
// keep away: a least of two is then one instruction.

#include "models/takeda_kernel.h"

#include <algorithm>
#include <cstring>

#include "models/every_processor.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::kernel {
namespace {

constexpr std::size_t kWide = 16, kNarrow = 8;

// As many pairs as fill one vector. Directions are read as the floats that they are: three at a
// time is what the compiler knows to spread over vectors.
template <std::size_t kSize>
inline bool evaluate_block(const DiskTable &table, float f0, float low, const float *light,
                           const float *view, float *out) {
    alignas(64) float factor[kSize], s[kSize], t[kSize];
    alignas(64) std::uint32_t index[kSize];
    int any_low = 0;
    for (std::size_t i = 0; i < kSize; ++i) {
        const float *const l = light + 3 * i, *const v = view + 3 * i;
        const Pair p = pair_of(l[0], l[1], l[2], v[0], v[1], v[2]);
        const DiskTable::Cell cell = table.cell_of(p.x, p.y);
        factor[i] = least(l[2], v[2]) > 0 ? times_cosine(1, f0, p, l[2], v[2]) : 0.0f;
        any_low |= l[2] < low ? 1 : 0;
        index[i] = cell.index;
        s[i] = cell.s;
        t[i] = cell.t;
    }
    // Two neighbours in one move
    alignas(64) float row[kSize][2], next[kSize][2];
    const float *const data = table.data();
    const auto nodes = static_cast<std::size_t>(table.nodes());
    for (std::size_t i = 0; i < kSize; ++i) {
        std::memcpy(row[i], data + index[i], sizeof row[i]);
        std::memcpy(next[i], data + index[i] + nodes, sizeof next[i]);
    }
    for (std::size_t i = 0; i < kSize; ++i) {
        const float value = (1 - t[i]) * ((1 - s[i]) * row[i][0] + s[i] * row[i][1]) +
                            t[i] * ((1 - s[i]) * next[i][0] + s[i] * next[i][1]);
        out[i] = value * factor[i];
    }
    return any_low != 0;
}

// Fewer than fill a vector
template <std::size_t kSize>
inline bool evaluate_rest(const DiskTable &table, float f0, float low, const float *light,
                          const float *view, float *out, std::size_t count) {
    float lights[3 * kSize] = {}, views[3 * kSize] = {}, results[kSize];
    std::copy_n(light, 3 * count, lights);
    std::copy_n(view, 3 * count, views);
    const bool any_low = evaluate_block<kSize>(table, f0, low, lights, views, results);
    std::copy_n(results, count, out);
    return any_low;
}

} // namespace

TSUYA_FOR_EVERY_PROCESSOR
float f_cos(const DiskTable &table, float f0, const glm::vec3 &to_light,
            const glm::vec3 &to_viewer) {
    const Pair p =
        pair_of(to_light.x, to_light.y, to_light.z, to_viewer.x, to_viewer.y, to_viewer.z);
    return times_cosine(table.at_disk(p.x, p.y), f0, p, to_light.z, to_viewer.z);
}

TSUYA_FOR_EVERY_PROCESSOR
Weighed weigh(const DiskTable &table, const Distribution2D &halves, float f0,
              const glm::vec3 &to_light, const glm::vec3 &to_viewer) {
    const Pair p =
        pair_of(to_light.x, to_light.y, to_light.z, to_viewer.x, to_viewer.y, to_viewer.z);
    // dH/dL = 1 / (4 V.H); the disk of the horizontal part of H has the area element N.H dH, the
    // square about it four times the area of the disk's own
    const float over_facing = 1 / p.facing, quarter = 0.25f * over_facing;
    const float level2 =
        (p.half_x * p.half_x + p.half_y * p.half_y) * (0.25f * over_facing * over_facing);
    const float level_share = near_level_share(to_viewer.z);
    const float at_half =
        (1 - level_share) * halves.density({quarter * p.half_x + 0.5f, quarter * p.half_y + 0.5f}) +
        (level2 < kNearLevel2 ? level_share * (4 / (kPiF * kNearLevel2)) : 0.0f);
    return {times_cosine(table.at_disk(p.x, p.y), f0, p, to_light.z, to_viewer.z),
            at_half * (0.03125f * over_facing * over_facing) * p.half_z};
}

TSUYA_FOR_EVERY_PROCESSOR
bool evaluate(const DiskTable &table, float f0, float low, const glm::vec3 *to_light,
              const glm::vec3 *to_viewer, float *out, std::size_t count) {
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    if (count == 0)
        return false; // the pointers may be null
    const float *light = &to_light->x, *view = &to_viewer->x;
    bool any_low = false;
    for (; count >= kWide; count -= kWide, light += 3 * kWide, view += 3 * kWide, out += kWide)
        any_low |= evaluate_block<kWide>(table, f0, low, light, view, out);
    if (count == kNarrow)
        any_low |= evaluate_block<kNarrow>(table, f0, low, light, view, out);
    else if (count > kNarrow)
        any_low |= evaluate_rest<kWide>(table, f0, low, light, view, out, count);
    else if (count > 0)
        any_low |= evaluate_rest<kNarrow>(table, f0, low, light, view, out, count);
    return any_low;
}

} // namespace tsuya::kernel
