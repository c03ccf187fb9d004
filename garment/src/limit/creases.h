#pragma once
// Which edges of a control mesh stay sharp.

#include <vector>

#include "tsuya/garment/subdivide.h"

namespace tsuya::garment {

struct Creases {
    std::vector<int> ends{};        // two vertices an edge
    std::vector<float> sharpness{}; // per edge
    std::vector<int> corners{};     // vertices
};

// Edges where the UVs of the two sides part, and those that are folded by more than the angle.
// Corners of the hem and straight edges that the mesh names. Edges and corners near faces that meet
// in more than a vertex or an edge stay smooth: Bfr 3.5 reads out of bounds for creases there.
Creases find_creases(const PolygonMesh &mesh, const SubdivideOptions &options);

} // namespace tsuya::garment
