#pragma once
/// \file
/// Vertices that are put into edges while panels are sewn.

#include <cstdint>
#include <vector>

namespace tsuya::garment {

/// A vertex to be put into an edge, at `t` from the start of the edge's side.
struct Insertion {
    std::uint32_t corner; ///< where the side of the edge starts
    double t;
    std::uint32_t vertex;
    double distance;
    std::uint32_t origin = 0; ///< see Sewing
};

/// What is kept about a mesh while it is being sewn. `origin` tells, per corner, its vertex before
/// anything was joined, so that edges which were laid onto each other can be told apart. A new
/// corner gets a new number, the same on both sides of an edge inside a panel.
struct Sewing {
    std::vector<std::uint32_t> origin{};
    std::uint32_t next_origin = 0;
    bool triangles = false; ///< all faces are, and shall stay, triangles
};

} // namespace tsuya::garment
