#pragma once
/// \file
/// Further frames of one surface.

#include "tsuya/garment/frames.h"

namespace tsuya::garment {

/// What add_frames does to positions, normals, yarn directions and UVs, in the memory of a surface
/// of an earlier frame; its triangles and panels stay. `mesh` is left with the positions and
/// normals that the surface had. Throws as add_frames.
void renew_frames(LimitMesh &mesh, const FrameOptions &options, FrameReport &report,
                  const std::string &where, Surface &surface, const Progress &progress = {});

} // namespace tsuya::garment
