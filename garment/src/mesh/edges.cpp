#include "mesh/edges.h"

#include <algorithm>
#include <limits>

namespace tsuya::garment {

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
        std::stable_sort(uses_.begin() + start[v], uses_.begin() + start[v + 1],
                         [](const EdgeUse &a, const EdgeUse &b) { return a.high < b.high; });
}

std::uint32_t find_set(std::vector<std::uint32_t> &parent, std::uint32_t i) {
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

void unite(std::vector<std::uint32_t> &parent, std::uint32_t a, std::uint32_t b) {
    a = find_set(parent, a);
    b = find_set(parent, b);
    if (a < b)
        parent[b] = a;
    else
        parent[a] = b;
}

std::vector<std::uint32_t> number_sets(std::vector<std::uint32_t> &parent, std::uint32_t &count) {
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number(parent.size(), kNone), result(parent.size());
    count = 0;
    for (std::uint32_t i = 0; i < parent.size(); ++i) {
        std::uint32_t &n = number[find_set(parent, i)];
        if (n == kNone)
            n = count++;
        result[i] = n;
    }
    return result;
}

} // namespace tsuya::garment
