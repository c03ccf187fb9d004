#pragma once
/// \file
/// What every fuzz target does with a mesh that was read.

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>

#include "tsuya/garment/animation.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment::test {

/// One of 24 ways to load, chosen by the bytes of the file: kept inputs stay what they are.
struct FuzzWay {
    explicit FuzzWay(std::span<const std::uint8_t> bytes) {
        std::uint32_t hash = 2166136261u; // FNV-1a
        for (const std::uint8_t byte : bytes)
            hash = (hash ^ byte) * 16777619u;
        const std::uint32_t way = hash >> 8;
        tolerance = way % 4;
        frame = way / 4 % 3 == 0;
        crease = way / 12 % 2 == 0;
    }
    std::uint32_t tolerance; ///< 0, 1: the level; 2: within a tolerance; 3: of a camera
    bool frame, crease;      ///< a further frame; creases along seams and folds
};

/// Length of the diagonal of the mesh's box, 1 where it has none.
inline double fuzz_size(const PolygonMesh &mesh) {
    glm::dvec3 low(1e30), high(-1e30);
    for (const glm::dvec3 &p : mesh.position) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const double size = glm::distance(low, high);
    return size > 0 && size < 1e29 ? size : 1.0;
}

inline Options fuzz_options(const PolygonMesh &mesh, const FuzzWay &way) {
    Options options{.subdivide = {.level = way.tolerance == 0 ? 0 : 1},
                    .frames = {.max_degenerate_area = 1.0}};
    const double size = fuzz_size(mesh);
    if (way.tolerance == 2)
        options.subdivide.tolerance = 0.02 * size;
    if (way.tolerance == 3)
        options.subdivide.view = ViewTolerance{
            .camera = {.eye = {0.3 * size, 0.4 * size, 2 * size}, .width = 40, .height = 50},
            .lights = {{.centre = {size, size, size}, .radius = 0.1 * size}}};
    if (way.crease) {
        options.subdivide.seam_crease = 3;
        options.subdivide.fold_crease = 3;
    }
    return options;
}

/// Reads a mesh by `parse` and, if it is small, makes a surface of it and one of a moved mesh. An
/// Error that says what and where is the right answer to a bad file; anything else ends the
/// program.
template <typename Parse> void fuzz_load(std::span<const std::uint8_t> bytes, Parse &&parse) {
    constexpr std::size_t kMostCorners = 2000; // more cost time and find nothing new
    constexpr std::size_t kMostAdaptiveCorners = 200;
    try {
        const MeshFile file = parse();
        const std::size_t corners = file.mesh.corner_position.size();
        if (corners > kMostCorners)
            return;
        FuzzWay way(bytes);
        if (corners > kMostAdaptiveCorners)
            way.tolerance = 0;
        const Options options = fuzz_options(file.mesh, way);
        if (!way.frame) {
            check_surface(load(file, options, "fuzz").surface, "fuzz");
            return;
        }
        AnimatedGarment garment(file, options, "fuzz");
        check_surface(garment.first().surface, "fuzz");
        std::vector<glm::dvec3> moved = file.mesh.position;
        for (std::size_t v = 0; v < moved.size(); ++v)
            moved[v] *= 1.0 + 0.1 * static_cast<double>(v % 7);
        const Surface surface = garment.frame(moved);
        check_surface(surface, "fuzz");
        if (surface.triangle != garment.first().surface.triangle)
            std::abort();
    } catch (const Error &error) {
        for (const Problem &problem : error.problems())
            if (problem.what.empty() || problem.where.empty())
                std::abort();
    }
}

} // namespace tsuya::garment::test
