#include "tsuya/garment/subdivide.h"

#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "limit/limit_corners.h"
#include "limit/limit_numbering.h"
#include "limit/limit_stencils.h"
#include "limit/limit_surface.h"
#include "limit/tessellation_rates.h"
#include "mesh/face_plane.h"
#include "mesh/stop.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// What a thread needs.
struct Worker {
    LimitSurface::Scratch scratch;
    LimitMasks masks;
    std::vector<std::uint32_t> vertices;
    std::size_t repaired_normals = 0;
};

} // namespace

struct Subdivider::State {
    State(PolygonMesh given, const SubdivideOptions &options, const Progress &progress)
        : mesh(std::move(given)), crease(options.seam_crease), surface(mesh, options, progress),
          rates(choose_rates(surface, options, progress)), patterns(surface, rates, progress),
          numbering(surface, patterns, rates, progress), corners(surface, numbering, progress) {
        rates = {}; // the patterns have them
        const std::size_t vertices = numbering.place().size();
        fixed.place = numbering.place();
        fixed.panel_name = mesh.panel_name;
        fixed.panel.resize(vertices);
        if (!mesh.uv.empty())
            fixed.uv.resize(vertices);
        std::size_t triangles = 0;
        for (std::size_t f = 0; f < mesh.face_count(); ++f)
            triangles += patterns.of(f).triangle.size();
        fixed.triangle.reserve(triangles);
        fixed.triangle_panel.reserve(triangles);
        std::vector<std::uint32_t> numbers;
        for (std::size_t f = 0; f < mesh.face_count(); ++f) {
            look_at_stop(progress, f);
            const FacePattern &pattern = patterns.of(f);
            numbering.face_vertices(f, pattern.interior_count, numbers);
            for (const glm::uvec3 &t : pattern.triangle) {
                fixed.triangle.emplace_back(numbers[t.x], numbers[t.y], numbers[t.z]);
                fixed.triangle_panel.push_back(mesh.face_panel[f]);
            }
        }
    }

    /// Evaluates the vertices that were numbered with a face.
    void evaluate_face(std::size_t face, LimitMesh &out, Worker &worker) const {
        const FacePattern &pattern = patterns.of(face);
        numbering.face_vertices(face, pattern.interior_count, worker.vertices);
        // Where edges are not cut, control vertices alone are wanted, and most need no patches.
        const std::size_t size = mesh.face_size(face);
        const bool uncut = worker.vertices.size() == size + pattern.interior_count;
        bool prepared = false;
        for (std::size_t i = 0; i < worker.vertices.size(); ++i) {
            const std::uint32_t vertex = worker.vertices[i];
            if (vertex < numbering.face_first()[face] ||
                (uncut && i < size && evaluate_corner(face, i, vertex, out, worker)))
                continue;
            if (!std::exchange(prepared, true))
                surface.prepare(face, worker.scratch);
            evaluate_vertex(face, pattern.coordinate[i], vertex, out, worker);
        }
    }

    /// Evaluates a control vertex by its mask; false where there is none.
    bool evaluate_corner(std::size_t face, std::size_t corner, std::uint32_t vertex, LimitMesh &out,
                         Worker &worker) const {
        const std::uint32_t control = mesh.corner_position[mesh.face_offset[face] + corner];
        const auto sample = worker.masks.sample(surface, static_cast<int>(control));
        const bool has_uv = !mesh.uv.empty();
        glm::dvec3 n, dp_du, dp_dv;
        if (!sample || !sample->normal(n) || (has_uv && !sample->cloth(dp_du, dp_dv)))
            return false;
        store(*sample, n, has_uv, face, vertex, out);
        return true;
    }

    void store(const LimitSample &sample, const glm::dvec3 &normal, bool has_uv, std::size_t face,
               std::uint32_t vertex, LimitMesh &out) const {
        glm::dvec3 dp_du, dp_dv;
        out.position[vertex] = surface.centre() + sample.p;
        if (!out.uv.empty())
            out.uv[vertex] = glm::vec2(sample.t);
        out.normal[vertex] = glm::vec3(normal);
        out.panel[vertex] = mesh.face_panel[face];
        if (has_uv && sample.cloth(dp_du, dp_dv)) {
            out.dp_du[vertex] = glm::vec3(dp_du);
            out.dp_dv[vertex] = glm::vec3(dp_dv);
        }
    }

