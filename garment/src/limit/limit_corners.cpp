#include "limit/limit_corners.h"

#include <algorithm>
#include <cmath>

#include "mesh/stop.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::garment {
namespace {

/// The faces about a vertex, counter-clockwise; those of a hem start at its first edge.
struct Ring {
    std::vector<std::size_t> face;
    std::vector<std::uint32_t> corner; ///< where each face has the vertex

    Ring(const LimitSurface &surface, int vertex) {
        const auto faces = surface.topology().GetVertexFaces(vertex);
        const auto locals = surface.topology().GetVertexFaceLocalIndices(vertex);
        for (int i = 0; i < faces.size(); ++i) {
            face.push_back(static_cast<std::size_t>(faces[i]));
            corner.push_back(surface.mesh().face_offset[face.back()] + locals[i]);
        }
    }
    std::size_t size() const { return face.size(); }
    /// The corner at the far end of the edge that starts face `i`, or that ends the last.
    std::uint32_t spoke(const PolygonMesh &mesh, std::size_t i) const {
        return i < size() ? mesh.next(face[i], corner[i])
                          : mesh.previous(face.back(), corner.back());
    }
};

/// Subdominant eigenvalue of Catmull-Clark for an angle of `theta` between edges. [CatmullClark]
double eigenvalue(double theta) {
    const double c = std::cos(theta);
    return (5.0 + c + std::cos(0.5 * theta) * std::sqrt(2.0 * (9.0 + c))) / 16.0;
}

bool has_crease(const OpenSubdiv::Far::TopologyLevel &level, int vertex) {
    const auto edges = level.GetVertexEdges(vertex);
    return std::any_of(edges.begin(), edges.end(), [&](int e) {
        return !level.IsEdgeBoundary(e) && level.GetEdgeSharpness(e) > 0.0f;
    });
}

} // namespace

LimitCorners::LimitCorners(const LimitSurface &surface, const LimitNumbering &numbering,
                           const Progress &progress)
    : mesh_(surface.mesh()) {
    const auto &level = surface.topology();
    const bool loop = surface.scheme() == OpenSubdiv::Sdc::SCHEME_LOOP;
    for (int v = 0; v < level.GetNumVertices(); ++v) {
        look_at_stop(progress, static_cast<std::size_t>(v));
        const int faces = level.GetVertexFaces(v).size();
        const bool hem = level.IsVertexBoundary(v);
        // A hem's regular vertices have 3 triangles or 2 quads; Bfr is exact at fewer too, and
        // inside of Loop surfaces. Two quads inside have no tangent plane.
        const bool regular = hem ? faces <= (loop ? 3 : 2) : loop || faces == 4 || faces < 3;
        const bool sharp_corner = hem && faces > 1 && level.GetVertexSharpness(v) > 0.0f;
        if (!regular && !sharp_corner && !level.IsVertexNonManifold(v) && !has_crease(level, v))
            add_vertex(surface, numbering, v);
    }
}

void LimitCorners::add_vertex(const LimitSurface &surface, const LimitNumbering &numbering,
                              int vertex) {
    Vertex v;
    if (!surface.topology().IsVertexBoundary(vertex)) {
        inside(surface, vertex, v.weight);
        find_uv_tangents(surface, vertex, v);
    } else if (surface.scheme() == OpenSubdiv::Sdc::SCHEME_LOOP) {
        on_triangle_hem(surface, vertex, v.weight);
    } else {
        on_quad_hem(surface, vertex, v.weight);
    }
    for (const std::uint32_t corner : Ring(surface, vertex).corner)
        v.points.push_back(numbering.corner_vertex(corner));
    std::sort(v.points.begin(), v.points.end());
    v.points.erase(std::unique(v.points.begin(), v.points.end()), v.points.end());
    vertices_.push_back(std::move(v));
}

// The weights are left eigenvectors of the subdivision matrix of the ring after one step, when all
// faces are quads: w of the edges' points, and those of the faces' points, which are theirs over
// 4 lambda - 1. [CatmullClark]
void LimitCorners::inside(const LimitSurface &surface, int vertex, std::vector<Weight> &weight) {
    const PolygonMesh &mesh = surface.mesh();
    const Ring ring(surface, vertex);
    const std::size_t n = ring.size();
    const double theta = 2.0 * kPi / static_cast<double>(n);
    const double face_scale = 1.0 / (4.0 * eigenvalue(theta) - 1.0);
    const auto spoke = [&](std::size_t i) {
        const double angle = theta * static_cast<double>(i);
        return glm::dvec2(std::cos(angle), std::sin(angle));
    };
    for (std::size_t i = 0; i < n; ++i) {
        // An edge's point is the mean of its ends and of the points of both faces.
        weight.push_back({ring.corner[i], spoke(i)});
        weight.push_back({ring.spoke(mesh, i), spoke(i)});
        const glm::dvec2 face = (1.0 + face_scale) * (spoke(i) + spoke(i + 1));
        const double share = 1.0 / mesh.face_size(ring.face[i]);
        for (std::uint32_t c = mesh.face_offset[ring.face[i]];
             c < mesh.face_offset[ring.face[i] + 1]; ++c)
            weight.push_back({c, share * face});
    }
}

