#pragma once
/// \file
/// Counts, UV measures and findings of a report.

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/garment/report.h"

namespace tsuya::garment {

/// Counts of the mesh as the file has it.
void measure_file(const PolygonMesh &mesh, Report &report);

/// UV islands, mirrored and empty UVs, and metres of cloth per unit of UV.
void measure_uv(const PolygonMesh &mesh, Report &report);

/// Turns the numbers of the report into findings. \param mesh as the file has it
void find_all(const PolygonMesh &mesh, Report &report);

} // namespace tsuya::garment
