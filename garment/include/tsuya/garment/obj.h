#pragma once
/// \file
/// Wavefront OBJ files: a strict, fast reader and a plain writer.

#include <filesystem>
#include <string>
#include <string_view>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/surface.h"

namespace tsuya::garment {

/// Reads `v`, `vt`, `f`, `g`, `o` and `usemtl`; every other line is ignored, and so are vertex
/// colours (`v x y z r g b`), normals and the third texture coordinate; the w of a vertex divides
/// its coordinates. Faces may have any size, negative indices,
/// one `vt` a corner or none; lines may end in CRLF or be continued by a backslash. Panels are
/// named by the first of `g`, `o`, `usemtl` that tells faces apart, or else by the first that the
/// file has; a file with none has no panel names.
///
/// Positions and UVs are as in the file. A UV index is shared by corners of one vertex and panel
/// where the UV has exactly equal values, so that files with one `vt` a corner are continuous.
///
/// Throws Error listing up to 20 places as `file:line:column`: a number that does not parse or is
/// not finite (UVs that no face uses may be anything), a w of 0, an index that is 0 or names
/// nothing, a face of fewer than 3 corners, no face at all.
PolygonMesh read_obj(const std::filesystem::path &path, const Progress &progress = {});

/// The same from text in memory. \param name stands for the file in errors
PolygonMesh parse_obj(std::string_view text, const std::string &name);

/// Writes triangles with `v`, `vt`, `vn` and one `g` a panel, by atomic replacement. The format has
/// no place for warp and weft. Throws Error naming the path if it cannot be written, and
/// Interrupted.
void write_obj(const std::filesystem::path &path, const Surface &surface,
               const Progress &progress = {});

} // namespace tsuya::garment
