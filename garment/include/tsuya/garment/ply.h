#pragma once
/// \file
/// PLY and OFF files.

#include <filesystem>
#include <string_view>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/surface.h"

namespace tsuya::garment {

/// Reads polygons of a PLY file, as text or binary of either byte order. UVs are those of the faces
/// (the list `texcoord`: two numbers a corner), else those of the vertices: `u`, `v` or `s`, `t` or
/// `texture_u`, `texture_v`. Panels are the faces' `panel`, named by `comment panel NUMBER NAME`,
/// as write_ply has it. Other properties and elements are skipped. UVs are shared as read_obj does.
/// Throws Error with the place, `file:line` or `file: face N`, if the file declares more than it
/// holds, is cut short, has a row that does not fit its header, a number that is not finite (UVs
/// that no face uses may be anything), a vertex that is not there, or no face.
PolygonMesh read_ply(const std::filesystem::path &path, const Progress &progress = {});

/// Reads polygons of an OFF file: text, one row a line, with any of the prefixes `ST`, `C`, `N` and
/// `4` (UVs, colours, normals, w), or big-endian `OFF BINARY`. Throws as read_ply.
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
