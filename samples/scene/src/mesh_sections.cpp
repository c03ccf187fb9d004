// Garments and bodies of scene files.

#include <algorithm>

#include "scene_reader.h"
#include "tsuya/garment/mesh_file.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {

bool SceneReader::has_pictures(const MeshEntry &entry) const {
    const auto printed = [&](const std::optional<std::size_t> &fabric) {
        return fabric && *fabric < file_.fabrics.size() &&
               (file_.fabrics[*fabric].pattern || file_.fabrics[*fabric].opacity);
    };
    return entry.pattern || entry.opacity || printed(entry.fabric) || printed(entry.back) ||
           std::ranges::any_of(entry.panels, [&](const PanelEntry &panel) {
               return panel.pattern || panel.opacity || printed(panel.fabric) ||
                      printed(panel.back);
           });
}

void SceneReader::read_meshes(const char *kind, bool yarn, std::vector<MeshEntry> &entries) {
    const auto meshes = root_.section(kind);
    if (!meshes)
        return;
    for (const auto &[name, section] : meshes->sections()) {
        MeshEntry entry{
            .name = name, .where = section.where(), .mesh = existing_file(section, "mesh", true)};
        section.required_text("fabric");
        entry.fabric = fabric_named(section, "fabric").value_or(0);
        entry.back = fabric_named(section, "back");
        entry.pattern = pattern(section, std::string(kind) + "." + name);
        entry.opacity = opacity(section);
        if (const auto panels = section.section("panels"))
            read_panels(*panels, yarn, entry);
        read_frames(section, entry);
        if (const auto unit = section.text("unit"))
            note(section, "unit",
                 [&] { entry.options.metres_per_unit = garment::metres_per(*unit); });
        entry.options.unit_stated = section.has("unit");
        if (const auto up = section.text("up"))
            note(section, "up", [&] { entry.options.up = garment::up_axis(*up); });
        entry.options.subdivide.level = section.integer("level", 0, 8).value_or(1);
        if (const auto tolerance_mm = section.number("tolerance_mm", kSmallest, kLargest))
            entry.options.subdivide.tolerance = 1e-3 * *tolerance_mm;
        garment::SubdivideOptions &subdivide = entry.options.subdivide;
        subdivide.fold_crease = section.number("fold_crease", 0, 9).value_or(0);
        subdivide.fold_angle = section.number("fold_angle_deg", 0, 180).value_or(60) * kDegree;
        if (const auto sewing_mm = section.number("sewing_tolerance_mm", 0, 1000))
            entry.options.seams.tolerance = 1e-3 * *sewing_mm;
        entry.options.strict = section.flag("strict").value_or(false);
        entry.tolerance_px = section.number("tolerance_px", 1e-3, 1e3);
        entry.turn = section.number("turn_deg", -360, 360).value_or(0) * kDegree;
        entry.translate = section.vector("translate").value_or(glm::dvec3(0));
        entry.visible = section.flag("visible").value_or(true);
        entry.options.want_frames = yarn || has_pictures(entry);
        entry.options.metres_per_uv = section.number("metres_per_uv", kSmallest, kLargest);
        if (yarn)
            read_cloth(section, entry);
        entries.push_back(std::move(entry));
    }
}

void SceneReader::read_frames(const Section &section, MeshEntry &entry) {
    entry.morph_targets = section.flag("morph_targets").value_or(false);
    for (const std::string &name : section.texts("frames").value_or(std::vector<std::string>{})) {
        entry.frames.push_back(folder_ / name);
        std::error_code code;
        if (!std::filesystem::is_regular_file(entry.frames.back(), code))
            section.problem("frames", "there is no file " + entry.frames.back().string(),
                            "expected paths relative to the scene file");
        file_.files.push_back(entry.frames.back());
    }
}

std::optional<std::size_t> SceneReader::fabric_named(const Section &section, const char *key) {
    const std::string name = section.text(key).value_or("");
    if (name.empty())
        return {};
    std::vector<std::string> fabrics;
    for (const FabricEntry &fabric : file_.fabrics)
        fabrics.push_back(fabric.name);
    const auto found = std::find(fabrics.begin(), fabrics.end(), name);
    if (found != fabrics.end())
        return static_cast<std::size_t>(found - fabrics.begin());
    section.problem(key, "no fabric '" + name + "'", accepted_names(name, fabrics));
    return {};
}

void SceneReader::read_panels(const Section &panels, bool yarn, MeshEntry &entry) {
    for (const auto &[name, section] : panels.sections()) {
        PanelEntry panel{.panels = name,
                         .where = section.where(),
                         .fabric = fabric_named(section, "fabric"),
                         .back = fabric_named(section, "back"),
                         .pattern = pattern(section, "panels." + name),
                         .opacity = opacity(section)};
        if (yarn)
            if (const auto grain = section.number("grain_deg", -360, 360))
                panel.grain = *grain * kDegree;
        entry.panels.push_back(std::move(panel));
    }
}

void SceneReader::read_cloth(const Section &section, MeshEntry &entry) {
    entry.options.subdivide.seam_crease = section.number("seam_crease", 0, 10).value_or(0);
    garment::FrameOptions &frames = entry.options.frames;
    frames.max_degenerate_area =
        section.number("max_degenerate_area", 0, 1).value_or(frames.max_degenerate_area);
    frames.default_grain = section.number("default_grain_deg", -360, 360).value_or(0) * kDegree;
    if (const auto invented = section.number("invented_grain_deg", -360, 360))
        frames.invented_grain = *invented * kDegree;
    std::error_code code;
    if (!std::filesystem::is_regular_file(entry.mesh, code))
        section.has("grain"); // its keys cannot be judged
    else if (const auto grain = section.section("grain"))
        read_grain(*grain, entry);
}

void SceneReader::read_grain(const Section &grain, MeshEntry &entry) {
    std::vector<std::string> panels;
    try {
        panels = garment::read_mesh(entry.mesh, progress_).mesh.panel_name;
    } catch (const Error &error) {
        grain.problem("", error);
        return grain.leave_unjudged();
    }
    // The document knows a key once it was read, so the panels' names are read.
    for (const std::string &panel : panels)
        if (const auto angle = grain.number(panel, -360, 360))
            entry.options.frames.grain[panel] = *angle * kDegree;
}

} // namespace tsuya::scene
