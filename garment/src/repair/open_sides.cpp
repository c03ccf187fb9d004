#include "repair/open_sides.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "repair/vertex_set.h"

namespace tsuya::garment {

OpenSides::OpenSides(const PolygonMesh &mesh, const EdgeTable &edges, double reach)
    : mesh_(mesh), sides_(collect(edges)), by_end_(sides_.size()), grid_(make_grid(reach)) {
    std::iota(by_end_.begin(), by_end_.end(), 0u);
    std::sort(by_end_.begin(), by_end_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::tie(sides_[a].to, a) < std::tie(sides_[b].to, b);
    });
    for (std::size_t i = 0; i < sides_.size(); ++i) {
        vertices_.push_back(sides_[i].from);
        vertices_.push_back(sides_[by_end_[i]].to);
    }
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
}

std::vector<OpenSide> OpenSides::collect(const EdgeTable &edges) {
    std::vector<OpenSide> sides;
    edges.for_each_edge([&](std::span<const EdgeUse> uses) {
        const EdgeUse &use = uses[0];
        if (uses.size() == 1)
            sides.push_back({use.forward ? use.low : use.high, use.forward ? use.high : use.low,
                             use.face, use.corner});
    });
    std::sort(sides.begin(), sides.end(), [](const OpenSide &a, const OpenSide &b) {
        return std::tie(a.from, a.corner) < std::tie(b.from, b.corner);
    });
    return sides;
}

PlaceGrid OpenSides::make_grid(double reach) const {
    double sum = 0.0;
    for (const OpenSide &side : sides_)
        sum += glm::distance(start(side), end(side));
    const double mean = sides_.empty() ? 1.0 : sum / static_cast<double>(sides_.size());
    const double cell = std::max({mean, 2.0 * reach, 1e-300});
    return PlaceGrid(bounds(mesh_).lower, cell, [&](auto &&insert) {
        for (std::uint32_t i = 0; i < sides_.size(); ++i) {
            // In pieces of a cell's size: the box of a long edge would hold very many cells.
            const glm::dvec3 a = start(sides_[i]), b = end(sides_[i]);
            const double pieces = std::max(1.0, std::ceil(glm::distance(a, b) / cell));
            for (double k = 0.0; k < pieces; ++k) {
                const glm::dvec3 p = a + k / pieces * (b - a), q = a + (k + 1.0) / pieces * (b - a);
                insert(i, glm::min(p, q) - reach, glm::max(p, q) + reach);
            }
        }
    });
}

bool OpenSides::face_has(const OpenSide &side, std::uint32_t v) const {
    const auto first = mesh_.corner_position.begin() + mesh_.face_offset[side.face];
    const auto last = mesh_.corner_position.begin() + mesh_.face_offset[side.face + 1];
    return std::find(first, last, v) != last;
}

Contact OpenSides::contact(std::uint32_t vertex, const OpenSide &side, double tolerance) const {
    // The side as it is seen from the vertex: from an end, or from between
    std::vector<RimEdge> own, seen;
    const glm::dvec3 &p = mesh_.position[vertex];
    if (glm::distance(p, end(side)) > tolerance)
        seen.push_back(rim_edge(mesh_, side.face, side.corner, true));
    if (glm::distance(p, start(side)) > tolerance)
        seen.push_back(rim_edge(mesh_, side.face, side.corner, false));
    const auto from = [&](const OpenSide &s, std::uint32_t v) { return s.from < v; };
    for (auto s = std::lower_bound(sides_.begin(), sides_.end(), vertex, from);
         s != sides_.end() && s->from == vertex; ++s)
        own.push_back(rim_edge(mesh_, s->face, s->corner, true));
    const auto to = [&](std::uint32_t s, std::uint32_t v) { return sides_[s].to < v; };
    for (auto s = std::lower_bound(by_end_.begin(), by_end_.end(), vertex, to);
         s != by_end_.end() && sides_[*s].to == vertex; ++s)
        own.push_back(rim_edge(mesh_, sides_[*s].face, sides_[*s].corner, false));
    return contact_of(own, seen);
}

} // namespace tsuya::garment
