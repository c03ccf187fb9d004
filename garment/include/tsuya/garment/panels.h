#pragma once
/// \file
/// The panels of a mesh: by name, and by UV island.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tsuya/garment/mesh_file.h"
#include "tsuya/garment/polygon_mesh.h"

namespace tsuya::garment {

/// Makes a panel of each UV island of a panel. Islands are called `island0`, `island1`, ... in the
/// order of their first faces; a panel of several islands is called `NAME/island0`, ..., and where
/// the file names no panel, as its island is.
void split_panels_by_island(PolygonMesh &mesh);

/// The same, with the hints and opacities of a file, which are for panels.
void split_panels_by_island(MeshFile &file);

/// The panels that a pattern names, in their order, perhaps none: it is compared with the panel's
/// name, and with what the file calls its object, group and material and its island. `*` stands for
/// any letters, `?` for one.
std::vector<std::uint32_t> find_panels(const PolygonMesh &mesh, std::string_view pattern);

/// The same. Throws Error naming `where`, with the nearest names, where there is none.
std::vector<std::uint32_t> panels_named(const PolygonMesh &mesh, std::string_view pattern,
                                        const std::string &where);

/// The area of face `f` in the UV plane; negative where it is mirrored, 0 without UV.
double uv_area(const PolygonMesh &mesh, std::size_t f);

} // namespace tsuya::garment
