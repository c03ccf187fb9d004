#include "dressing.h"

#include <algorithm>
#include <map>

#include "tsuya/garment/panels.h"

namespace tsuya::scene {
namespace {

bool names_islands(const PanelEntry &entry) {
    return entry.pattern.find("island") != std::string::npos;
}

FabricIndex index_of(std::size_t fabric) { return {static_cast<std::uint32_t>(fabric)}; }

bool has_frames(const PanelFabric &panel, const std::vector<Fabric> &fabrics) {
    return needs_frames(fabrics[panel.fabric.value]) ||
           (panel.back && needs_frames(fabrics[panel.back->value]));
}

} // namespace

Dressing dress(FabricIndex fabric, std::optional<FabricIndex> back,
               const std::vector<PanelEntry> &entries, const std::vector<Fabric> &fabrics,
               garment::MeshFile &mesh, garment::Options &options) {
    Dressing dressing{.fabric = fabric, .back = back};
    if (entries.empty())
        return dressing;
    if (mesh.mesh.panel_name.empty() || std::ranges::any_of(entries, names_islands))
        garment::split_panels_by_island(mesh);
    std::map<std::uint32_t, PanelFabric> panels;
    for (const PanelEntry &entry : entries)
        for (const std::uint32_t p : garment::panels_named(mesh.mesh, entry.pattern, entry.where)) {
            PanelFabric &panel = panels.try_emplace(p, PanelFabric{p, fabric, back}).first->second;
            if (entry.fabric) {
                panel.fabric = index_of(*entry.fabric);
                panel.back.reset(); // of the garment's fabric, not of this one
            }
            if (entry.back)
                panel.back = index_of(*entry.back);
            if (entry.grain)
                options.frames.grain[mesh.mesh.panel_name[p]] = *entry.grain;
        }
    for (const auto &[p, panel] : panels) {
        dressing.panels.push_back(panel);
        if (!has_frames(panel, fabrics))
            options.frames.plain.insert(mesh.mesh.panel_name[p]);
    }
    return dressing;
}

} // namespace tsuya::scene
