#include "limit/limit_numbering.h"

#include "mesh/stop.h"

#include <algorithm>
#include <limits>

#include <opensubdiv/bfr/tessellation.h>

namespace tsuya::garment {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// \param rates of the edges, then of the inside
FacePattern make_pattern(OpenSubdiv::Sdc::SchemeType scheme, int corners,
                         const std::vector<int> &rates) {
    namespace Bfr = OpenSubdiv::Bfr;
    const Bfr::Parameterization parameterization(scheme, corners);
    const bool alike =
        std::all_of(rates.begin(), rates.end(), [&](int rate) { return rate == rates.front(); });
    const Bfr::Tessellation tessellation =
        alike ? Bfr::Tessellation(parameterization, rates.front())
              : Bfr::Tessellation(parameterization, static_cast<int>(rates.size()), rates.data());
    FacePattern pattern;
    pattern.coordinate.resize(static_cast<std::size_t>(tessellation.GetNumCoords()));
    tessellation.GetCoords(&pattern.coordinate[0].x);
    std::vector<int> facets(3 * static_cast<std::size_t>(tessellation.GetNumFacets()));
    tessellation.GetFacets(facets.data());
    for (std::size_t i = 0; i < facets.size(); i += 3)
        pattern.triangle.emplace_back(facets[i], facets[i + 1], facets[i + 2]);
    pattern.interior_count = static_cast<std::uint32_t>(tessellation.GetNumInteriorCoords());
    return pattern;
}

} // namespace

FacePatterns::FacePatterns(const LimitSurface &surface, const TessellationRates &rates,
                           const Progress &progress) {
    const PolygonMesh &mesh = surface.mesh();
    std::map<std::vector<int>, std::uint32_t> known;
    std::vector<int> key;
    of_face_.reserve(mesh.face_count());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        look_at_stop(progress, f);
        const auto corners = static_cast<int>(mesh.face_size(f));
        key.assign(1, corners);
        const auto edges = surface.topology().GetFaceEdges(static_cast<int>(f));
        for (int e = 0; e < edges.size(); ++e)
            key.push_back(rates.edge[static_cast<std::size_t>(edges[e])]);
        key.push_back(rates.inner[f].x);
        if (corners == 4)
            key.push_back(rates.inner[f].y);
        const auto [it, added] =
            known.try_emplace(key, static_cast<std::uint32_t>(patterns_.size()));
        if (added)
            patterns_.push_back(
                make_pattern(surface.scheme(), corners, {key.begin() + 1, key.end()}));
        of_face_.push_back(it->second);
    }
}

LimitNumbering::LimitNumbering(const LimitSurface &surface, const FacePatterns &patterns,
                               const TessellationRates &rates, const Progress &progress)
    : mesh_(surface.mesh()), corner_vertex_(mesh_.corner_position.size()),
      interior_vertex_(mesh_.face_count()) {
    const bool cut =
        std::any_of(rates.edge.begin(), rates.edge.end(), [](int rate) { return rate > 1; });
    edge_inner_.resize(cut ? mesh_.corner_position.size() : 0);
    edge_vertex_.resize(edge_inner_.size());
    const PolygonMesh &mesh = mesh_;
    const OpenSubdiv::Far::TopologyLevel &level = surface.topology();
    std::vector<std::uint32_t> vertex_head(mesh.position.size(), kNone);
    std::vector<std::uint32_t> edge_head(static_cast<std::size_t>(level.GetNumEdges()), kNone);
    sides_.reserve(mesh.position.size() + (cut ? edge_head.size() : 0));
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        look_at_stop(progress, f);
        const std::uint32_t panel = mesh.face_panel[f];
        const auto edges = level.GetFaceEdges(static_cast<int>(f));
        for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c) {
            const std::uint32_t a = mesh.corner_position[c];
            const std::int32_t uv = mesh.corner_uv[c];
            corner_vertex_[c] = find_or_add(vertex_head[a], {0, uv, uv, panel, kNone}, 1);
            if (!cut)
                continue;
            const int edge = edges[static_cast<int>(c - mesh.face_offset[f])];
            edge_inner_[c] =
                static_cast<std::uint32_t>(rates.edge[static_cast<std::size_t>(edge)] - 1);
            if (edge_inner_[c] == 0)
                continue;
            const std::uint32_t n = mesh.next(f, c);
            std::int32_t low = uv, high = mesh.corner_uv[n];
            if (a > mesh.corner_position[n])
                std::swap(low, high);
            edge_vertex_[c] = find_or_add(edge_head[static_cast<std::size_t>(edge)],
                                          {0, low, high, panel, kNone}, edge_inner_[c]);
        }
        interior_vertex_[f] = static_cast<std::uint32_t>(place_.size());
        for (std::uint32_t i = 0; i < patterns.of(f).interior_count; ++i)
            place_.push_back(static_cast<std::uint32_t>(place_.size()));
        face_first_.push_back(static_cast<std::uint32_t>(place_.size()));
    }
}

std::uint32_t LimitNumbering::find_or_add(std::uint32_t &head, Side side, std::uint32_t count) {
    std::uint32_t last = kNone;
    for (std::uint32_t i = head; i != kNone; last = i, i = sides_[i].next)
        if (sides_[i].uv_low == side.uv_low && sides_[i].uv_high == side.uv_high &&
            sides_[i].panel == side.panel)
            return sides_[i].vertex;
    side.vertex = static_cast<std::uint32_t>(place_.size());
    const std::uint32_t first = head == kNone ? side.vertex : sides_[head].vertex;
    for (std::uint32_t i = 0; i < count; ++i)
        place_.push_back(first + i);
    (last == kNone ? head : sides_[last].next) = static_cast<std::uint32_t>(sides_.size());
    sides_.push_back(side);
    return side.vertex;
}

void LimitNumbering::face_vertices(std::size_t face, std::uint32_t interior_count,
                                   std::vector<std::uint32_t> &vertices) const {
    vertices.clear();
    for (std::uint32_t c = mesh_.face_offset[face]; c < mesh_.face_offset[face + 1]; ++c) {
        vertices.push_back(corner_vertex_[c]);
        if (edge_inner_.empty())
            continue;
        const bool forward = mesh_.corner_position[c] < mesh_.corner_position[mesh_.next(face, c)];
        const std::uint32_t inner = edge_inner_[c];
        for (std::uint32_t i = 0; i < inner; ++i)
            vertices.push_back(edge_vertex_[c] + (forward ? i : inner - 1 - i));
    }
    for (std::uint32_t i = 0; i < interior_count; ++i)
        vertices.push_back(interior_vertex_[face] + i);
}

} // namespace tsuya::garment
