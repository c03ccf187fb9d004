#include "limit/limit_surface.h"

#include <algorithm>
#include <cmath>

#include <opensubdiv/far/topologyDescriptor.h>

#include "limit/creases.h"
#include "mesh/stop.h"
#include "mesh/valence.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

constexpr int kMaxLevel = 8;
/// Where Bfr stops refining about an extraordinary vertex and closes the surface with a patch that
/// only approximates it. In the middle of a triangle among quads the normal errs by up to 0.01 at
/// level 2, 0.0015 at level 4 and 3e-5 at level 8; vertices have LimitCorners.
constexpr int kApproximationLevel = 8;
constexpr int kSharpApproximationLevel = 10; ///< the same where creases are
/// Sharper edges have a normal for each side, which only seams have room for.
constexpr double kSharpestFold = 9.0;

using Refiner = std::unique_ptr<Far::TopologyRefiner>;

Sdc::SchemeType choose_scheme(const PolygonMesh &mesh, Scheme scheme) {
    std::size_t other = mesh.face_count();
    for (std::size_t f = mesh.face_count(); f-- > 0;)
        if (mesh.face_size(f) != 3)
            other = f;
    const bool triangles = other == mesh.face_count();
    if (scheme == Scheme::loop && !triangles)
        throw Error({"the Loop scheme needs triangles and face " + std::to_string(other) + " has " +
                         detail::counted(mesh.face_size(other), "corner"),
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
    if (!(options.fold_crease >= 0.0 && options.fold_crease <= kSharpestFold))
        throw Error({"crease " + std::to_string(options.fold_crease) + " is out of range",
                     "subdivide.fold_crease", "expected 0 to 9"});
    if (!(options.fold_angle >= 0.0 && options.fold_angle <= kPi))
        throw Error({"angle " + std::to_string(options.fold_angle) + " is out of range",
                     "subdivide.fold_angle", "expected 0 to pi radians"});
    if (options.tolerance && !(*options.tolerance > 0.0 && std::isfinite(*options.tolerance)))
        throw Error({"tolerance " + std::to_string(*options.tolerance) + " is out of range",
                     "subdivide.tolerance", "expected a length in metres above 0"});
    if (options.view && !(options.view->pixels > 0.0 && options.view->camera.height > 0))
        throw Error({"tolerance " + std::to_string(options.view->pixels) + " is out of range",
                     "subdivide.view", "expected pixels above 0"});
    if (options.view && !(options.view->nearest > 0.0))
        throw Error({"distance " + std::to_string(options.view->nearest) + " is out of range",
                     "subdivide.view.nearest", "expected metres above 0"});
    check_valence(mesh);
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_size(f) >= kMaxValence)
            throw Error({"face " + std::to_string(f) + " has " +
                             detail::counted(mesh.face_size(f), "corner"),
                         "mesh", "expected fewer than " + std::to_string(kMaxValence)});
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
    const Creases creases = find_creases(mesh, options);

    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = static_cast<int>(mesh.position.size());
    descriptor.numFaces = static_cast<int>(sizes.size());
    descriptor.numVertsPerFace = sizes.data();
    descriptor.vertIndicesPerFace = vertices.data();
    descriptor.numCreases = static_cast<int>(creases.sharpness.size());
    descriptor.creaseVertexIndexPairs = creases.ends.data();
    descriptor.creaseWeights = creases.sharpness.data();
    const std::vector<float> corner_sharpness(creases.corners.size(),
                                              Sdc::Crease::SHARPNESS_INFINITE);
    descriptor.numCorners = static_cast<int>(creases.corners.size());
    descriptor.cornerVertexIndices = creases.corners.data();
    descriptor.cornerWeights = corner_sharpness.data();
    descriptor.numFVarChannels = mesh.uv.empty() ? 0 : 1;
    descriptor.fvarChannels = &channel;

    Sdc::Options sdc;
    sdc.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    sdc.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_CORNERS_PLUS2);
    using RefinerFactory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    Refiner refiner(RefinerFactory::Create(descriptor, RefinerFactory::Options(scheme, sdc)));
    if (!refiner)
        throw Error({"OpenSubdiv refuses the topology of the mesh", "mesh",
                     "expected a manifold mesh, see make_manifold"});
    return refiner;
}

