#include "limit/limit_corners.h"

#include <algorithm>
#include <cmath>

#include "mesh/stop.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::garment {

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
    const Ring ring(surface, vertex);
    if (!surface.topology().IsVertexBoundary(vertex)) {
        mask_inside(surface, ring, v.weight);
        if (!mesh_.uv.empty() && ring.has_whole_uv(mesh_))
            for (const MaskWeight &w : v.weight) {
                const glm::dvec2 t = mesh_.uv[static_cast<std::size_t>(mesh_.corner_uv[w.corner])];
                v.t_u += w.tangents.x * t;
                v.t_v += w.tangents.y * t;
            }
    } else if (surface.scheme() == OpenSubdiv::Sdc::SCHEME_LOOP) {
        on_triangle_hem(ring, v.weight);
    } else {
        on_quad_hem(ring, v.weight);
    }
    for (const std::uint32_t corner : ring.corner)
        v.points.push_back(numbering.corner_vertex(corner));
    std::sort(v.points.begin(), v.points.end());
    v.points.erase(std::unique(v.points.begin(), v.points.end()), v.points.end());
    vertices_.push_back(std::move(v));
}

// Along the hem, and the eigenvector of waves that vanish on it.
// Differs from OpenSubdiv's limit mask, which is that of [Biermann]'s modified rules.
void LimitCorners::on_quad_hem(const Ring &ring, std::vector<MaskWeight> &weight) const {
    const PolygonMesh &mesh = mesh_;
    const std::size_t k = ring.size();
    const double theta = kPi / static_cast<double>(k);
    const double lambda = catmark_eigenvalue(theta), face_scale = 1.0 / (4.0 * lambda - 1.0);
    const auto spoke = [&](std::size_t i) { return std::sin(theta * static_cast<double>(i)); };
    double sum = 0.0;
    for (std::size_t i = 0; i < k; ++i) {
        const double face = face_scale * (spoke(i) + spoke(i + 1));
        double total = face;
        if (i > 0) {
            sum += 4.0 * spoke(i);
            weight.push_back({ring.corner[i], 0.0, {0.0, spoke(i)}});
            weight.push_back({ring.spoke(mesh, i), 0.0, {0.0, spoke(i)}});
            total += spoke(i);
        }
        if (i + 1 < k)
            total += spoke(i + 1);
        sum += face;
        const double share = total / mesh.face_size(ring.face[i]);
        for (std::uint32_t c = mesh.face_offset[ring.face[i]];
             c < mesh.face_offset[ring.face[i] + 1]; ++c)
            weight.push_back({c, 0.0, {0.0, share}});
    }
    // What is left of the eigenvector: both points on the hem, and the vertex.
    const double side =
        (0.25 * spoke(1) + 0.25 * face_scale * spoke(1) - 0.125 * sum) / (lambda - 0.25);
    const double middle = -2.0 * side - sum;
    // After one step, they are 1/2, 1/2 and 3/4, 1/8, 1/8 of what is here.
    weight.push_back({ring.corner[0], 0.0, {0.0, side + 0.75 * middle}});
    weight.push_back({ring.spoke(mesh, 0), 0.0, {0.5, 0.5 * side + 0.125 * middle}});
    weight.push_back({ring.spoke(mesh, k), 0.0, {-0.5, 0.5 * side + 0.125 * middle}});
}

void LimitCorners::on_triangle_hem(const Ring &ring, std::vector<MaskWeight> &weight) const {
    const PolygonMesh &mesh = mesh_;
    const std::size_t k = ring.size();
    const double theta = kPi / static_cast<double>(k);
    const double lambda = 0.375 + 0.25 * std::cos(theta); // [LoopScheme]
    double sum = 0.0;
    for (std::size_t i = 1; i < k; ++i) {
        const double w = std::sin(theta * static_cast<double>(i));
        weight.push_back({ring.spoke(mesh, i), 0.0, {0.0, w}});
        sum += w;
    }
    const double side = 0.125 * (std::sin(theta) - sum) / (lambda - 0.25);
    weight.push_back({ring.corner[0], 0.0, {0.0, -2.0 * side - sum}});
    weight.push_back({ring.spoke(mesh, 0), 0.0, {1.0, side}});
    weight.push_back({ring.spoke(mesh, k), 0.0, {-1.0, side}});
}

void LimitCorners::apply(const std::vector<glm::dvec3> &positions, const glm::dvec3 &centre,
                         LimitMesh &out) const {
    for (const Vertex &v : vertices_) {
        LimitSample sample{.p = glm::dvec3(0.0),
                           .p_u = glm::dvec3(0.0),
                           .p_v = glm::dvec3(0.0),
                           .t_u = v.t_u,
                           .t_v = v.t_v};
        for (const MaskWeight &w : v.weight) {
            const glm::dvec3 p = positions[mesh_.corner_position[w.corner]] - centre;
            sample.p_u += w.tangents.x * p;
            sample.p_v += w.tangents.y * p;
        }
        sample.cloth_u = sample.p_u;
        sample.cloth_v = sample.p_v;
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
