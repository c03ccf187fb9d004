#pragma once
// Which fabric each panel of a mesh has.

#include <optional>
#include <vector>

#include "tsuya/garment/garment.h"
#include "tsuya/scene/panel_entry.h"
#include "tsuya/sdk/scene.h"

namespace tsuya::scene {

// What an object is of.
struct Dressing {
    FabricIndex fabric{};
    std::optional<FabricIndex> back{};
    std::optional<PrintIndex> print{}, back_print{};
    std::optional<OpacityIndex> opacity{};
    std::vector<PanelFabric> panels{};

    Object object(std::string name, SurfaceIndex surface) &&;
};

// A fabric that panels can have.
struct DressingFabric {
    bool needs_frames = false;
    // Where the panel has no other
    std::optional<PrintIndex> print{};
    std::optional<OpacityIndex> opacity{};
};

// Finds the panels that the entries name, later ones before earlier ones, and sets their grain in
// `options`, and which of them have no yarn directions. Panels become UV islands where an
// entry names no panel of the mesh as it is. Throws Error at an entry that names none then.
// \param whole what panels have that no entry names
Dressing dress(Dressing whole, const std::vector<PanelEntry> &entries,
               const std::vector<DressingFabric> &fabrics, garment::MeshFile &mesh,
               garment::Options &options);

} // namespace tsuya::scene
