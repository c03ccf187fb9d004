#include "dressing.h"

#include <algorithm>
#include <map>

#include "file_opacity.h"
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

// By panel: which of the file's opacities it has.
std::map<std::uint32_t, std::size_t> opacities_of_file(const garment::MeshFile &mesh) {
    std::map<std::uint32_t, std::size_t> found;
    for (std::size_t o = 0; o < mesh.opacities.size(); ++o)
        for (const std::string &name : mesh.opacities[o].panels) {
            const auto at = std::ranges::find(mesh.mesh.panel_name, name);
            if (at != mesh.mesh.panel_name.end())
                found[static_cast<std::uint32_t>(at - mesh.mesh.panel_name.begin())] = o;
        }
    return found;
}

bool has_half_mirrored_holes(const garment::MeshFile &mesh) {
    return std::ranges::any_of(mesh.opacities, [&](const garment::FileOpacity &opacity) {
        return !opacity.picture.empty() &&
               std::ranges::any_of(opacity.panels, [&](const std::string &panel) {
                   return is_half_mirrored(mesh.mesh, panel);
               });
    });
}

bool has_file_opacity(const Dressing &dressing, std::uint32_t panel) {
    return std::ranges::any_of(dressing.file_opacities,
                               [&](const auto &entry) { return entry.first == panel; });
}

// Of a mesh whose UVs nobody else looks at: they need not be good.
void want_uvs_of_holes(const Dressing &dressing, const garment::PolygonMesh &mesh,
                       garment::Options &options) {
    options.want_frames = true;
    options.frames.max_degenerate_area = 1;
    for (std::uint32_t p = 0; p < mesh.panel_name.size(); ++p)
        if (!has_file_opacity(dressing, p))
            options.frames.plain.insert(mesh.panel_name[p]);
}

} // namespace

Object Dressing::object(std::string name, SurfaceIndex surface) && {
    return {std::move(name), surface, fabric, back, print, back_print, opacity, std::move(panels)};
}

Dressing dress(Dressing whole, const std::vector<PanelEntry> &entries,
               const std::vector<DressingFabric> &fabrics, garment::MeshFile &mesh,
               garment::Options &options) {
    std::vector<std::vector<std::uint32_t>> named = find_all(mesh.mesh, entries);
    if (std::ranges::any_of(named, [](const auto &found) { return found.empty(); }) ||
        has_half_mirrored_holes(mesh)) {
        split(mesh, options.frames);
        named = find_all(mesh.mesh, entries);
    }
    std::map<std::uint32_t, PanelFabric> panels;
    const auto panel_of = [&](std::uint32_t p) -> PanelFabric & {
        const PanelFabric as_whole{p,           whole.fabric,     whole.back,
                                   whole.print, whole.back_print, whole.opacity};
        return panels.try_emplace(p, as_whole).first->second;
    };
    for (std::size_t e = 0; e < entries.size(); ++e) {
        const PanelEntry &entry = entries[e];
        if (named[e].empty()) // to be refused with the nearest names
            garment::panels_named(mesh.mesh, entry.panels, entry.where);
        for (const std::uint32_t p : named[e]) {
            apply(entry, fabrics, panel_of(p));
            if (entry.grain)
                options.frames.grain[mesh.mesh.panel_name[p]] = *entry.grain;
        }
    }
    for (const auto &[p, opacity] : opacities_of_file(mesh))
        if (!panel_of(p).opacity)
            whole.file_opacities.emplace_back(p, opacity);
    for (const auto &[p, panel] : panels) {
        whole.panels.push_back(panel);
        if (!has_file_opacity(whole, p) && !fabrics[panel.fabric.value].needs_frames &&
            !(panel.back && fabrics[panel.back->value].needs_frames) && !panel.print &&
            !panel.opacity)
            options.frames.plain.insert(mesh.mesh.panel_name[p]);
    }
    if (!whole.file_opacities.empty() && !options.want_frames)
        want_uvs_of_holes(whole, mesh.mesh, options);
    return whole;
}

} // namespace tsuya::scene
