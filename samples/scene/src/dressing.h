#pragma once
// Which fabric each panel of a mesh has.

#include <cstdint>
#include <optional>
#include <utility>
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
    // Panels whose opacity is that of the mesh file, into its `opacities`: see add_file_opacities
    std::vector<std::pair<std::uint32_t, std::size_t>> file_opacities{};

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
// entry names no panel of the mesh as it is, or where a picture of the file lies on panels that are
// mirrored in parts. Throws Error at an entry that names none then. Where neither an entry nor the
// whole has an opacity, that of the file counts; UVs are wanted for it, of bodies too.
// \param whole what panels have that no entry names
Dressing dress(Dressing whole, const std::vector<PanelEntry> &entries,
               const std::vector<DressingFabric> &fabrics, garment::MeshFile &mesh,
               garment::Options &options);

} // namespace tsuya::scene
