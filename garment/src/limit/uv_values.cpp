#include "limit/uv_values.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace tsuya::garment {
namespace {

std::vector<bool> find_cuts(const PolygonMesh &mesh, const std::vector<int> &of_corner) {
    constexpr int kNone = -1;
    std::vector<int> value(mesh.position.size(), kNone);
    std::vector<bool> cut(mesh.position.size(), false), near(mesh.position.size(), false);
    for (std::size_t c = 0; c < of_corner.size(); ++c) {
        int &first = value[mesh.corner_position[c]];
        if (first != kNone && first != of_corner[c])
            cut[mesh.corner_position[c]] = true;
        first = of_corner[c];
    }
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto first = mesh.corner_position.begin() + mesh.face_offset[f];
        const auto last = mesh.corner_position.begin() + mesh.face_offset[f + 1];
        if (std::any_of(first, last, [&](std::uint32_t v) { return cut[v]; }))
            std::for_each(first, last, [&](std::uint32_t v) { near[v] = true; });
    }
    return near;
}

} // namespace

UvValues make_uv_values(const PolygonMesh &mesh) {
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    UvValues values{.of_corner = std::vector<int>(mesh.corner_uv.size()),
                    .uv = mesh.uv,
                    .vertex = std::vector<std::uint32_t>(mesh.uv.size() + 1, kNone),
                    .near_cut = {}};
    values.uv.emplace_back(0.0); // of all corners without UV
    std::map<std::pair<std::uint32_t, std::int32_t>, int> shared;
    for (std::size_t c = 0; c < mesh.corner_uv.size(); ++c) {
        const std::int32_t uv = mesh.corner_uv[c];
        const std::uint32_t v = mesh.corner_position[c];
        if (uv < 0) {
            values.of_corner[c] = static_cast<int>(mesh.uv.size());
            continue;
        }
        std::uint32_t &vertex = values.vertex[static_cast<std::size_t>(uv)];
        if (vertex == kNone)
            vertex = v;
        values.of_corner[c] = uv;
        if (vertex == v)
            continue;
        const auto [it, added] = shared.try_emplace({v, uv}, static_cast<int>(values.uv.size()));
        values.of_corner[c] = it->second;
        if (added) {
            values.uv.push_back(mesh.uv[static_cast<std::size_t>(uv)]);
            values.vertex.push_back(v);
        }
    }
    values.near_cut = find_cuts(mesh, values.of_corner);
    return values;
}

} // namespace tsuya::garment
