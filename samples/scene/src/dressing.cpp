#include "dressing.h"

#include <algorithm>
#include <map>

#include "index_of.h"
#include "tsuya/garment/panels.h"

namespace tsuya::scene {
namespace {

// What an entry says of a panel.
void apply(const PanelEntry &entry, const std::vector<DressingFabric> &fabrics,
           PanelFabric &panel) {
    if (entry.fabric) { // print and holes were of the garment's fabric
        const DressingFabric &fabric = fabrics[*entry.fabric];
        panel.fabric = index_of<FabricTag>(*entry.fabric);
        panel.print = fabric.print;
        panel.opacity = fabric.opacity;
        if (!fabric.needs_frames) { // a button is not lined
            panel.back.reset();
            panel.back_print.reset();
        }
    }
    if (entry.back) {
        panel.back = index_of<FabricTag>(*entry.back);
        panel.back_print = fabrics[*entry.back].print;
    }
    if (entry.pattern)
        panel.print = index_of<PrintTag>(*entry.pattern);
    if (entry.opacity)
        panel.opacity = index_of<OpacityTag>(*entry.opacity);
}

// The panels of each entry.
std::vector<std::vector<std::uint32_t>> find_all(const garment::PolygonMesh &mesh,
                                                 const std::vector<PanelEntry> &entries) {
    std::vector<std::vector<std::uint32_t>> named;
    for (const PanelEntry &entry : entries)
        named.push_back(garment::find_panels(mesh, entry.panels));
    return named;
}

// Into UV islands, with the grain that is stated for panels.
void split(garment::MeshFile &mesh, garment::FrameOptions &frames) {
    garment::split_panels_by_island(mesh);
    std::map<std::string, double> grain;
    for (const auto &[name, angle] : frames.grain) {
        bool found = false;
        for (const std::string &panel : mesh.mesh.panel_name)
            if (panel == name || panel.starts_with(name + "/island")) {
                grain[panel] = angle;
                found = true;
            }
        if (!found)
            grain[name] = angle; // refused by that name
    }
    frames.grain = std::move(grain);
}

} // namespace

Object Dressing::object(std::string name, SurfaceIndex surface) && {
    return {std::move(name), surface, fabric, back, print, back_print, opacity, std::move(panels)};
}

Dressing dress(Dressing whole, const std::vector<PanelEntry> &entries,
               const std::vector<DressingFabric> &fabrics, garment::MeshFile &mesh,
               garment::Options &options) {
    if (entries.empty())
        return whole;
    std::vector<std::vector<std::uint32_t>> named = find_all(mesh.mesh, entries);
    if (std::ranges::any_of(named, [](const auto &found) { return found.empty(); })) {
        split(mesh, options.frames);
        named = find_all(mesh.mesh, entries);
    }
    std::map<std::uint32_t, PanelFabric> panels;
    for (std::size_t e = 0; e < entries.size(); ++e) {
        const PanelEntry &entry = entries[e];
        if (named[e].empty()) // to be refused with the nearest names
            garment::panels_named(mesh.mesh, entry.panels, entry.where);
        for (const std::uint32_t p : named[e]) {
            const PanelFabric as_whole{p,           whole.fabric,     whole.back,
                                       whole.print, whole.back_print, whole.opacity};
            apply(entry, fabrics, panels.try_emplace(p, as_whole).first->second);
            if (entry.grain)
                options.frames.grain[mesh.mesh.panel_name[p]] = *entry.grain;
        }
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
