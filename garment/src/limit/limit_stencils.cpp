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

/// The inverse of the UV's derivatives as rows: dP/du = x P_u + y P_v, dP/dv = z P_u + w P_v.
glm::dvec4 cloth_of(const LimitSample &sample) {
    LimitSample unit = sample; // the chain rule applied to unit derivatives
    unit.p_u = {1, 0, 0};
    unit.p_v = {0, 1, 0};
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
            const std::size_t n = control.size(), count = first_[f + 1] - first_[f];
            Weights weight(3 * n * count), rows(3 * n);
            for (std::size_t i = 0; i < worker.vertices.size(); ++i) {
                const std::uint32_t v = worker.vertices[i];
                if (v < first_[f])
                    continue;
                const glm::dvec2 at = pattern.coordinate[i];
                double *const w = rows.data();
                worker.scratch.surface.EvaluateStencil(&at.x, w, w + n, w + 2 * n);
                LimitSample sample = surface.sample(at, worker.scratch);
                glm::dvec3 n_unused, u_unused, v_unused;
                if (!sample.normal(n_unused) ||
                    (worker.scratch.has_uv && !sample.cloth(u_unused, v_unused))) {
                    // As Subdivider does: derivatives a little further inside the face.
                    const glm::dvec2 inside = surface.nudged(at, worker.scratch);
                    std::vector<double> unused(n);
                    worker.scratch.surface.EvaluateStencil(&inside.x, unused.data(), w + n,
                                                           w + 2 * n);
                    sample = surface.sample(inside, worker.scratch);
                }
                if (worker.scratch.has_uv)
                    cloth_[v] = cloth_of(sample);
                for (std::size_t k = 0; k < 3 * n; ++k)
                    weight[(k % n * 3 + k / n) * count + v - first_[f]] = w[k];
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
    const std::size_t count = first_[f + 1] - first_[f], row = 3 * count;
    sums.assign(3 * row, 0.0);
    double *const x = sums.data(), *const y = x + row, *const z = y + row;
    const double *w = face.weight->data();
    for (const std::uint32_t control : face.control) {
        const glm::dvec3 p = mesh.position[control] - centre;
        add_weighted(x, w, p.x, row);
        add_weighted(y, w, p.y, row);
        add_weighted(z, w, p.z, row);
        w += row;
    }
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
        const glm::dvec4 &c = cloth_[v];
        out.dp_du[v] = glm::vec3(c.x * sample.p_u + c.y * sample.p_v);
        out.dp_dv[v] = glm::vec3(c.z * sample.p_u + c.w * sample.p_v);
    }
}

} // namespace tsuya::garment