// Along the hem, and the eigenvector of waves that vanish on it.
// Differs from OpenSubdiv's limit mask, which is that of [Biermann]'s modified rules.
void LimitCorners::on_quad_hem(const LimitSurface &surface, int vertex,
                               std::vector<Weight> &weight) {
    const PolygonMesh &mesh = surface.mesh();
    const Ring ring(surface, vertex);
    const std::size_t k = ring.size();
    const double theta = kPi / static_cast<double>(k);
    const double lambda = eigenvalue(theta), face_scale = 1.0 / (4.0 * lambda - 1.0);
    const auto spoke = [&](std::size_t i) { return std::sin(theta * static_cast<double>(i)); };
    double sum = 0.0;
    for (std::size_t i = 0; i < k; ++i) {
        const double face = face_scale * (spoke(i) + spoke(i + 1));
        double total = face;
        if (i > 0) {
            sum += 4.0 * spoke(i);
            weight.push_back({ring.corner[i], {0.0, spoke(i)}});
            weight.push_back({ring.spoke(mesh, i), {0.0, spoke(i)}});
            total += spoke(i);
        }
        if (i + 1 < k)
            total += spoke(i + 1);
        sum += face;
        const double share = total / mesh.face_size(ring.face[i]);
        for (std::uint32_t c = mesh.face_offset[ring.face[i]];
             c < mesh.face_offset[ring.face[i] + 1]; ++c)
            weight.push_back({c, {0.0, share}});
    }
    // What is left of the eigenvector: both points on the hem, and the vertex.
    const double side =
        (0.25 * spoke(1) + 0.25 * face_scale * spoke(1) - 0.125 * sum) / (lambda - 0.25);
    const double middle = -2.0 * side - sum;
    // After one step, they are 1/2, 1/2 and 3/4, 1/8, 1/8 of what is here.
    weight.push_back({ring.corner[0], {0.0, side + 0.75 * middle}});
    weight.push_back({ring.spoke(mesh, 0), {0.5, 0.5 * side + 0.125 * middle}});
    weight.push_back({ring.spoke(mesh, k), {-0.5, 0.5 * side + 0.125 * middle}});
}

void LimitCorners::on_triangle_hem(const LimitSurface &surface, int vertex,
                                   std::vector<Weight> &weight) {
    const PolygonMesh &mesh = surface.mesh();
    const Ring ring(surface, vertex);
    const std::size_t k = ring.size();
    const double theta = kPi / static_cast<double>(k);
    const double lambda = 0.375 + 0.25 * std::cos(theta); // [LoopScheme]
    double sum = 0.0;
    for (std::size_t i = 1; i < k; ++i) {
        const double w = std::sin(theta * static_cast<double>(i));
        weight.push_back({ring.spoke(mesh, i), {0.0, w}});
        sum += w;
    }
    const double side = 0.125 * (std::sin(theta) - sum) / (lambda - 0.25);
    weight.push_back({ring.corner[0], {0.0, -2.0 * side - sum}});
    weight.push_back({ring.spoke(mesh, 0), {1.0, side}});
    weight.push_back({ring.spoke(mesh, k), {-1.0, side}});
}

void LimitCorners::find_uv_tangents(const LimitSurface &surface, int vertex, Vertex &out) const {
    const PolygonMesh &mesh = surface.mesh();
    if (mesh.uv.empty())
        return;
    const Ring ring(surface, vertex);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::size_t after = (i + 1) % ring.size();
        const std::uint32_t end = mesh.previous(ring.face[i], ring.corner[i]);
        if (!has_uv(mesh, ring.face[i]) ||
            mesh.corner_uv[ring.corner[i]] != mesh.corner_uv[ring.corner[after]] ||
            mesh.corner_uv[end] != mesh.corner_uv[ring.spoke(mesh, after)])
            return;
    }
    for (const Weight &w : out.weight) {
        const glm::dvec2 t = mesh.uv[static_cast<std::size_t>(mesh.corner_uv[w.corner])];
        out.t_u += w.tangents.x * t;
        out.t_v += w.tangents.y * t;
    }
}

void LimitCorners::apply(const std::vector<glm::dvec3> &positions, const glm::dvec3 &centre,
                         LimitMesh &out) const {
    for (const Vertex &v : vertices_) {
        LimitSample sample{.p = glm::dvec3(0.0),
                           .p_u = glm::dvec3(0.0),
                           .p_v = glm::dvec3(0.0),
                           .t_u = v.t_u,
                           .t_v = v.t_v};
        for (const Weight &w : v.weight) {
            const glm::dvec3 p = positions[mesh_.corner_position[w.corner]] - centre;
            sample.p_u += w.tangents.x * p;
            sample.p_v += w.tangents.y * p;
        }
        glm::dvec3 normal, dp_du, dp_dv;
        if (!sample.normal(normal))
            continue;
        const bool cloth = !out.uv.empty() && sample.cloth(dp_du, dp_dv);
        for (const std::uint32_t point : v.points) {
            out.normal[point] = glm::vec3(normal);
            if (cloth) {
                out.dp_du[point] = glm::vec3(dp_du);
                out.dp_dv[point] = glm::vec3(dp_dv);
            }
        }
    }
}

} // namespace tsuya::garment
