#include "limit/limit_masks.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya::garment {
namespace {

// After one step all faces are quads, and the mask is that of the vertex, the edges' points and the
// old faces' points; the eigenvectors are w of the edges' points, and those of the faces' points
// are theirs over 4 lambda - 1. [CatmullClark]
void mask_of_quads(const PolygonMesh &mesh, const Ring &ring, std::vector<MaskWeight> &weights) {
    const auto n = static_cast<double>(ring.size());
    const double theta = 2.0 * kPi / n;
    const double face_scale = 1.0 / (4.0 * catmark_eigenvalue(theta) - 1.0);
    const double whole = n * (n + 5.0);
    weights.push_back({ring.corner[0], (n - 1.0) * n / whole, glm::dvec2(0.0)});
    glm::dvec2 spoke(1.0, 0.0);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const double angle = theta * static_cast<double>(i + 1);
        const glm::dvec2 next(std::cos(angle), std::sin(angle));
        // An edge's point is the mean of its ends and of the points of both faces. The shares of
        // the vertex in the tangents add up to 0.
        weights.push_back({ring.spoke(mesh, i), 2.0 / whole, spoke});
        const double share = 1.0 / static_cast<double>(mesh.face_size(ring.face[i]));
        const MaskWeight face{0, 4.0 / whole * share, share * (1.0 + face_scale) * (spoke + next)};
        for (std::uint32_t c = mesh.face_offset[ring.face[i]];
             c < mesh.face_offset[ring.face[i] + 1]; ++c)
            weights.push_back({c, face.position, face.tangents});
        spoke = next;
    }
}

void mask_of_triangles(const PolygonMesh &mesh, const Ring &ring,
                       std::vector<MaskWeight> &weights) {
    const auto n = static_cast<double>(ring.size());
    const double theta = 2.0 * kPi / n;
    const double root = 0.375 + 0.25 * std::cos(theta); // [LoopScheme]
    const double own = 0.375 * n / (0.625 - root * root);
    weights.push_back({ring.corner[0], own / (own + n), glm::dvec2(0.0)});
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const double angle = theta * static_cast<double>(i);
        weights.push_back(
            {ring.spoke(mesh, i), 1.0 / (own + n), {std::cos(angle), std::sin(angle)}});
    }
}

} // namespace

double catmark_eigenvalue(double theta) {
    const double c = std::cos(theta);
    return (5.0 + c + std::cos(0.5 * theta) * std::sqrt(2.0 * (9.0 + c))) / 16.0;
}

void Ring::set(const LimitSurface &surface, int vertex) {
    const auto faces = surface.topology().GetVertexFaces(vertex);
    const auto locals = surface.topology().GetVertexFaceLocalIndices(vertex);
    face.clear();
    corner.clear();
    for (int i = 0; i < faces.size(); ++i) {
        face.push_back(static_cast<std::size_t>(faces[i]));
        corner.push_back(surface.mesh().face_offset[face.back()] + locals[i]);
    }
}

bool Ring::has_whole_uv(const PolygonMesh &mesh) const {
    for (std::size_t i = 0; i < size(); ++i) {
        const std::size_t after = (i + 1) % size();
        if (!has_uv(mesh, face[i]) || mesh.corner_uv[corner[i]] != mesh.corner_uv[corner[after]] ||
            mesh.corner_uv[mesh.previous(face[i], corner[i])] != mesh.corner_uv[spoke(mesh, after)])
            return false;
    }
    return true;
}

void mask_inside(const LimitSurface &surface, const Ring &ring, std::vector<MaskWeight> &weights) {
    if (surface.scheme() == OpenSubdiv::Sdc::SCHEME_LOOP)
        mask_of_triangles(surface.mesh(), ring, weights);
    else
        mask_of_quads(surface.mesh(), ring, weights);
}

bool has_crease(const OpenSubdiv::Far::TopologyLevel &level, int vertex) {
    const auto edges = level.GetVertexEdges(vertex);
    return std::any_of(edges.begin(), edges.end(), [&](int e) {
        return !level.IsEdgeBoundary(e) && level.GetEdgeSharpness(e) > 0.0f;
    });
}

std::optional<LimitSample> LimitMasks::sample(const LimitSurface &surface, int vertex) {
    const auto &level = surface.topology();
    const PolygonMesh &mesh = surface.mesh();
    constexpr int kLeastFaces = 3; // two have no tangent plane
    if (level.IsVertexBoundary(vertex) || level.IsVertexNonManifold(vertex) ||
        level.GetVertexSharpness(vertex) > 0.0f ||
        level.GetVertexFaces(vertex).size() < kLeastFaces || has_crease(level, vertex))
        return std::nullopt;
    ring_.set(surface, vertex);
    const bool with_uv = !mesh.uv.empty();
    if (with_uv && !ring_.has_whole_uv(mesh))
        return std::nullopt;
    weights_.clear();
    mask_inside(surface, ring_, weights_);
    LimitSample sample{.p = glm::dvec3(0.0), .p_u = glm::dvec3(0.0), .p_v = glm::dvec3(0.0)};
    for (const MaskWeight &w : weights_) {
        const glm::dvec3 p = surface.relative(mesh.corner_position[w.corner]);
        sample.p += w.position * p;
        sample.p_u += w.tangents.x * p;
        sample.p_v += w.tangents.y * p;
        if (!with_uv)
            continue;
        const glm::dvec2 t = mesh.uv[static_cast<std::size_t>(mesh.corner_uv[w.corner])];
        sample.t += w.position * t;
        sample.t_u += w.tangents.x * t;
        sample.t_v += w.tangents.y * t;
    }
    sample.cloth_u = sample.p_u;
    sample.cloth_v = sample.p_v;
    return sample;
}

} // namespace tsuya::garment
