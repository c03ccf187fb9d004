#pragma once
// What a try-on is made of.

#include <filesystem>
#include <optional>
#include <vector>

#include "dressing.h"
#include "tsuya/scene/panel_entry.h"
#include "tsuya/scene/tryon.h"
#include "tsuya/sdk/fabric.h"

namespace tsuya::scene {

// The fabrics of a garment: its own first, each file once.
struct Cloths {
    std::vector<Fabric> fabrics{};
    std::optional<FabricIndex> back{};
    std::vector<PanelEntry> entries{};

    Cloths(const TryOn &job, const Progress &progress);
    bool need_frames() const;
    std::vector<DressingFabric> dressing() const;

  private:
    std::vector<std::filesystem::path> files_{};
};

} // namespace tsuya::scene
