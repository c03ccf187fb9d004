#pragma once
// Holes that the materials of a mesh file state.

#include "dressing.h"
#include "tsuya/garment/garment.h"
#include "tsuya/sdk/scene.h"

namespace tsuya::scene {

// Lays the file's opacities on the panels that `dress` left to them, as the mesh was loaded: the
// picture fills the unit square of the file's UVs, which is so many metres of cloth, turned as the
// grain turns the cloth and mirrored where the UVs are. Throws Error for a picture that cannot be
// read.
// \param metres_per_uv of the report of the mesh
void add_file_opacities(const garment::MeshFile &mesh, const garment::Options &options,
                        double metres_per_uv, Dressing &dressing, Scene &scene);

// Whether some faces of a panel have mirrored UVs and others not, so that one picture cannot lie
// right on all of it.
bool is_half_mirrored(const garment::PolygonMesh &mesh, const std::string &panel);

} // namespace tsuya::scene
