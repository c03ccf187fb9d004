#include "tsuya/garment/subdivide.h"

#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <shared_mutex>

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "edges.h"
#include "fans.h"
#include "limit_numbering.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

constexpr int kMaxLevel = 8;
/// Where Bfr stops refining about an extraordinary vertex and closes the surface with a patch that
/// only approximates it. The normal there errs by some 0.01 at level 2, 0.0015 at level 4, whose
/// time is 15 % longer in all.
constexpr int kApproximationLevel = 4;
constexpr double kInfinitelySharp = 10.0; // Sdc::Crease::SHARPNESS_INFINITE

using Factory = Bfr::RefinerSurfaceFactory<Bfr::SurfaceFactoryCacheThreaded<
    std::shared_mutex, std::shared_lock<std::shared_mutex>, std::unique_lock<std::shared_mutex>>>;
using Refiner = std::unique_ptr<Far::TopologyRefiner>;

Sdc::SchemeType choose_scheme(const PolygonMesh &mesh, Scheme scheme) {
    std::size_t other = mesh.face_count();
    for (std::size_t f = mesh.face_count(); f-- > 0;)
        if (mesh.face_size(f) != 3)
            other = f;
    const bool triangles = other == mesh.face_count();
    if (scheme == Scheme::loop && !triangles)
        throw Error({"the Loop scheme needs triangles and face " + std::to_string(other) + " has " +
                         std::to_string(mesh.face_size(other)) + " corners",
                     "subdivide.scheme", "expected catmark or automatic"});
    const bool loop = scheme == Scheme::loop || (scheme == Scheme::automatic && triangles);
    return loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
}

void check_input(const PolygonMesh &mesh, const SubdivideOptions &options) {
    if (options.level < 0 || options.level > kMaxLevel)
        throw Error({"level " + std::to_string(options.level) + " is out of range",
                     "subdivide.level", "expected 0 to 8"});
    if (!(options.seam_crease >= 0.0 && options.seam_crease <= kInfinitelySharp))
        throw Error({"crease " + std::to_string(options.seam_crease) + " is out of range",
                     "subdivide.seam_crease", "expected 0 to 10"});
    std::vector<std::uint32_t> valence(mesh.position.size(), 0);
    for (const std::uint32_t v : mesh.corner_position)
        if (++valence[v] >= kMaxValence)
            throw Error({"vertex " + std::to_string(v) + " joins too many faces", "mesh",
                         "expected fewer than " + std::to_string(kMaxValence)});
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_size(f) >= kMaxValence)
            throw Error({"face " + std::to_string(f) + " has " + std::to_string(mesh.face_size(f)) +
                             " corners",
                         "mesh", "expected fewer than " + std::to_string(kMaxValence)});
}

/// Ends of edges where the UVs or panels of the two sides part.
std::vector<Far::Index> seam_edges(const PolygonMesh &mesh) {
    std::vector<Far::Index> ends;
    EdgeTable(mesh).for_each_edge([&](std::span<const EdgeUse> uses) {
        if (uses.size() != 2)
            return;
        const EdgeUse &a = uses[0], &b = uses[1];
        if (uv_at(mesh, a, a.low) == uv_at(mesh, b, b.low) &&
            uv_at(mesh, a, a.high) == uv_at(mesh, b, b.high))
            return;
        ends.push_back(static_cast<Far::Index>(a.low));
        ends.push_back(static_cast<Far::Index>(a.high));
    });
    return ends;
}

Refiner make_refiner(const PolygonMesh &mesh, const SubdivideOptions &options,
                     Sdc::SchemeType scheme) {
    std::vector<int> sizes(mesh.face_count());
    for (std::size_t f = 0; f < sizes.size(); ++f)
        sizes[f] = static_cast<int>(mesh.face_size(f));
    const std::vector<int> vertices(mesh.corner_position.begin(), mesh.corner_position.end());
    std::vector<int> uvs(mesh.corner_uv.begin(), mesh.corner_uv.end());
    for (int &uv : uvs) // corners without UV share one value behind the others
        uv = uv < 0 ? static_cast<int>(mesh.uv.size()) : uv;
    Far::TopologyDescriptor::FVarChannel channel;
    channel.numValues = static_cast<int>(mesh.uv.size()) + 1;
    channel.valueIndices = uvs.data();
    std::vector<Far::Index> creases;
    if (options.seam_crease > 0)
        creases = seam_edges(mesh);
    const std::vector<float> sharpness(creases.size() / 2, static_cast<float>(options.seam_crease));

    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = static_cast<int>(mesh.position.size());
    descriptor.numFaces = static_cast<int>(sizes.size());
    descriptor.numVertsPerFace = sizes.data();
    descriptor.vertIndicesPerFace = vertices.data();
    descriptor.numCreases = static_cast<int>(sharpness.size());
    descriptor.creaseVertexIndexPairs = creases.data();
    descriptor.creaseWeights = sharpness.data();
    descriptor.numFVarChannels = mesh.uv.empty() ? 0 : 1;
    descriptor.fvarChannels = &channel;

    Sdc::Options sdc;
    sdc.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    sdc.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_BOUNDARIES);
    using RefinerFactory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    Refiner refiner(RefinerFactory::Create(descriptor, RefinerFactory::Options(scheme, sdc)));
    if (!refiner)
        throw Error({"OpenSubdiv refuses the topology of the mesh", "mesh",
                     "expected a manifold mesh, see make_manifold"});
    return refiner;
}

