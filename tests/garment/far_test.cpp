// The limit surface against OpenSubdiv's Far, and where both must differ.

#include <gtest/gtest.h>

#include <memory>

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include "test_meshes.h"
#include "tsuya/garment/subdivide.h"

namespace tsuya::garment {
namespace {

namespace Far = OpenSubdiv::Far;

/// A value that Far interpolates.
struct FarPoint {
    glm::dvec3 p{0.0};
    glm::dvec2 t{0.0};
    void Clear(void * = nullptr) { *this = {}; }
    void AddWithWeight(const FarPoint &other, double weight) {
        p += weight * other.p;
        t += weight * other.t;
    }
};

/// The mesh refined once by Far: points, limits of them by Far's masks, and faces.
struct FarLevel {
    std::vector<FarPoint> refined, limit, d_u, d_v;
    PolygonMesh mesh;
};

/// \param mesh whose UVs have one index a vertex, or none
FarLevel far_level(const PolygonMesh &mesh, Scheme scheme) {
    std::vector<int> sizes, vertices(mesh.corner_position.begin(), mesh.corner_position.end());
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        sizes.push_back(static_cast<int>(mesh.face_size(f)));
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = static_cast<int>(mesh.position.size());
    descriptor.numFaces = static_cast<int>(sizes.size());
    descriptor.numVertsPerFace = sizes.data();
    descriptor.vertIndicesPerFace = vertices.data();
    OpenSubdiv::Sdc::Options sdc;
    sdc.SetVtxBoundaryInterpolation(OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    const auto type =
        scheme == Scheme::loop ? OpenSubdiv::Sdc::SCHEME_LOOP : OpenSubdiv::Sdc::SCHEME_CATMARK;
    std::unique_ptr<Far::TopologyRefiner> refiner(
        Factory::Create(descriptor, Factory::Options(type, sdc)));
    Far::TopologyRefiner::UniformOptions uniform(1);
    uniform.fullTopologyInLastLevel = true;
    refiner->RefineUniform(uniform);
    std::vector<FarPoint> control(mesh.position.size());
    for (std::size_t c = 0; c < mesh.corner_position.size(); ++c) {
        FarPoint &point = control[mesh.corner_position[c]];
        point.p = mesh.position[mesh.corner_position[c]];
        if (mesh.corner_uv[c] >= 0)
            point.t = mesh.uv[static_cast<std::size_t>(mesh.corner_uv[c])];
    }
    const Far::TopologyLevel &level = refiner->GetLevel(1);
    const auto n = static_cast<std::size_t>(level.GetNumVertices());
    FarLevel out;
    for (std::vector<FarPoint> *points : {&out.refined, &out.limit, &out.d_u, &out.d_v})
        points->resize(n);
    const Far::PrimvarRefinerReal<double> primvar(*refiner);
    const FarPoint *control_data = control.data();
    FarPoint *refined = out.refined.data(), *limit = out.limit.data();
    FarPoint *d_u = out.d_u.data(), *d_v = out.d_v.data();
    primvar.Interpolate(1, control_data, refined);
    primvar.Limit(refined, limit, d_u, d_v);
    for (const FarPoint &p : out.refined)
        out.mesh.position.push_back(p.p);
    for (int f = 0; f < level.GetNumFaces(); ++f) {
        const auto corners = level.GetFaceVertices(f);
        out.mesh.add_face(std::vector<std::uint32_t>(corners.begin(), corners.end()),
                          std::vector<std::int32_t>(static_cast<std::size_t>(corners.size()), -1),
                          0);
    }
    return out;
}

std::size_t nearest(const LimitMesh &mesh, const glm::dvec3 &p) {
    std::size_t best = 0;
    for (std::size_t v = 1; v < mesh.position.size(); ++v)
        if (glm::distance(mesh.position[v], p) < glm::distance(mesh.position[best], p))
            best = v;
    return best;
}

struct Comparison {
    bool skip_first = false;    ///< leave out vertex 0
    double shift = 0.0;         ///< of Far's points, as a control
    double normal_error = 1e-6; ///< that is allowed
};

/// Departure of positions and normals from Far's limits.
void compare_with_far(const PolygonMesh &mesh, Scheme scheme, const Comparison &how = {}) {
    const FarLevel far = far_level(mesh, scheme);
    const LimitMesh ours = subdivide(mesh, {.scheme = scheme, .level = 1});
    ASSERT_EQ(ours.position.size(), far.limit.size());
    const std::size_t first = nearest(ours, subdivide(mesh, {.scheme = scheme}).position[0]);
    double worst = 0.0, worst_normal = 0.0;
    for (std::size_t i = 0; i < far.limit.size(); ++i) {
        const glm::dvec3 p = far.limit[i].p + glm::dvec3(how.shift, 0, 0);
        const std::size_t at = nearest(ours, p);
        const glm::dvec3 normal = glm::normalize(glm::cross(far.d_u[i].p, far.d_v[i].p));
        worst = std::max(worst, glm::distance(ours.position[at], p));
        if (!how.skip_first || at != first)
            worst_normal =
                std::max(worst_normal, glm::distance(glm::dvec3(ours.normal[at]), normal));
    }
    if (how.shift > 0.0) {
        EXPECT_GT(worst, 1e-4);
        return;
    }
    EXPECT_LT(worst, 1e-10);
    EXPECT_LT(worst_normal, how.normal_error);
}

TEST(Far, LimitPointsAndNormalsAgree) {
    compare_with_far(test::shaken(test::cube(), 0.1), Scheme::catmark);
    compare_with_far(test::cut_cube(), Scheme::catmark, {.normal_error = 1e-4});
    compare_with_far(test::shaken(test::triangulated(test::cube()), 0.1), Scheme::catmark,
                     {.normal_error = 1e-4});
    compare_with_far(test::shaken(test::panel(4, 3, 0.25), 0.05), Scheme::catmark);
    compare_with_far(test::shaken(test::triangulated(test::cube()), 0.1), Scheme::loop);
    compare_with_far(test::shaken(test::triangulated(test::panel(4, 3, 0.25)), 0.05), Scheme::loop);
    for (const int n : {3, 4, 5, 6, 8, 12, 20, 50})
        for (const bool triangles : {false, true}) {
            const Scheme scheme = triangles ? Scheme::loop : Scheme::catmark;
            compare_with_far(test::fan(n, false, triangles), scheme);
            compare_with_far(test::fan(n, true, triangles), scheme, {.skip_first = true});
        }
    compare_with_far(test::shaken(test::cube(), 0.1), Scheme::catmark, {.shift = 2e-4});
}

TEST(Far, WarpAndWeftAgreeAtExtraordinaryVertices) {
    for (const int n : {3, 5, 6, 9, 20}) {
        for (const bool triangles : {false, true}) {
            const Scheme scheme = triangles ? Scheme::loop : Scheme::catmark;
            const PolygonMesh mesh = test::fan(n, false, triangles);
            const FarLevel far = far_level(mesh, scheme);
            const LimitMesh ours = subdivide(mesh, {.scheme = scheme, .level = 1});
            std::size_t compared = 0;
            for (std::size_t i = 0; i < far.limit.size(); ++i) {
                // Away from the outline, where UVs follow another rule than positions.
                if (glm::length(far.limit[i].p) > 0.9)
                    continue;
                const FarPoint &a = far.d_u[i], &b = far.d_v[i];
                const double det = a.t.x * b.t.y - a.t.y * b.t.x;
                const glm::dvec3 dp_du = (a.p * b.t.y - b.p * a.t.y) / det,
                                 dp_dv = (b.p * a.t.x - a.p * b.t.x) / det;
                const std::size_t at = nearest(ours, far.limit[i].p);
                EXPECT_LT(glm::distance(glm::dvec3(ours.dp_du[at]), dp_du), 1e-6) << n;
                EXPECT_LT(glm::distance(glm::dvec3(ours.dp_dv[at]), dp_dv), 1e-6) << n;
                EXPECT_GT(glm::distance(glm::dvec3(ours.dp_dv[at]), dp_du), 0.1); // the control
                ++compared;
            }
            EXPECT_GT(compared, 0u);
        }
    }
}

// Level 0 evaluates control vertices by masks, level 1 by Bfr's patches.
TEST(Far, LevelZeroHasTheControlVerticesOfLevelOne) {
    std::vector<PolygonMesh> meshes{
        test::shaken(test::cube(), 0.1), test::cut_cube(),
        test::shaken(test::triangulated(test::cube()), 0.1),
        test::shaken(test::panel(5, 4, 0.25), 0.05),
        test::shaken(test::triangulated(test::panel(5, 4, 0.25)), 0.05)};
    for (const int n : {3, 4, 5, 6, 7, 20})
        for (const bool triangles : {false, true})
            meshes.push_back(test::fan(n, false, triangles));
    std::size_t with_uv = 0;
    for (const PolygonMesh &mesh : meshes)
        for (const Scheme scheme : {Scheme::catmark, Scheme::automatic}) {
            const LimitMesh zero = subdivide(mesh, {.scheme = scheme, .level = 0});
            const LimitMesh one = subdivide(mesh, {.scheme = scheme, .level = 1});
            for (std::size_t v = 0; v < zero.position.size(); ++v) {
                const std::size_t w = nearest(one, zero.position[v]);
                EXPECT_LT(glm::distance(zero.position[v], one.position[w]), 1e-10);
                EXPECT_LT(glm::distance(zero.normal[v], one.normal[w]), 1e-4f);
                if (zero.uv.empty())
                    continue;
                EXPECT_LT(glm::distance(zero.uv[v], one.uv[w]), 1e-6f);
                const float length = glm::length(one.dp_du[w]);
                EXPECT_LT(glm::distance(zero.dp_du[v], one.dp_du[w]), 1e-4f * length);
                EXPECT_LT(glm::distance(zero.dp_dv[v], one.dp_dv[w]), 1e-4f * length);
                with_uv += length > 0.0f;
            }
        }
    EXPECT_GT(with_uv, 100u);
}

// Far's mask for hems is of rules that OpenSubdiv does not refine by, so its normal changes when
// the mesh is refined once, which leaves the surface as it is. Ours does not.
TEST(Far, NormalsOfHemsAreThoseOfTheRefinedMesh) {
    double far_changes = 0.0;
    for (const bool triangles : {false, true}) {
        const Scheme scheme = triangles ? Scheme::loop : Scheme::catmark;
        for (const int n : {1, 2, 3, 4, 5, 8, 20}) {
            const PolygonMesh mesh = test::fan(n, true, triangles);
            const FarLevel once = far_level(mesh, scheme), twice = far_level(once.mesh, scheme);
            const LimitMesh ours = subdivide(mesh, {.scheme = scheme, .level = 0});
            const LimitMesh refined = subdivide(once.mesh, {.scheme = scheme, .level = 0});
            const std::size_t at = nearest(refined, ours.position[0]);
            EXPECT_LT(glm::distance(refined.position[at], ours.position[0]), 1e-12);
            EXPECT_LT(glm::distance(refined.normal[at], ours.normal[0]), 1e-6f) << n;
            const auto far_normal = [&](const FarLevel &level) {
                std::size_t best = 0;
                for (std::size_t i = 0; i < level.limit.size(); ++i)
                    if (glm::distance(level.limit[i].p, ours.position[0]) <
                        glm::distance(level.limit[best].p, ours.position[0]))
                        best = i;
                return glm::normalize(glm::cross(level.d_u[best].p, level.d_v[best].p));
            };
            far_changes = std::max(far_changes, glm::distance(far_normal(once), far_normal(twice)));
        }
    }
    EXPECT_GT(far_changes, 1e-3);
}

} // namespace
} // namespace tsuya::garment
