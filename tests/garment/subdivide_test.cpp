#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <set>

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include "test_meshes.h"
#include "tsuya/garment/seams.h"
#include "tsuya/garment/subdivide.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// A value that OpenSubdiv's Far interpolates.
struct FarPoint {
    glm::dvec3 p{0.0};
    void Clear(void * = nullptr) { p = glm::dvec3(0.0); }
    void AddWithWeight(const FarPoint &other, double weight) { p += weight * other.p; }
};

/// Limit points and normals of the mesh refined once, by Far's masks: the independent path.
void far_limit(const PolygonMesh &mesh, OpenSubdiv::Sdc::SchemeType scheme,
               std::vector<FarPoint> &point, std::vector<glm::dvec3> &normal) {
    namespace Far = OpenSubdiv::Far;
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
    std::unique_ptr<Far::TopologyRefiner> refiner(
        Factory::Create(descriptor, Factory::Options(scheme, sdc)));
    Far::TopologyRefiner::UniformOptions uniform(1);
    uniform.fullTopologyInLastLevel = true;
    refiner->RefineUniform(uniform);
    std::vector<FarPoint> control(mesh.position.size());
    for (std::size_t v = 0; v < control.size(); ++v)
        control[v].p = mesh.position[v];
    const auto n = static_cast<std::size_t>(refiner->GetLevel(1).GetNumVertices());
    std::vector<FarPoint> refined(n), d_u(n), d_v(n);
    point.resize(n);
    const Far::PrimvarRefinerReal<double> primvar(*refiner);
    FarPoint *refined_data = refined.data(), *point_data = point.data();
    FarPoint *d_u_data = d_u.data(), *d_v_data = d_v.data();
    const FarPoint *control_data = control.data();
    primvar.Interpolate(1, control_data, refined_data);
    primvar.Limit(refined_data, point_data, d_u_data, d_v_data);
    for (std::size_t v = 0; v < n; ++v)
        normal.push_back(glm::normalize(glm::cross(d_u[v].p, d_v[v].p)));
}

/// Largest distance from Far's limit points to the nearest vertex of ours, and the same for
/// normals.
void compare_with_far(const PolygonMesh &mesh, Scheme scheme, double shift = 0.0) {
    const bool loop = scheme == Scheme::loop;
    std::vector<FarPoint> point;
    std::vector<glm::dvec3> normal;
    far_limit(mesh, loop ? OpenSubdiv::Sdc::SCHEME_LOOP : OpenSubdiv::Sdc::SCHEME_CATMARK, point,
              normal);
    const LimitMesh ours = subdivide(mesh, {.scheme = scheme, .level = 1});
    ASSERT_EQ(ours.position.size(), point.size());
    double worst = 0.0, worst_normal = 0.0;
    for (std::size_t i = 0; i < point.size(); ++i) {
        double best = 1e9;
        std::size_t at = 0;
        for (std::size_t v = 0; v < ours.position.size(); ++v) {
            const double d = glm::distance(ours.position[v], point[i].p + glm::dvec3(shift, 0, 0));
            if (d < best) {
                best = d;
                at = v;
            }
        }
        worst = std::max(worst, best);
        worst_normal =
            std::max(worst_normal, glm::distance(glm::dvec3(ours.normal[at]), normal[i]));
    }
    if (shift > 0.0) { // the negative control
        EXPECT_GT(worst, 1e-4);
        return;
    }
    EXPECT_LT(worst, 1e-4);
    EXPECT_LT(worst_normal, 2e-3); // Bfr closes extraordinary vertices with patches
}

PolygonMesh shaken(PolygonMesh mesh, double amount) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-amount, amount);
    for (glm::dvec3 &p : mesh.position)
        p += glm::dvec3(shift(random), shift(random), shift(random));
    return mesh;
}

/// A cube with one corner cut off: a triangle, pentagons and quads.
PolygonMesh cut_cube() {
    PolygonMesh m = test::cube();
    const auto corner = static_cast<std::uint32_t>(7);
    PolygonMesh out;
    out.position = m.position;
    out.position[corner] = {0.1, 0.5, 0.5};
    const std::uint32_t y = 8, z = 9;
    out.position.emplace_back(0.5, 0.1, 0.5);
    out.position.emplace_back(0.5, 0.5, 0.1);
    out.add_face({0, 2, 3, 1}, {-1, -1, -1, -1}, 0);
    out.add_face({4, 5, y, 7, 6}, std::vector<std::int32_t>(5, -1), 0);
    out.add_face({0, 1, 5, 4}, {-1, -1, -1, -1}, 0);
    out.add_face({2, 6, 7, z, 3}, std::vector<std::int32_t>(5, -1), 0);
    out.add_face({0, 4, 6, 2}, {-1, -1, -1, -1}, 0);
    out.add_face({1, 3, z, y, 5}, std::vector<std::int32_t>(5, -1), 0);
    out.add_face({7, y, z}, {-1, -1, -1}, 0);
    return out;
}