glm::dvec3 centre_of(const PolygonMesh &mesh) {
    glm::dvec3 lower = mesh.position.front(), upper = lower;
    for (const glm::dvec3 &p : mesh.position) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    return 0.5 * (lower + upper);
}

/// Position and derivatives at one point of one face.
struct Sample {
    glm::dvec3 p, p_u, p_v;
    glm::dvec2 t{0.0}, t_u{0.0}, t_v{0.0};

    /// False where the tangents enclose no area.
    bool normal(glm::dvec3 &n) const {
        // Squared sine of the angle between the tangents below which they count as parallel.
        constexpr double kParallel = 1e-16;
        n = glm::cross(p_u, p_v);
        const double length2 = glm::dot(n, n);
        if (!(length2 > kParallel * glm::dot(p_u, p_u) * glm::dot(p_v, p_v)) || !(length2 > 0.0))
            return false;
        n /= std::sqrt(length2);
        return true;
    }
};

/// Evaluates the faces of one mesh; one Scratch a thread.
class FaceEvaluator {
  public:
    struct Scratch {
        Bfr::Surface<double> surface, uv_surface;
        std::vector<double> points, uv_points;
        std::vector<std::uint32_t> vertices;
        std::size_t repaired_normals = 0;
    };

    FaceEvaluator(const PolygonMesh &mesh, const Factory &factory, LimitMesh &out)
        : mesh_(mesh), factory_(factory), out_(out), centre_(centre_of(mesh)) {
        for (const glm::dvec3 &p : mesh.position)
            relative_.push_back(p - centre_);
        uv_ = mesh.uv;
        uv_.emplace_back(0.0); // of corners without UV
    }

    void prepare(std::size_t face, Scratch &s) const {
        const int count = mesh_.uv.empty() ? 0 : 1;
        if (!factory_.InitSurfaces(static_cast<int>(face), &s.surface,
                                   count ? &s.uv_surface : nullptr, nullptr, count))
            throw Error({"face " + std::to_string(face) + " has no limit surface", "mesh",
                         "expected a manifold mesh, see make_manifold"});
        s.points.resize(3 * static_cast<std::size_t>(s.surface.GetNumPatchPoints()));
        s.surface.PreparePatchPoints(&relative_[0].x, 3, s.points.data(), 3);
        if (count) {
            s.uv_points.resize(2 * static_cast<std::size_t>(s.uv_surface.GetNumPatchPoints()));
            s.uv_surface.PreparePatchPoints(&uv_[0].x, 2, s.uv_points.data(), 2);
        }
    }

    void evaluate(std::size_t face, const glm::dvec2 &at, std::uint32_t vertex, Scratch &s) const {
        Sample sample = sample_at(at, s);
        out_.position[vertex] = centre_ + sample.p;
        if (!out_.uv.empty())
            out_.uv[vertex] = glm::vec2(sample.t);
        glm::dvec3 n;
        if (!sample.normal(n)) {
            // Tangents vanish at a cusp or pole: look a little further inside the face.
            ++s.repaired_normals;
            sample = sample_at(nudged(at, s), s);
            if (!sample.normal(n))
                n = any_normal(face);
        }
        out_.normal[vertex] = glm::vec3(n);
        out_.panel[vertex] = mesh_.face_panel[face];
        if (!out_.uv.empty() && has_uv(mesh_, face))
            set_derivatives(sample, vertex);
    }

  private:
    Sample sample_at(const glm::dvec2 &at, const Scratch &s) const {
        Sample r;
        s.surface.Evaluate(&at.x, s.points.data(), 3, &r.p.x, &r.p_u.x, &r.p_v.x);
        if (!mesh_.uv.empty())
            s.uv_surface.Evaluate(&at.x, s.uv_points.data(), 2, &r.t.x, &r.t_u.x, &r.t_v.x);
        return r;
    }

    /// Normal of the control face; z where that has no area.
    glm::dvec3 any_normal(std::size_t face) const {
        double area = 0.0;
        const glm::dvec3 n = face_normal(mesh_, face, area);
        return area > 0.0 ? n : glm::dvec3(0, 0, 1);
    }

