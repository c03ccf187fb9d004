#include "tsuya/garment/animation.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "test_meshes.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {
namespace {

/// Two panels with a seam, a T-junction and a vertex that no face has.
MeshFile sewn_panels() {
    MeshFile file{.mesh = test::both(test::panel(2, 2, 0.2), test::panel(4, 4, 0.1, {0.4, 0, 0}))};
    file.mesh.position.emplace_back(9, 9, 9);
    return file;
}

std::vector<glm::dvec3> waved(std::vector<glm::dvec3> positions) {
    for (glm::dvec3 &p : positions)
        p += 0.05 * glm::dvec3(std::sin(9 * p.y), std::sin(7 * p.x), std::sin(8 * p.x + 5 * p.y));
    return positions;
}

TEST(AnimatedGarment, AFrameIsWhatLoadingItsMeshGives) {
    for (const Options &options : {Options{.metres_per_unit = 0.5, .metres_per_uv = 1.0},
                                   Options{.subdivide = {.tolerance = 1e-4}}}) {
        const MeshFile file = sewn_panels();
        AnimatedGarment show(file, options, "show");
        const std::vector<glm::dvec3> moved = waved(file.mesh.position);
        const Surface frame = show.frame(moved);
        check_surface(frame, "frame");
        EXPECT_EQ(frame.triangle, show.first().surface.triangle);
        EXPECT_EQ(frame.uv, show.first().surface.uv);
        // Back to the first.
        const Surface back = show.frame(file.mesh.position);
        const Surface &first = show.first().surface;
        for (std::size_t v = 0; v < first.position.size(); ++v) {
            EXPECT_LT(glm::distance(back.position[v], first.position[v]), 1e-12);
            EXPECT_LT(glm::distance(back.warp[v], first.warp[v]), 1e-5f);
            EXPECT_LT(glm::distance(back.weft[v], first.weft[v]), 1e-5f);
            EXPECT_LT(glm::distance(back.normal[v], first.normal[v]), 1e-5f);
        }
        if (options.subdivide.tolerance)
            continue; // another shape asks for other rates
        // Moved so that edges stay straight, other edges find the same vertices on them.
        MeshFile other = file;
        for (glm::dvec3 &p : other.mesh.position)
            p = {p.x + 0.3 * p.y, p.y, 0.2 * p.x - 0.1 * p.y};
        const Surface loaded = load(other, options, "other").surface;
        const Surface sheared = show.frame(other.mesh.position);
        ASSERT_EQ(loaded.position.size(), sheared.position.size());
        for (std::size_t v = 0; v < loaded.position.size(); ++v) {
            EXPECT_LT(glm::distance(sheared.position[v], loaded.position[v]), 1e-12);
            EXPECT_LT(glm::distance(sheared.warp[v], loaded.warp[v]), 1e-5f);
        }
    }
}

// Whatever was shown before.
TEST(AnimatedGarment, TheMemoryOfAnotherFrameChangesNothing) {
    MeshFile file = sewn_panels();
    for (const bool with_uv : {true, false}) {
        if (!with_uv) {
            file.mesh.uv.clear();
            std::fill(file.mesh.corner_uv.begin(), file.mesh.corner_uv.end(), -1);
        }
        AnimatedGarment show(file, {.frames = {.invented_grain = 0.3}}, "show");
        const std::vector<glm::dvec3> moved = waved(file.mesh.position), twice = waved(moved);
        const Surface expected = show.frame(moved);
        Surface again = show.first().surface;
        const std::vector<glm::dvec3> rest = file.mesh.position;
        for (const std::vector<glm::dvec3> *shape : {&twice, &rest, &moved}) {
            for (glm::dvec3 &p : again.position)
                p += glm::dvec3(1, 2, 3); // as a scene that translates it
            show.frame(*shape, again);
        }
        EXPECT_EQ(again.position, expected.position);
        EXPECT_EQ(again.normal, expected.normal);
        EXPECT_EQ(again.warp, expected.warp);
        EXPECT_EQ(again.weft, expected.weft);
        EXPECT_EQ(again.uv, expected.uv);
        EXPECT_EQ(again.triangle, expected.triangle);
        EXPECT_EQ(again.panel, expected.panel);
    }
}

TEST(AnimatedGarment, SeamsStayClosedAndBadFramesAreErrors) {
    const MeshFile file = sewn_panels();
    AnimatedGarment show(file, {}, "show");
    // The panels drift apart: what was joined stays joined, at the mean.
    std::vector<glm::dvec3> apart = file.mesh.position;
    for (std::size_t v = 9; v < apart.size(); ++v)
        apart[v].x += 0.02;
    const Surface &first = show.first().surface;
    const Surface frame = show.frame(apart);
    for (std::size_t v = 0; v < frame.position.size(); ++v)
        for (std::size_t w = 0; w < v; ++w)
            if (first.position[v] == first.position[w]) {
                EXPECT_EQ(frame.position[v], frame.position[w]);
            }
    apart.pop_back();
    EXPECT_THROW(show.frame(apart), Error);
    apart.emplace_back(std::nan(""), 0, 0);
    apart[0] = apart.back();
    EXPECT_THROW(show.frame(apart), Error);
}

TEST(AnimatedGarment, CurvedFramesAgreeWithTheirOwnMesh) {
    const Options options{.metres_per_uv = 1.0};
    MeshFile file{.mesh = test::both(test::panel(4, 4, 0.1), test::panel(4, 4, 0.1, {0.4, 0, 0}))};
    AnimatedGarment show(file, options, "show");
    file.mesh.position = waved(file.mesh.position);
    const Surface frame = show.frame(file.mesh.position);
    const Surface loaded = load(file, options, "other").surface;
    ASSERT_EQ(loaded.position.size(), frame.position.size());
    for (std::size_t v = 0; v < loaded.position.size(); ++v) {
        EXPECT_LT(glm::distance(frame.position[v], loaded.position[v]), 1e-12);
        EXPECT_LT(glm::distance(frame.normal[v], loaded.normal[v]), 1e-5f);
        EXPECT_LT(glm::distance(frame.warp[v], loaded.warp[v]), 1e-5f);
        EXPECT_LT(glm::distance(frame.weft[v], loaded.weft[v]), 1e-5f);
    }
}

TEST(AnimatedGarment, FilesOfOtherFacesAreNamedWithTheirCounts) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("tsuya-frames-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const auto write = [&](const char *name, const std::string &faces, double z) {
        write_file(folder / name,
                   "v 0 0 " + std::to_string(z) + "\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + faces);
        return folder / name;
    };
    const auto first = write("a.obj", "f 1 2 3 4\n", 0), second = write("b.obj", "f 1 2 3 4\n", 1),
               cut = write("c.obj", "f 1 2 3\nf 1 3 4\n", 0),
               turned = write("d.obj", "f 2 3 4 1\n", 0);
    const GarmentFrames frames = read_frames(first, {second, second});
    ASSERT_EQ(frames.further.size(), 2u);
    EXPECT_EQ(frames.further[0][0].z, 1.0);
    for (const auto &[file, text] :
         {std::pair(cut, "2 faces, where the first frame has 4 vertices, 0 UVs and 1 face"),
          {turned, "joined in another way"}})
        try {
            read_frames(first, {second, file});
            FAIL();
        } catch (const Error &error) {
            EXPECT_EQ(error.problems().at(0).where, file.string());
            EXPECT_NE(error.problems().at(0).what.find(text), std::string::npos)
                << error.problems().at(0).what;
        }
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace tsuya::garment
