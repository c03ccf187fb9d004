#pragma once
/// \file
/// How a fabric is woven, for where it is seen from near: sections `[weave]` and `[irregularity]`
/// of F.fabric.toml.
///
///     [weave]
///     preset = "black polyester satin"   # or file = "my.weave.toml", or a .wif
///     [irregularity]
///     thickness = 0.05

#include <string>

#include "tsuya/sdk/irregularity.h"
#include "tsuya/sdk/weave_map.h"

namespace tsuya {

/// The name of a weave, and what it looks like from above. The sdk knows no drafts: who reads a
/// fabric makes the map, see scene::read_cloth; without a map the cloth is seen from far alone.
struct ClothWeave {
    std::string preset{}; ///< of lab::weave_names
    std::string file{};   ///< of a weave or a WIF draft, from the folder of the fabric's file
    Irregularity irregularity{};
    WeaveMap map{};

    bool has_map() const { return !map.place.empty(); } ///< it was read
    bool operator==(const ClothWeave &) const = default;
};

} // namespace tsuya