    glm::dvec2 nudged(const glm::dvec2 &at, const Scratch &s) const {
        constexpr double kNudge = 1e-3; // of the face
        const Bfr::Parameterization p = s.surface.GetParameterization();
        glm::dvec2 local = at, centre(0.5), moved;
        if (p.HasSubFaces()) {
            const int sub_face = p.ConvertCoordToNormalizedSubFace(&at.x, &local.x);
            local += kNudge * (centre - local);
            p.ConvertNormalizedSubFaceToCoord(sub_face, &local.x, &moved.x);
            return moved;
        }
        p.GetCenterCoord(&centre.x);
        return at + kNudge * (centre - at);
    }

    /// The chain rule through the face's own coordinates, which are Bfr's. [Bfr] Parameterization
    void set_derivatives(const Sample &s, std::uint32_t vertex) const {
        // Determinant over the squared size of the derivatives below which a UV has no area.
        constexpr double kDegenerate = 1e-6;
        const double det = s.t_u.x * s.t_v.y - s.t_u.y * s.t_v.x;
        const double size2 = glm::dot(s.t_u, s.t_u) + glm::dot(s.t_v, s.t_v);
        if (!(std::abs(det) > kDegenerate * size2))
            return;
        out_.dp_du[vertex] = glm::vec3((s.p_u * s.t_v.y - s.p_v * s.t_u.y) / det);
        out_.dp_dv[vertex] = glm::vec3((s.p_v * s.t_u.x - s.p_u * s.t_v.x) / det);
    }

    const PolygonMesh &mesh_;
    const Factory &factory_;
    LimitMesh &out_;
    glm::dvec3 centre_;
    std::vector<glm::dvec3> relative_;
    std::vector<glm::dvec2> uv_;
};

void allocate(LimitMesh &out, std::size_t vertices, bool with_uv) {
    out.position.resize(vertices);
    out.normal.resize(vertices);
    out.panel.resize(vertices);
    if (with_uv) {
        out.uv.resize(vertices);
        out.dp_du.assign(vertices, glm::vec3(0.0f));
        out.dp_dv.assign(vertices, glm::vec3(0.0f));
    }
}

} // namespace

LimitMesh subdivide(const PolygonMesh &mesh, const SubdivideOptions &options,
                    const Progress &progress) {
    check_indices(mesh, "mesh");
    check_input(mesh, options);
    const Sdc::SchemeType scheme = choose_scheme(mesh, options.scheme);
    const Refiner refiner = make_refiner(mesh, options, scheme);
    const int rate = 1 << options.level;
    const auto patterns = make_patterns(mesh, scheme, rate);
    const LimitNumbering numbering(mesh, *refiner, patterns, rate);
    Factory::Options factory_options;
    factory_options.SetApproxLevelSmooth(kApproximationLevel);
    const Factory factory(*refiner, factory_options);

    LimitMesh out;
    allocate(out, numbering.place().size(), !mesh.uv.empty());
    out.place = numbering.place();
    out.panel_name = mesh.panel_name;
    std::vector<std::size_t> first_triangle{0};
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        first_triangle.push_back(first_triangle.back() +
                                 patterns.at(mesh.face_size(f)).triangle.size());
    out.triangle.resize(first_triangle.back());
    out.triangle_panel.resize(first_triangle.back());

    // Every face evaluates the vertices that were numbered with it, and writes its triangles.
    const FaceEvaluator evaluator(mesh, factory, out);
    tbb::enumerable_thread_specific<FaceEvaluator::Scratch> scratches;
    progress("subdivide", 0.0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.face_count(), 64), [&](auto range) {
        FaceEvaluator::Scratch &scratch = scratches.local();
        for (std::size_t f = range.begin(); f != range.end() && !progress.stopped(); ++f) {
            const FacePattern &pattern = patterns.at(mesh.face_size(f));
            numbering.face_vertices(f, pattern.interior_count, scratch.vertices);
            evaluator.prepare(f, scratch);
            for (std::size_t i = 0; i < scratch.vertices.size(); ++i)
                if (scratch.vertices[i] >= numbering.face_first()[f])
                    evaluator.evaluate(f, pattern.coordinate[i], scratch.vertices[i], scratch);
            for (std::size_t i = 0; i < pattern.triangle.size(); ++i) {
                const glm::uvec3 t = pattern.triangle[i];
                out.triangle[first_triangle[f] + i] = {scratch.vertices[t.x], scratch.vertices[t.y],
                                                       scratch.vertices[t.z]};
                out.triangle_panel[first_triangle[f] + i] = mesh.face_panel[f];
            }
        }
    });
    if (progress.stopped())
        throw Interrupted("stopped while subdividing");
    for (const auto &scratch : scratches)
        out.repaired_normals += scratch.repaired_normals;

    // Both sides of a seam take the position of the first, so that no crack can open.
    for (std::size_t v = 0; v < out.place.size(); ++v) {
        out.position[v] = out.position[out.place[v]];
        if (options.seam_crease < kInfinitelySharp)
            out.normal[v] = out.normal[out.place[v]];
    }
    progress("subdivide", 1.0);
    return out;
}

} // namespace tsuya::garment