glm::dvec3 centre_of(const std::vector<glm::dvec3> &positions) {
    glm::dvec3 lower = positions.front(), upper = lower;
    for (const glm::dvec3 &p : positions) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    return 0.5 * (lower + upper);
}

} // namespace

bool LimitSample::cloth(glm::dvec3 &dp_du, glm::dvec3 &dp_dv) const {
    // Determinant over the squared size of the derivatives below which a UV has no area.
    constexpr double kDegenerate = 1e-6;
    const double det = t_u.x * t_v.y - t_u.y * t_v.x;
    const double size2 = glm::dot(t_u, t_u) + glm::dot(t_v, t_v);
    if (!(std::abs(det) > kDegenerate * size2))
        return false;
    // The chain rule through the face's own coordinates, which are Bfr's. [Bfr] Parameterization
    dp_du = (p_u * t_v.y - p_v * t_u.y) / det;
    dp_dv = (p_v * t_u.x - p_u * t_v.x) / det;
    return true;
}

LimitSurface::LimitSurface(const PolygonMesh &mesh, const SubdivideOptions &options,
                           const Progress &progress)
    : mesh_(mesh) {
    begin_stage(progress, "subdivide: topology");
    check_indices(mesh, "mesh");
    check_input(mesh, options);
    scheme_ = choose_scheme(mesh, options.scheme);
    refiner_ = make_refiner(mesh, options, scheme_);
    look_at_stop(progress);
    Factory::Options factory_options;
    factory_options.SetApproxLevelSmooth(kApproximationLevel);
    factory_options.SetApproxLevelSharp(kSharpApproximationLevel);
    factory_ = std::make_unique<Factory>(*refiner_, factory_options);
    set_positions(mesh.position);
    uv_ = mesh.uv;
    uv_.emplace_back(0.0); // of corners without UV
}

void LimitSurface::set_positions(const std::vector<glm::dvec3> &positions) {
    centre_ = centre_of(positions);
    relative_.clear();
    relative_.reserve(positions.size());
    for (const glm::dvec3 &p : positions)
        relative_.push_back(p - centre_);
}

void LimitSurface::prepare(std::size_t face, Scratch &s) const {
    const int count = mesh_.uv.empty() ? 0 : 1;
    if (!factory_->InitSurfaces(static_cast<int>(face), &s.surface, count ? &s.uv_surface : nullptr,
                                nullptr, count))
        throw Error({"face " + std::to_string(face) + " has no limit surface", "mesh",
                     "expected a manifold mesh, see make_manifold"});
    s.points.resize(3 * static_cast<std::size_t>(s.surface.GetNumPatchPoints()));
    s.surface.PreparePatchPoints(&relative_[0].x, 3, s.points.data(), 3);
    if (count) {
        s.uv_points.resize(2 * static_cast<std::size_t>(s.uv_surface.GetNumPatchPoints()));
        s.uv_surface.PreparePatchPoints(&uv_[0].x, 2, s.uv_points.data(), 2);
    }
    s.has_uv = count > 0 && garment::has_uv(mesh_, face);
}

LimitSample LimitSurface::sample(const glm::dvec2 &at, const Scratch &s) const {
    LimitSample r;
    s.surface.Evaluate(&at.x, s.points.data(), 3, &r.p.x, &r.p_u.x, &r.p_v.x);
    if (!mesh_.uv.empty())
        s.uv_surface.Evaluate(&at.x, s.uv_points.data(), 2, &r.t.x, &r.t_u.x, &r.t_v.x);
    return r;
}

glm::dvec3 LimitSurface::point(const glm::dvec2 &at, const Scratch &s) const {
    glm::dvec3 p;
    s.surface.Evaluate(&at.x, s.points.data(), 3, &p.x);
    return p;
}

LimitCurvature LimitSurface::curvature(const glm::dvec2 &at, const Scratch &s) const {
    LimitCurvature c;
    LimitSample r;
    s.surface.Evaluate(&at.x, s.points.data(), 3, &r.p.x, &r.p_u.x, &r.p_v.x, &c.p_uu.x, &c.p_uv.x,
                       &c.p_vv.x);
    if (!r.normal(c.normal))
        c.normal = glm::dvec3(0.0);
    c.p_u = r.p_u;
    c.p_v = r.p_v;
    return c;
}

glm::dvec2 LimitSurface::nudged(const glm::dvec2 &at, const Scratch &s) const {
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

} // namespace tsuya::garment
