#pragma once
/// \file
/// What is said of some panels of a garment.

#include <cstddef>
#include <optional>
#include <string>

namespace tsuya::scene {

/// Panels by name or pattern, and what they have in place of what their garment has. Of several
/// that name one panel, the last counts.
struct PanelEntry {
    std::string panels{};                 ///< see garment::panels_named
    std::string where{};                  ///< names it in errors, such as file:line:column
    std::optional<std::size_t> fabric{};  ///< into the fabrics
    std::optional<std::size_t> back{};    ///< what is seen from behind, into the fabrics
    std::optional<std::size_t> pattern{}; ///< into the patterns
    std::optional<std::size_t> opacity{}; ///< into the opacities
    std::optional<double> grain{};        ///< radians, see garment::FrameOptions
};

} // namespace tsuya::scene
