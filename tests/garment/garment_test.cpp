#include "tsuya/garment/garment.h"

#include <map>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "test_meshes.h"
#include "tsuya/garment/obj.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {
namespace {

/// Two panels sewn along x = 0.2, as a file.
std::filesystem::path write_two_panels() {
    const auto path = std::filesystem::path(testing::TempDir()) / "two_panels.obj";
    write_file(path, "g left\nv 0 0 0\nv .2 0 0\nv .2 .4 0\nv 0 .4 0\n"
                     "vt 0 0\nvt .2 0\nvt .2 .4\nvt 0 .4\nf 1/1 2/2 3/3 4/4\n"
                     "g right\nv .2 0 0\nv .4 0 0\nv .4 .4 0\nv .2 .4 0\nf 5/1 6/2 7/3 8/4\n");
    return path;
}

TEST(Load, ReadsJoinsSubdividesAndAddsFrames) {
    const std::filesystem::path path = write_two_panels();
    // [doc:load]
    const LoadedGarment dress = load(path, {.subdivide = {.level = 3}});
    const Surface &surface = dress.surface; // triangles with warp, weft, normal and UV
    for (const Finding &finding : dress.report.findings)
        if (finding.severity == Severity::warning)
            throw Error({finding.what, finding.where, finding.action});
    // [doc:load]
    EXPECT_EQ(dress.report.parts, 1u);
    EXPECT_EQ(surface.panel_name, (std::vector<std::string>{"left", "right"}));
    EXPECT_EQ(surface.position.size(), 2u * 9 * 9);
    EXPECT_EQ(surface.triangle.size(), 2u * 2 * 64);
    EXPECT_EQ(surface.panel.back(), 1);
}

TEST(Load, OptionsAreCheckedAndNamed) {
    const auto where = [](const std::filesystem::path &path, const Options &options) {
        try {
            load(path, options);
        } catch (const Error &error) {
            return error.problems().at(0).where;
        }
        return std::string("no error");
    };
    const std::filesystem::path path = write_two_panels();
    EXPECT_EQ(where("dress.fbx", {}), "dress.fbx");
    EXPECT_EQ(where(path, {.metres_per_unit = 0}), path.string() + ": metres_per_unit");
    EXPECT_EQ(where(path, {.metres_per_uv = -1}), path.string() + ": metres_per_uv");
    EXPECT_EQ(where(path, {.subdivide = {.level = 99}}), path.string() + ": subdivide.level");
    EXPECT_EQ(where(path, {.frames = {.grain = {{"lefd", 1.0}}}}), path.string() + ": grain");
    EXPECT_EQ(where(path, {.metres_per_unit = 100, .strict = true}), path.string());
    EXPECT_EQ(where(path, {.strict = true}), "no error");
    EXPECT_EQ(metres_per("cm"), 0.01);
    EXPECT_THROW(metres_per("ell"), Error);
}

TEST(Load, MeasuresTheUvScaleWhereItIsNotStated) {
    PolygonMesh m = test::panel(4, 4, 0.1);
    for (glm::dvec2 &t : m.uv)
        t *= 0.25;
    const LoadedGarment measured = load(m, {}, "mesh");
    EXPECT_NEAR(measured.report.metres_per_uv, 4.0, 1e-9);
    EXPECT_NEAR(measured.surface.uv.back().y, 0.4f, 0.11f);
    const LoadedGarment stated = load(m, {.metres_per_uv = 1.0}, "mesh");
    EXPECT_EQ(stated.report.metres_per_uv, 1.0);
    const LoadedGarment body = load(m, {.want_frames = false}, "mesh");
    EXPECT_TRUE(body.surface.warp.empty());
    EXPECT_TRUE(body.surface.uv.empty());
}

TEST(Load, FindsNothingAboutUvsThatNobodyNeeds) {
    PolygonMesh m = test::panel(4, 4, 0.1);
    for (glm::dvec2 &t : m.uv)
        t = {0.1 * t.x, 0.3 * t.y};
    m.uv[0] = m.uv[1] = m.uv[5];
    m.corner_uv.back() = -1;
    std::set<std::string> cloth, body;
    for (const Finding &f : load(m, {.frames = {.max_degenerate_area = 1}}, "mesh").report.findings)
        cloth.insert(f.key);
    for (const Finding &f : load(m, {.want_frames = false}, "mesh").report.findings)
        body.insert(f.key);
    for (const char *key : {"uneven_uv_scale", "uv_scale_measured", "faces_without_uv",
                            "faces_without_uv_area", "no_panels"})
        EXPECT_TRUE(cloth.contains(key)) << key;
    EXPECT_EQ(body, std::set<std::string>{"openings"});
}

TEST(Load, FarAwayOrScaledMeshesHaveTheSameFrames) {
    const PolygonMesh near = test::Torus().mesh(16);
    const Options options{.metres_per_uv = 1.0, .seams = {.tolerance = -1}};
    const Surface expected = load(near, options, "near").surface;
    const auto same_frames = [&](double scale, const glm::dvec3 &shift) {
        PolygonMesh m = near;
        for (glm::dvec3 &p : m.position)
            p = scale * p + shift;
        const Surface s = load(m, options, "moved").surface;
        ASSERT_EQ(s.position.size(), expected.position.size());
        for (std::size_t v = 0; v < s.position.size(); ++v) {
            EXPECT_LT(glm::distance(s.warp[v], expected.warp[v]), 1e-5f);
            EXPECT_LT(glm::distance(s.weft[v], expected.weft[v]), 1e-5f);
            EXPECT_LT(glm::distance(s.normal[v], expected.normal[v]), 1e-5f);
            EXPECT_LT(glm::distance(s.position[v], scale * expected.position[v] + shift),
                      1e-9 * (scale + glm::length(shift)));
        }
    };
    same_frames(1.0, {1e6, -1e6, 1e6});
    same_frames(1e-3, {0, 0, 0});
    same_frames(1e5, {0, 0, 0});
}

/// Closed runs of edges that one triangle alone has, where vertices of equal positions are one.
std::size_t open_runs(const Surface &s) {
    std::map<std::array<double, 3>, std::uint32_t> number;
    std::vector<std::uint32_t> place;
    for (const glm::dvec3 &p : s.position)
        place.push_back(
            number.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(number.size()))
                .first->second);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const glm::uvec3 &t : s.triangle)
        for (int c = 0; c < 3; ++c)
            ++uses[std::minmax(place[t[c]], place[t[(c + 1) % 3]])];
    std::vector<std::uint32_t> parent(number.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v)
            v = parent[v] = parent[parent[v]];
        return v;
    };
    std::set<std::uint32_t> open;
    for (const auto &[edge, count] : uses)
        if (count == 1) {
            parent[root(edge.first)] = root(edge.second);
            open.insert(edge.first);
        }
    std::set<std::uint32_t> runs;
    for (const std::uint32_t v : open)
        runs.insert(root(v));
    return runs.size();
}

