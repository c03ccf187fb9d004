#pragma once
/// \file
/// What every fuzz target does with a mesh that was read.

#include <cstdlib>

#include "tsuya/garment/garment.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment::test {

/// Reads a mesh by `parse` and, if it is small, makes a surface of it. An Error that says what and
/// where is the right answer to a bad file; anything else ends the program.
template <typename Parse> void fuzz_load(Parse &&parse) {
    constexpr std::size_t kMostCorners = 2000; // more cost time and find nothing new
    try {
        const MeshFile file = parse();
        if (file.mesh.corner_position.size() > kMostCorners)
            return;
        const LoadedGarment garment =
            load(file, {.subdivide = {.level = 1}, .frames = {.max_degenerate_area = 1.0}}, "fuzz");
        check_surface(garment.surface, "fuzz");
    } catch (const Error &error) {
        for (const Problem &problem : error.problems())
            if (problem.what.empty() || problem.where.empty())
                std::abort();
    }
}

} // namespace tsuya::garment::test
