#include "dressing.h"

#include <algorithm>
#include <map>

#include "tsuya/garment/panels.h"

namespace tsuya::scene {
namespace {

bool names_islands(const PanelEntry &entry) {
    return entry.panels.find("island") != std::string::npos;
}

template <class Tag = FabricTag> Index<Tag> index_of(std::size_t value) {
    return {static_cast<std::uint32_t>(value)};
}

// What an entry says of a panel.
void apply(const PanelEntry &entry, const std::vector<DressingFabric> &fabrics,
           PanelFabric &panel) {
    if (entry.fabric) { // what is here was of the garment's fabric
        panel.fabric = index_of(*entry.fabric);
        panel.back.reset();
        panel.print = fabrics[*entry.fabric].print;
        panel.opacity = fabrics[*entry.fabric].opacity;
    }
    if (entry.back)
        panel.back = index_of(*entry.back);
    if (entry.pattern)
        panel.print = index_of<PrintTag>(*entry.pattern);
    if (entry.opacity)
        panel.opacity = index_of<OpacityTag>(*entry.opacity);
}

} // namespace

Object Dressing::object(std::string name, SurfaceIndex surface) && {
    return {std::move(name), surface, fabric, back, print, opacity, std::move(panels)};
}

Dressing dress(Dressing whole, const std::vector<PanelEntry> &entries,
               const std::vector<DressingFabric> &fabrics, garment::MeshFile &mesh,
               garment::Options &options) {
    if (entries.empty())
        return whole;
    if (mesh.mesh.panel_name.empty() || std::ranges::any_of(entries, names_islands))
        garment::split_panels_by_island(mesh);
    std::map<std::uint32_t, PanelFabric> panels;
    for (const PanelEntry &entry : entries)
        for (const std::uint32_t p : garment::panels_named(mesh.mesh, entry.panels, entry.where)) {
            const PanelFabric as_whole{p, whole.fabric, whole.back, whole.print, whole.opacity};
            apply(entry, fabrics, panels.try_emplace(p, as_whole).first->second);
            if (entry.grain)
                options.frames.grain[mesh.mesh.panel_name[p]] = *entry.grain;
        }
    for (const auto &[p, panel] : panels) {
        whole.panels.push_back(panel);
        if (!fabrics[panel.fabric.value].needs_frames &&
            !(panel.back && fabrics[panel.back->value].needs_frames) && !panel.print &&
            !panel.opacity)
            options.frames.plain.insert(mesh.mesh.panel_name[p]);
    }
    return whole;
}

} // namespace tsuya::scene
