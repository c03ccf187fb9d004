#include "limit_numbering.h"

#include <limits>

namespace tsuya::garment {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

} // namespace

std::map<std::uint32_t, FacePattern> make_patterns(const PolygonMesh &mesh,
                                                   OpenSubdiv::Sdc::SchemeType scheme, int rate) {
    namespace Bfr = OpenSubdiv::Bfr;
    std::map<std::uint32_t, FacePattern> patterns;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto [it, added] = patterns.try_emplace(mesh.face_size(f));
        if (!added)
            continue;
        const Bfr::Tessellation tessellation(
            Bfr::Parameterization(scheme, static_cast<int>(it->first)), rate);
        FacePattern &pattern = it->second;
        pattern.coordinate.resize(static_cast<std::size_t>(tessellation.GetNumCoords()));
        tessellation.GetCoords(&pattern.coordinate[0].x);
        std::vector<int> facets(3 * static_cast<std::size_t>(tessellation.GetNumFacets()));
        tessellation.GetFacets(facets.data());
        for (std::size_t i = 0; i < facets.size(); i += 3)
            pattern.triangle.emplace_back(facets[i], facets[i + 1], facets[i + 2]);
        pattern.interior_count = static_cast<std::uint32_t>(tessellation.GetNumInteriorCoords());
    }
    return patterns;
}

LimitNumbering::LimitNumbering(const PolygonMesh &mesh,
                               const OpenSubdiv::Far::TopologyRefiner &refiner,
                               const std::map<std::uint32_t, FacePattern> &patterns, int rate)
    : mesh_(mesh), inner_(static_cast<std::uint32_t>(rate - 1)),
      corner_vertex_(mesh.corner_position.size()), edge_vertex_(mesh.corner_position.size()),
      interior_vertex_(mesh.face_count()) {
    const OpenSubdiv::Far::TopologyLevel &level = refiner.GetLevel(0);
    std::vector<std::uint32_t> vertex_head(mesh.position.size(), kNone);
    std::vector<std::uint32_t> edge_head(static_cast<std::size_t>(level.GetNumEdges()), kNone);
    sides_.reserve(mesh.position.size() + edge_head.size());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const std::uint16_t panel = mesh.face_panel[f];
        const auto edges = level.GetFaceEdges(static_cast<int>(f));
        for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c) {
            const std::uint32_t a = mesh.corner_position[c];
            const std::int32_t uv = mesh.corner_uv[c];
            corner_vertex_[c] = find_or_add(vertex_head[a], {0, uv, uv, panel, kNone}, 1);
            if (inner_ == 0)
                continue;
            const std::uint32_t n = mesh.next(f, c);
            std::int32_t low = uv, high = mesh.corner_uv[n];
            if (a > mesh.corner_position[n])
                std::swap(low, high);
            const int edge = edges[static_cast<int>(c - mesh.face_offset[f])];
            edge_vertex_[c] = find_or_add(edge_head[static_cast<std::size_t>(edge)],
                                          {0, low, high, panel, kNone}, inner_);
        }
        interior_vertex_[f] = static_cast<std::uint32_t>(place_.size());
        for (std::uint32_t i = 0; i < patterns.at(mesh.face_size(f)).interior_count; ++i)
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
        const bool forward = mesh_.corner_position[c] < mesh_.corner_position[mesh_.next(face, c)];
        for (std::uint32_t i = 0; i < inner_; ++i)
            vertices.push_back(edge_vertex_[c] + (forward ? i : inner_ - 1 - i));
    }
    for (std::uint32_t i = 0; i < interior_count; ++i)
        vertices.push_back(interior_vertex_[face] + i);
}

} // namespace tsuya::garment
