// The functions below are compiled for three instruction sets, of which the program takes the
// widest that the processor has; and without regard to NaN (see CMakeLists.txt), which the callers
// keep away: a least of two is then one instruction.

#include "takeda_kernel.h"

#include <algorithm>

// The sanitizers start after the choice would be made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__)
#define TSUYA_FOR_EVERY_PROCESSOR                                                                  \
    __attribute__((flatten, target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define TSUYA_FOR_EVERY_PROCESSOR __attribute__((flatten))
#endif

namespace tsuya::kernel {
namespace {

constexpr std::size_t kWide = 16, kNarrow = 8;

// Coordinates apart, so that one vector holds the same coordinate of many directions.
template <std::size_t kSize> struct Block {
    alignas(64) float lx[kSize], ly[kSize], lz[kSize];
    alignas(64) float vx[kSize], vy[kSize], vz[kSize];
    alignas(64) float f_cos[kSize];
};

template <std::size_t kSize>
inline void evaluate_block(const DiskTable &table, float f0, Block<kSize> &b) {
    alignas(64) float k[kSize], facing[kSize], s[kSize], t[kSize];
    alignas(64) std::uint32_t index[kSize];
    for (std::size_t i = 0; i < kSize; ++i) {
        const Pair p = pair_of(b.lx[i], b.ly[i], b.lz[i], b.vx[i], b.vy[i], b.vz[i]);
        const DiskTable::Cell cell = table.cell_of(p.x, p.y);
        k[i] = p.k;
        facing[i] = p.facing;
        index[i] = cell.index;
        s[i] = cell.s;
        t[i] = cell.t;
    }
    alignas(64) float corner[4][kSize];
    const float *const data = table.data();
    const auto nodes = static_cast<std::size_t>(table.nodes());
    for (std::size_t i = 0; i < kSize; ++i) {
        const float *const at = data + index[i];
        corner[0][i] = at[0];
        corner[1][i] = at[1];
        corner[2][i] = at[nodes];
        corner[3][i] = at[nodes + 1];
    }
    for (std::size_t i = 0; i < kSize; ++i) {
        const float value = (1 - t[i]) * ((1 - s[i]) * corner[0][i] + s[i] * corner[1][i]) +
                            t[i] * ((1 - s[i]) * corner[2][i] + s[i] * corner[3][i]);
        const float f_cos =
            times_cosine(value, f0, {0, 0, k[i], facing[i], 0, 0}, b.lz[i], b.vz[i]);
        b.f_cos[i] = least(b.lz[i], b.vz[i]) > 0 ? f_cos : 0.0f;
    }
}

template <std::size_t kSize>
inline void evaluate_some(const DiskTable &table, float f0, const glm::vec3 *to_light,
                          const glm::vec3 *to_viewer, float *f_cos, std::size_t count) {
    Block<kSize> b;
    if (count < kSize)
        b = {};
    for (std::size_t i = 0; i < count; ++i) {
        b.lx[i] = to_light[i].x, b.ly[i] = to_light[i].y, b.lz[i] = to_light[i].z;
        b.vx[i] = to_viewer[i].x, b.vy[i] = to_viewer[i].y, b.vz[i] = to_viewer[i].z;
    }
    evaluate_block(table, f0, b);
    std::copy_n(b.f_cos, count, f_cos);
}

} // namespace

TSUYA_FOR_EVERY_PROCESSOR
Evaluated evaluate(const DiskTable &table, float f0, const glm::vec3 &to_light,
                   const glm::vec3 &to_viewer) {
    const Pair p =
        pair_of(to_light.x, to_light.y, to_light.z, to_viewer.x, to_viewer.y, to_viewer.z);
    return {times_cosine(table.at_disk(p.x, p.y), f0, p, to_light.z, to_viewer.z), p.k, p.half_x,
            p.half_y};
}

TSUYA_FOR_EVERY_PROCESSOR
void evaluate(const DiskTable &table, float f0, const glm::vec3 *to_light,
              const glm::vec3 *to_viewer, float *f_cos, std::size_t count) {
    std::size_t done = 0;
    for (; done + kNarrow < count; done += kWide)
        evaluate_some<kWide>(table, f0, to_light + done, to_viewer + done, f_cos + done,
                             std::min(kWide, count - done));
    if (done < count)
        evaluate_some<kNarrow>(table, f0, to_light + done, to_viewer + done, f_cos + done,
                               count - done);
}

} // namespace tsuya::kernel
