#pragma once
// Which fabric each panel of a mesh has.

#include <optional>
#include <vector>

#include "tsuya/garment/garment.h"
#include "tsuya/scene/panel_entry.h"
#include "tsuya/sdk/scene.h"

namespace tsuya::scene {

// The fabrics of an object.
struct Dressing {
    FabricIndex fabric{};
    std::optional<FabricIndex> back{};
    std::vector<PanelFabric> panels{};
};

// Finds the panels that the entries name, later ones before earlier ones, and sets their grain in
// `options`, and which of them have no yarn directions. Panels become UV islands where the mesh
// names none or an entry names islands. Throws Error at an entry that names no panel.
Dressing dress(FabricIndex fabric, std::optional<FabricIndex> back,
               const std::vector<PanelEntry> &entries, const std::vector<Fabric> &fabrics,
               garment::MeshFile &mesh, garment::Options &options);

} // namespace tsuya::scene