TEST(OutsideData, DressPanelsCloseAtTheSeams) {
    const auto data = test::outside_data();
    if (!data)
        GTEST_SKIP() << "TSUYA_TEST_DATA does not name a folder";
    const LoadedGarment dress = load(*data / "garments/dress_panels.obj");
    EXPECT_EQ(dress.report.panels, 14u);
    EXPECT_EQ(dress.report.parts, 1u);
    // Hem, neck and two arm holes; nothing else is open, and both sides of a seam are
    // bit-identical.
    ASSERT_EQ(dress.report.openings.size(), 4u);
    EXPECT_GT(dress.report.openings[3].length, 0.2);
    EXPECT_EQ(dress.report.seams.unresolved, 0u);
    EXPECT_EQ(open_runs(dress.surface), 4u);
    EXPECT_EQ(dress.report.joined.detached_faces, 0u);
    EXPECT_EQ(dress.report.repaired_frames, 0u);
}

TEST(OutsideData, OtherGarmentsLoadOrSayWhy) {
    const auto data = test::outside_data();
    if (!data)
        GTEST_SKIP() << "TSUYA_TEST_DATA does not name a folder";
    EXPECT_TRUE(load(*data / "garments/dress_body.obj").surface.warp.empty());
    const Report suit =
        load(*data / "garments/female_elegantsuit01.obj", {.metres_per_unit = metres_per("dm")})
            .report;
    EXPECT_EQ(suit.uv_islands, 10u);
    EXPECT_GT(suit.file.flipped_faces, 0u);
    const Report shirt = load(*data / "garments/tshirt1900.obj").report;
    EXPECT_EQ(shirt.faces_without_uv_area, 36u);
    EXPECT_GT(shirt.mirrored_faces, 200u);
    EXPECT_THROW(load(*data / "garments/skirt_no_uv_area.obj"), Error);
    const LoadedGarment skirt =
        load(*data / "garments/skirt_no_uv_area.obj", {.frames = {.invented_grain = 0.0}});
    EXPECT_FALSE(skirt.surface.warp.empty());
}

TEST(OutsideData, PathologicalMeshesGiveASurfaceOrAnError) {
    const auto data = test::outside_data();
    if (!data)
        GTEST_SKIP() << "TSUYA_TEST_DATA does not name a folder";
    int surfaces = 0, errors = 0;
    for (const auto &entry :
         std::filesystem::recursive_directory_iterator(*data / "pathological")) {
        if (entry.path().extension() != ".obj")
            continue;
        for (const int level : {0, 2}) {
            try {
                const LoadedGarment g =
                    load(entry.path(),
                         {.subdivide = {.level = level}, .frames = {.max_degenerate_area = 1.0}});
                check_surface(g.surface, entry.path().string()); // finite, unit, in range
                ++surfaces;
            } catch (const Error &error) {
                EXPECT_NE(error.problems().at(0).where, "") << entry.path();
                ++errors;
            }
        }
    }
    EXPECT_GT(surfaces, 70);
    EXPECT_GT(errors, 8);
}

} // namespace
} // namespace tsuya::garment
