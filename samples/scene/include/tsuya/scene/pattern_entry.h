#pragma once
/// \file
/// Pictures on a fabric, a garment or some of its panels: what is printed, and where holes are.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/sdk/print.h"
#include "tsuya/sdk/spectrum.h"

namespace tsuya::scene {

/// A picture of a print: in colours, or a printing screen, which says where its one dye lies.
struct ScreenEntry {
    std::filesystem::path picture{};
    std::optional<Spectrum> dye{}; ///< of a screen
};

/// `pattern = { picture = "toile.png", width_m = 0.64 }`
struct PatternEntry {
    std::string name{};                 ///< for messages
    std::vector<ScreenEntry> screens{}; ///< the lowest first
    Placement placement{};
};

/// `opacity = { picture = "lace.png", width_m = 0.2 }`
struct OpacityEntry {
    std::filesystem::path picture{};
    Placement placement{};
};

} // namespace tsuya::scene
