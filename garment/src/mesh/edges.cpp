#include "mesh/edges.h"

#include <algorithm>

namespace tsuya::garment {
namespace {

/// Sorts a bucket by the high vertex; sides of one edge keep their order.
void sort_bucket(EdgeUse *first, EdgeUse *last) {
    constexpr std::ptrdiff_t kFew = 16; // most buckets; stable_sort allocates for each
    const auto less = [](const EdgeUse &a, const EdgeUse &b) { return a.high < b.high; };
    if (last - first > kFew) {
        std::stable_sort(first, last, less);
        return;
    }
    for (EdgeUse *at = first; at != last; ++at)
        std::rotate(std::upper_bound(first, at, *at, less), at, at + 1);
}

} // namespace

EdgeTable::EdgeTable(const PolygonMesh &mesh) {
    // Counting sort by the low vertex, then a short sort inside each bucket.
    std::vector<std::uint32_t> start(mesh.position.size() + 1, 0);
    const auto for_each_side = [&](auto &&visit) {
        for (std::size_t f = 0; f < mesh.face_count(); ++f)
            for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c) {
                const std::uint32_t a = mesh.corner_position[c];
                const std::uint32_t b = mesh.corner_position[mesh.next(f, c)];
                visit(EdgeUse{std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(f), c,
                              a < b});
            }
    };
    for_each_side([&](const EdgeUse &use) { ++start[use.low + 1]; });
    for (std::size_t i = 1; i < start.size(); ++i)
        start[i] += start[i - 1];
    uses_.resize(mesh.corner_position.size());
    std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
    for_each_side([&](const EdgeUse &use) { uses_[fill[use.low]++] = use; });
    for (std::size_t v = 0; v + 1 < start.size(); ++v)
        sort_bucket(uses_.data() + start[v], uses_.data() + start[v + 1]);
}

} // namespace tsuya::garment
