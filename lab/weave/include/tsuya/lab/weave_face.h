#pragma once
/// \file
/// What of a weave lies on its face: the map that the near field of a cloth is made of.
///
///     const WeaveMap map = face_of(weave("black polyester satin"));

#include "tsuya/lab/weave.h"
#include "tsuya/lab/weave_geometry.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/weave_map.h"

namespace tsuya::lab {

/// Places along each crossing of a map, along x and y.
inline constexpr int kFacePlaces = 16;

/// The face of one repeat of the draft, looked down on at `places` x `places` places a crossing, 2
/// to 64; of a draft of so many crossings that the map would have more than kMostFacePlaces, at
/// fewer, down to 2. The paths are those of build_filaments, a section's surface that of the
/// race-track. Throws Error like build_filaments, and for `places` out of its range; Interrupted
/// where progress.stop becomes true.
WeaveMap face_of(const Weave &weave, int places = kFacePlaces, const GeometryOptions &options = {},
                 const Progress &progress = {});

/// Places of a map at most, but for drafts that need more for 2 x 2 a crossing.
inline constexpr int kMostFacePlaces = 32768;

} // namespace tsuya::lab
