#pragma once
/// \file
/// PLY and OFF files.

#include <filesystem>
#include <string_view>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/surface.h"

namespace tsuya::garment {

/// Reads polygons of a PLY file, ASCII or binary, with UVs that are given per vertex (`u`, `v`).
/// Throws Error naming the file if it declares more than it holds, is cut short, names a vertex
/// that is not there, or has no face.
PolygonMesh read_ply(const std::filesystem::path &path, const Progress &progress = {});

/// Reads polygons of an OFF file. Throws as read_ply.
PolygonMesh read_off(const std::filesystem::path &path, const Progress &progress = {});

/// The same from text in memory. \param name stands for the file in errors
PolygonMesh parse_ply(std::string_view text, const std::string &name,
                      const Progress &progress = {});
/// As parse_ply, of an OFF file.
PolygonMesh parse_off(std::string_view text, const std::string &name,
                      const Progress &progress = {});

/// Writes triangles as binary PLY with the properties x y z (double), nx ny nz, u v, warp_x/y/z and
/// weft_x/y/z (float; what the surface has), and `panel` of each face; panel names are comments. By
/// atomic replacement. Throws Error naming the path if it cannot be written, and Interrupted.
void write_ply(const std::filesystem::path &path, const Surface &surface,
               const Progress &progress = {});

} // namespace tsuya::garment
