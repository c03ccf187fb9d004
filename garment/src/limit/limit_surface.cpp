#include "limit/limit_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opensubdiv/far/topologyDescriptor.h>

#include "limit/creases.h"
#include "limit/uv_values.h"
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
                     Sdc::SchemeType scheme, const UvValues &uvs) {
    std::vector<int> sizes(mesh.face_count());
    for (std::size_t f = 0; f < sizes.size(); ++f)
        sizes[f] = static_cast<int>(mesh.face_size(f));
    const std::vector<int> vertices(mesh.corner_position.begin(), mesh.corner_position.end());
    Far::TopologyDescriptor::FVarChannel channel;
    channel.numValues = static_cast<int>(uvs.uv.size());
    channel.valueIndices = uvs.of_corner.data();
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

/// The middle of a face or of its sub-faces, and what lies about it.
std::vector<glm::dvec2> spread_points(const Bfr::Parameterization &p) {
    std::vector<glm::dvec2> points;
    const int corners = p.GetFaceSize();
    for (int c = 0; c < corners; ++c) {
        glm::dvec2 at;
        if (p.HasSubFaces()) {
            const glm::dvec2 middle(0.5);
            p.ConvertNormalizedSubFaceToCoord(c, &middle.x, &at.x);
        } else {
            constexpr double kInside = 0.05;
            glm::dvec2 corner, centre;
            p.GetVertexCoord(c, &corner.x);
            p.GetCenterCoord(&centre.x);
            at = corner + kInside * (centre - corner);
        }
        points.push_back(at);
    }
    return points;
}

/// Of two derivatives by UV.
double relative_distance(const glm::dmat2x3 &a, const glm::dmat2x3 &b) {
    const glm::dmat2x3 d = a - b;
    const double size2 = glm::dot(b[0], b[0]) + glm::dot(b[1], b[1]);
    return size2 > 0.0 ? std::sqrt((glm::dot(d[0], d[0]) + glm::dot(d[1], d[1])) / size2) : 0.0;
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
    dp_du = (cloth_u * t_v.y - cloth_v * t_u.y) / det;
    dp_dv = (cloth_v * t_u.x - cloth_u * t_v.x) / det;
    return true;
}

LimitSurface::LimitSurface(const PolygonMesh &mesh, const SubdivideOptions &options,
                           const Progress &progress)
    : mesh_(mesh) {
    begin_stage(progress, "subdivide: topology");
    check_indices(mesh, "mesh");
    check_input(mesh, options);
    scheme_ = choose_scheme(mesh, options.scheme);
    UvValues uvs = make_uv_values(mesh);
    refiner_ = make_refiner(mesh, options, scheme_, uvs);
    look_at_stop(progress);
    Factory::Options factory_options;
    factory_options.SetApproxLevelSmooth(kApproximationLevel);
    factory_options.SetApproxLevelSharp(kSharpApproximationLevel);
    factory_ = std::make_unique<Factory>(*refiner_, factory_options);
    set_positions(mesh.position);
    uv_ = std::move(uvs.uv);
    uv_vertex_ = std::move(uvs.vertex);
    near_cut_ = std::move(uvs.near_cut);
}

void LimitSurface::set_positions(const std::vector<glm::dvec3> &positions) {
    centre_ = centre_of(positions);
    relative_.clear();
    relative_.reserve(positions.size());
    for (const glm::dvec3 &p : positions)
        relative_.push_back(p - centre_);
}

void LimitSurface::prepare_positions(std::size_t face, Scratch &s) const {
    init(face, s, false);
    s.uv_points.clear();
    s.cloth_points.clear();
    s.has_uv = false;
}

void LimitSurface::prepare(std::size_t face, Scratch &s) const {
    if (mesh_.uv.empty())
        return prepare_positions(face, s);
    init(face, s, true);
    s.uv_points.resize(2 * static_cast<std::size_t>(s.uv_surface.GetNumPatchPoints()));
    s.uv_surface.PreparePatchPoints(&uv_[0].x, 2, s.uv_points.data(), 2);
    s.has_uv = garment::has_uv(mesh_, face);
    s.cloth_points.clear();
    const auto first = mesh_.corner_position.begin() + mesh_.face_offset[face];
    const auto last = mesh_.corner_position.begin() + mesh_.face_offset[face + 1];
    if (s.has_uv && std::any_of(first, last, [&](std::uint32_t v) { return near_cut_[v]; }))
        prepare_cloth(s);
}

void LimitSurface::init(std::size_t face, Scratch &s, bool with_uv) const {
    if (!factory_->InitSurfaces(static_cast<int>(face), &s.surface,
                                with_uv ? &s.uv_surface : nullptr, nullptr, with_uv ? 1 : 0))
        throw Error({"face " + std::to_string(face) + " has no limit surface", "mesh",
                     "expected a manifold mesh, see make_manifold"});
    s.points.resize(3 * static_cast<std::size_t>(s.surface.GetNumPatchPoints()));
    s.surface.PreparePatchPoints(&relative_[0].x, 3, s.points.data(), 3);
}

void LimitSurface::prepare_cloth(Scratch &s) const {
    s.control.resize(static_cast<std::size_t>(s.surface.GetNumControlPoints()));
    s.surface.GetControlPointIndices(s.control.data());
    s.cloth_control.resize(static_cast<std::size_t>(s.uv_surface.GetNumControlPoints()));
    s.uv_surface.GetControlPointIndices(s.cloth_control.data());
    for (int &value : s.cloth_control)
        value = static_cast<int>(uv_vertex_[static_cast<std::size_t>(value)]);
    if (s.cloth_control == s.control)
        return;
    for (const int v : s.cloth_control) {
        const glm::dvec3 &p = relative_[static_cast<std::size_t>(v)];
        s.cloth_points.insert(s.cloth_points.end(), {p.x, p.y, p.z});
    }
    s.cloth_points.resize(3 * static_cast<std::size_t>(s.uv_surface.GetNumPatchPoints()));
    s.uv_surface.ComputePatchPoints(s.cloth_points.data(), 3);

    // On an even grid what a side errs by is what its derivatives change by over the face.
    constexpr double kRoom = 2.0;
    std::vector<glm::dmat2x3> seen;
    for (const glm::dvec2 &at : spread_points(s.surface.GetParameterization())) {
        LimitSample sample;
        glm::dmat2x3 dp;
        s.uv_surface.Evaluate(&at.x, s.uv_points.data(), 2, &sample.t.x, &sample.t_u.x,
                              &sample.t_v.x);
        if (take_alone(at, s, sample, dp))
            seen.push_back(dp);
    }
    s.one_sided = 0.0;
    for (const glm::dmat2x3 &dp : seen)
        s.one_sided = std::max(s.one_sided, kRoom * relative_distance(dp, seen.front()));
}

bool LimitSurface::take_alone(const glm::dvec2 &at, const Scratch &s, LimitSample &sample,
                              glm::dmat2x3 &dp) {
    glm::dvec3 unused;
    s.uv_surface.Evaluate(&at.x, s.cloth_points.data(), 3, &unused.x, &sample.cloth_u.x,
                          &sample.cloth_v.x);
    return sample.cloth(dp[0], dp[1]);
}

LimitSample LimitSurface::sample(const glm::dvec2 &at, const Scratch &s) const {
    LimitSample r;
    s.surface.Evaluate(&at.x, s.points.data(), 3, &r.p.x, &r.p_u.x, &r.p_v.x);
    if (!s.uv_points.empty())
        s.uv_surface.Evaluate(&at.x, s.uv_points.data(), 2, &r.t.x, &r.t_u.x, &r.t_v.x);
    r.cloth_u = r.p_u;
    r.cloth_v = r.p_v;
    if (s.cloth_points.empty())
        return r;
    glm::dmat2x3 dp, dp_alone;
    LimitSample alone = r;
    if (take_alone(at, s, alone, dp_alone) && r.cloth(dp[0], dp[1]) &&
        relative_distance(dp, dp_alone) > s.one_sided) {
        r = alone;
        r.alone = true;
    }
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