    void evaluate_vertex(std::size_t face, const glm::dvec2 &at, std::uint32_t vertex,
                         LimitMesh &out, Worker &worker) const {
        LimitSample sample = surface.sample(at, worker.scratch);
        glm::dvec3 n, dp_du, dp_dv;
        const bool has_uv = worker.scratch.has_uv;
        const bool has_normal = sample.normal(n);
        if (!has_normal || (has_uv && !sample.cloth(dp_du, dp_dv))) {
            // Tangents vanish at a cusp or pole, and UVs at a T-junction, whose corner is straight:
            // look a little further inside the face.
            worker.repaired_normals += !has_normal;
            const glm::dvec3 p = sample.p;
            const glm::dvec2 t = sample.t;
            sample = surface.sample(surface.nudged(at, worker.scratch), worker.scratch);
            sample.p = p;
            sample.t = t;
            if (!sample.normal(n))
                n = any_normal(mesh, face);
        }
        store(sample, n, has_uv, face, vertex, out);
    }

    /// Frames after the first: weighted sums, and what no frame changes, which a mesh of an earlier
    /// frame has already.
    void next_frame(LimitMesh &out, const Progress &progress = {}) {
        if (!stencils) {
            begin_stage(progress, "subdivide: weights");
            stencils.emplace(surface, patterns, numbering, progress);
            first = evaluate(fixed, progress);
            for (std::vector<glm::vec3> *changing : {&first->normal, &first->dp_du, &first->dp_dv})
                changing->clear();
            first->position.clear();
        }
        if (out.place.size() != first->place.size())
            out = *first;
        out.position.resize(out.place.size());
        out.normal.resize(out.place.size());
        out.dp_du.resize(out.uv.size());
        out.dp_dv.resize(out.uv.size());
        stencils->apply(mesh, surface.centre(), out);
        corners.apply(mesh.position, surface.centre(), out);
        close_seams(out);
    }

    /// Both sides of a seam take the position of the first, so that no crack can open.
    void close_seams(LimitMesh &out) const {
        for (std::size_t v = 0; v < out.place.size(); ++v) {
            out.position[v] = out.position[out.place[v]];
            if (crease < kInfinitelySharp)
                out.normal[v] = out.normal[out.place[v]];
        }
    }

    /// \param out what no frame changes
    LimitMesh evaluate(LimitMesh out, const Progress &progress) const {
        const std::size_t vertices = out.place.size();
        out.position.resize(vertices);
        out.normal.resize(vertices);
        out.dp_du.assign(out.uv.size(), glm::vec3(0.0f));
        out.dp_dv.assign(out.uv.size(), glm::vec3(0.0f));
        tbb::enumerable_thread_specific<Worker> workers;
        begin_stage(progress, "subdivide");
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, mesh.face_count(), 64), [&](auto range) {
                for (std::size_t f = range.begin(); f != range.end() && !progress.stopped(); ++f)
                    evaluate_face(f, out, workers.local());
            });
        look_at_stop(progress);
        for (const Worker &worker : workers)
            out.repaired_normals += worker.repaired_normals;
        corners.apply(mesh.position, surface.centre(), out);
        close_seams(out);
        progress("subdivide", 1.0);
        return out;
    }

    PolygonMesh mesh;
    double crease;
    LimitSurface surface;
    TessellationRates rates;
    FacePatterns patterns;
    LimitNumbering numbering;
    LimitCorners corners;
    LimitMesh fixed; ///< what no frame changes
    std::optional<LimitStencils> stencils;
    std::optional<LimitMesh> first; ///< what no frame changes, with UVs
};

Subdivider::Subdivider(PolygonMesh mesh, const SubdivideOptions &options, const Progress &progress)
    : state_(std::make_unique<State>(std::move(mesh), options, progress)) {}
Subdivider::~Subdivider() = default;
Subdivider::Subdivider(Subdivider &&) noexcept = default;
Subdivider &Subdivider::operator=(Subdivider &&) noexcept = default;

LimitMesh Subdivider::evaluate(const Progress &progress) {
    return state_->evaluate(state_->fixed, progress);
}

void Subdivider::expect_frames(const Progress &progress) {
    LimitMesh unused;
    state_->next_frame(unused, progress);
}

LimitMesh Subdivider::evaluate(const std::vector<glm::dvec3> &positions) {
    LimitMesh out;
    evaluate(positions, out);
    return out;
}

void Subdivider::evaluate(const std::vector<glm::dvec3> &positions, LimitMesh &out) {
    if (positions.size() != state_->mesh.position.size())
        throw Error({std::to_string(positions.size()) + " positions for " +
                         std::to_string(state_->mesh.position.size()) + " vertices",
                     "mesh", "expected the topology of the first frame"});
    state_->mesh.position = positions;
    check_indices(state_->mesh, "mesh");
    state_->surface.set_positions(positions);
    state_->next_frame(out);
}

LimitMesh subdivide(PolygonMesh mesh, const SubdivideOptions &options, const Progress &progress) {
    Subdivider::State state(std::move(mesh), options, progress);
    return state.evaluate(std::move(state.fixed), progress);
}

} // namespace tsuya::garment
