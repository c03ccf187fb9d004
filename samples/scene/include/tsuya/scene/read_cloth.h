#pragma once
/// \file
/// A fabric with its weave, for pictures from near.

#include <filesystem>

#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::scene {

/// As read_fabric (fabric.h), and where the file has `[weave]`, the map of what lies on the face:
/// that of the preset, or of the weave or WIF file that it names. Throws Error as read_fabric and
/// as lab::read_weave, and naming the key for a preset that is none or yarns that find no room.
Fabric read_cloth(const std::filesystem::path &file, const Progress &progress = {});

} // namespace tsuya::scene
