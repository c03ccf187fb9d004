#pragma once
/// \file
/// What is printed on a fabric, a garment or some of its panels.

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

} // namespace tsuya::scene
