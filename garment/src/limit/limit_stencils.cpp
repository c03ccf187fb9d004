#include "limit/limit_stencils.h"

#include <mutex>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "mesh/face_plane.h"
#include "mesh/stop.h"

namespace tsuya::garment {
namespace {

struct Worker {
    LimitSurface::Scratch scratch;
    std::vector<std::uint32_t> vertices;
};

/// The inverse of the UV's derivatives as rows: dP/du = x C_u + y C_v, dP/dv = z C_u + w C_v of the
/// cloth's C_u, C_v.
glm::dvec4 cloth_of(const LimitSample &sample) {
    LimitSample unit = sample; // the chain rule applied to unit derivatives
    unit.cloth_u = {1, 0, 0};
    unit.cloth_v = {0, 1, 0};
    glm::dvec3 dp_du, dp_dv;
    if (!unit.cloth(dp_du, dp_dv))
        return glm::dvec4(0.0);
    return {dp_du.x, dp_du.y, dp_dv.x, dp_dv.y};
}

void add_weighted(double *__restrict sum, const double *__restrict weight, double value,
                  std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
        sum[k] += weight[k] * value;
}

} // namespace

LimitStencils::LimitStencils(const LimitSurface &surface, const FacePatterns &patterns,
                             const LimitNumbering &numbering, const Progress &progress)
    : face_(surface.mesh().face_count()), first_(numbering.face_first()) {
    if (!surface.mesh().uv.empty())
        cloth_.resize(numbering.place().size());
    tbb::enumerable_thread_specific<Worker> workers;
    std::mutex sharing;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, face_.size(), 64), [&](auto range) {
        Worker &worker = workers.local();
        for (std::size_t f = range.begin(); f != range.end() && !progress.stopped(); ++f) {
            if (first_[f] == first_[f + 1])
                continue;
            surface.prepare(f, worker.scratch);
            const FacePattern &pattern = patterns.of(f);
            numbering.face_vertices(f, pattern.interior_count, worker.vertices);
            Face &face = face_[f];
            std::vector<int> control(
                static_cast<std::size_t>(worker.scratch.surface.GetNumControlPoints()));
            worker.scratch.surface.GetControlPointIndices(control.data());
            face.control.assign(control.begin(), control.end());
            if (!worker.scratch.cloth_points.empty())
                face.cloth.assign(worker.scratch.cloth_control.begin(),
                                  worker.scratch.cloth_control.end());
            const std::size_t n = control.size(), m = face.cloth.size();
            const std::size_t count = first_[f + 1] - first_[f];
            Weights weight((3 * n + 2 * m) * count), rows(3 * n), alone(3 * m), unused(n);
            for (std::size_t i = 0; i < worker.vertices.size(); ++i) {
                const std::uint32_t v = worker.vertices[i];
                if (v < first_[f])
                    continue;
                glm::dvec2 at = pattern.coordinate[i];
                double *const w = rows.data();
                worker.scratch.surface.EvaluateStencil(&at.x, w, w + n, w + 2 * n);
                LimitSample sample = surface.sample(at, worker.scratch);
                glm::dvec3 n_unused, u_unused, v_unused;
                if (!sample.normal(n_unused) ||
                    (worker.scratch.has_uv && !sample.cloth(u_unused, v_unused))) {
                    // As Subdivider does: derivatives a little further inside the face.
                    at = surface.nudged(at, worker.scratch);
                    worker.scratch.surface.EvaluateStencil(&at.x, unused.data(), w + n, w + 2 * n);
                    sample = surface.sample(at, worker.scratch);
                }
                if (worker.scratch.has_uv)
                    cloth_[v] = {cloth_of(sample), sample.alone};
                for (std::size_t k = 0; k < 3 * n; ++k)
                    weight[(k % n * 3 + k / n) * count + v - first_[f]] = w[k];
                if (m == 0)
                    continue;
                double *const a = alone.data();
                worker.scratch.uv_surface.EvaluateStencil(&at.x, a, a + m, a + 2 * m);
                for (std::size_t k = 0; k < 2 * m; ++k)
                    weight[(3 * n + k % m * 2 + k / m) * count + v - first_[f]] = a[m + k];
            }
            const std::lock_guard lock(sharing);
            face.weight = &*weights_.insert(std::move(weight)).first;
        }
    });
    look_at_stop(progress);
}

void LimitStencils::apply(const PolygonMesh &mesh, const glm::dvec3 &centre, LimitMesh &out) const {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, face_.size(), 64), [&](auto range) {
        std::vector<double> sums;
        for (std::size_t f = range.begin(); f != range.end(); ++f)
            apply_face(f, mesh, centre, sums, out);
    });
}

void LimitStencils::apply_face(std::size_t f, const PolygonMesh &mesh, const glm::dvec3 &centre,
                               std::vector<double> &sums, LimitMesh &out) const {
    const Face &face = face_[f];
    if (!face.weight)
        return;
    // Sums over the control points of positions, and of both derivatives, side by side: loops of
    // independent sums, which the compiler makes wide.
    const std::size_t count = first_[f + 1] - first_[f], all = (face.cloth.empty() ? 3 : 5) * count;
    sums.assign(3 * all, 0.0);
    double *const x = sums.data(), *const y = x + all, *const z = y + all;
    const double *w = face.weight->data();
    const auto add = [&](const std::vector<std::uint32_t> &controls, std::size_t at,
                         std::size_t row) {
        for (const std::uint32_t control : controls) {
            const glm::dvec3 p = mesh.position[control] - centre;
            add_weighted(x + at, w, p.x, row);
            add_weighted(y + at, w, p.y, row);
            add_weighted(z + at, w, p.z, row);
            w += row;
        }
    };
    add(face.control, 0, 3 * count);
    add(face.cloth, 3 * count, 2 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t v = first_[f] + i, u = count + i, t = u + count;
        const LimitSample sample{
            .p = {x[i], y[i], z[i]}, .p_u = {x[u], y[u], z[u]}, .p_v = {x[t], y[t], z[t]}};
        out.position[v] = centre + sample.p;
        glm::dvec3 normal;
        if (!sample.normal(normal))
            normal = any_normal(mesh, f);
        out.normal[v] = glm::vec3(normal);
        if (cloth_.empty())
            continue;
        const auto &[c, alone] = cloth_[v];
        const std::size_t a = alone ? t + count : u, b = a + count;
        const glm::dvec3 cloth_u(x[a], y[a], z[a]), cloth_v(x[b], y[b], z[b]);
        out.dp_du[v] = glm::vec3(c.x * cloth_u + c.y * cloth_v);
        out.dp_dv[v] = glm::vec3(c.z * cloth_u + c.w * cloth_v);
    }
}

} // namespace tsuya::garment
