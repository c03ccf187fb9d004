#pragma once
/// \file
/// UVs of a control mesh as OpenSubdiv's face-varying channel has them.

#include <vector>

#include "tsuya/garment/polygon_mesh.h"

namespace tsuya::garment {

/// UVs as values that one vertex has each: an index that several vertices share becomes more,
/// and corners without UV share one.
struct UvValues {
    std::vector<int> of_corner;
    std::vector<glm::dvec2> uv;
    std::vector<std::uint32_t> vertex;
    std::vector<bool> near_cut; ///< per vertex: of a face that has a vertex of several values
};

UvValues make_uv_values(const PolygonMesh &mesh);

} // namespace tsuya::garment