TEST(Subdivide, AgreesWithFar) {
    compare_with_far(shaken(test::cube(), 0.1), Scheme::catmark);
    compare_with_far(cut_cube(), Scheme::catmark);
    compare_with_far(shaken(test::panel(4, 3, 0.25), 0.05), Scheme::catmark);
    compare_with_far(shaken(test::triangulated(test::cube()), 0.1), Scheme::loop);
    compare_with_far(shaken(test::triangulated(test::panel(4, 3, 0.25)), 0.05), Scheme::loop);
    compare_with_far(shaken(test::cube(), 0.1), Scheme::catmark, 2e-4);
}

TEST(Subdivide, SharesVerticesAlongEdges) {
    for (const int level : {0, 1, 2, 3}) {
        const std::size_t rate = std::size_t{1} << level;
        const LimitMesh open = subdivide(test::panel(3, 2, 0.1), {.level = level});
        EXPECT_EQ(open.position.size(), (3 * rate + 1) * (2 * rate + 1));
        EXPECT_EQ(open.triangle.size(), 3 * 2 * 2 * rate * rate);
        const LimitMesh closed = subdivide(test::cube(), {.level = level});
        EXPECT_EQ(closed.position.size(), 6 * rate * rate + 2);
        EXPECT_TRUE(closed.uv.empty());
    }
}

TEST(Subdivide, TrianglesCoverTheSurfaceOnce) {
    // On a flat panel, all triangles look up and their areas add up.
    const LimitMesh flat = subdivide(test::panel(3, 2, 0.1), {.level = 3});
    double area = 0.0;
    for (const glm::uvec3 &t : flat.triangle) {
        const glm::dvec3 a = flat.position[t.x];
        const double twice = glm::cross(flat.position[t.y] - a, flat.position[t.z] - a).z;
        EXPECT_GT(twice, 0.0);
        area += 0.5 * twice;
    }
    EXPECT_NEAR(area, 0.06, 1e-9);
    // On a closed surface, every edge has its counterpart.
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
    const LimitMesh closed = subdivide(cut_cube(), {.level = 2});
    for (const glm::uvec3 &t : closed.triangle)
        for (int c = 0; c < 3; ++c)
            edges.emplace(t[c], t[(c + 1) % 3]);
    for (const auto &[a, b] : edges) {
        EXPECT_EQ(edges.count({a, b}), 1u);
        EXPECT_EQ(edges.count({b, a}), 1u);
    }
}

TEST(Subdivide, HemsKeepCornersAndStraightEdges) {
    const LimitMesh limit = subdivide(test::panel(3, 2, 0.1), {.level = 2});
    glm::dvec3 lower(1e9), upper(-1e9);
    for (std::size_t v = 0; v < limit.position.size(); ++v) {
        lower = glm::min(lower, limit.position[v]);
        upper = glm::max(upper, limit.position[v]);
        EXPECT_NEAR(limit.normal[v].z, 1.0f, 1e-6f);
        EXPECT_NEAR(limit.position[v].z, 0.0, 1e-12);
    }
    EXPECT_LT(glm::distance(lower, glm::dvec3(0.0)), 1e-12);
    EXPECT_LT(glm::distance(upper, glm::dvec3(0.3, 0.2, 0.0)), 1e-12);
}

TEST(Subdivide, IsTheSameEveryTime) {
    const PolygonMesh mesh = test::Torus().mesh(40);
    const LimitMesh a = subdivide(mesh, {.level = 2}), b = subdivide(mesh, {.level = 2});
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.normal, b.normal);
    EXPECT_EQ(a.triangle, b.triangle);
}

TEST(Subdivide, BadOptionsAndMeshesAreErrors) {
    const auto where = [](const PolygonMesh &mesh, const SubdivideOptions &options) {
        try {
            subdivide(mesh, options);
        } catch (const Error &error) {
            return error.problems().at(0).where;
        }
        return std::string("no error");
    };
    EXPECT_EQ(where(test::cube(), {.level = 9}), "subdivide.level");
    EXPECT_EQ(where(test::cube(), {.level = -1}), "subdivide.level");
    EXPECT_EQ(where(test::cube(), {.scheme = Scheme::loop}), "subdivide.scheme");
    EXPECT_EQ(where(test::cube(), {.seam_crease = -1.0}), "subdivide.seam_crease");
    PolygonMesh fan;
    fan.position.emplace_back(0, 0, 0);
    const std::uint32_t n = 600;
    for (std::uint32_t i = 0; i < n; ++i)
        fan.position.emplace_back(std::cos(0.01 * i), std::sin(0.01 * i), 0);
    for (std::uint32_t i = 1; i < n; ++i)
        fan.add_face({0, i, i + 1}, {-1, -1, -1}, 0);
    EXPECT_EQ(where(fan, {}), "mesh");
}

TEST(Subdivide, StopsWhenAsked) {
    const std::atomic<bool> stop = true;
    Progress progress;
    progress.stop = &stop;
    EXPECT_THROW(subdivide(test::cube(), {}, progress), Interrupted);
}

} // namespace
} // namespace tsuya::garment
