#include "scene_reader.h"

#include <algorithm>
#include <limits>

#include "tsuya/color/dye.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/lamp.h"
#include "tsuya/garment/mesh_file.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/light_group.h"

namespace tsuya::scene {
namespace {

constexpr double kLargest = 1e6;   // metres, radiance, ...
constexpr double kSmallest = 1e-6; // of what has to be above 0

} // namespace

template <class Work>
void SceneReader::note(const Section &section, std::string_view key, Work &&work) {
    try {
        work();
    } catch (const Error &error) {
        section.problem(key, error);
    }
}

std::filesystem::path SceneReader::existing_file(const Section &section, std::string_view key,
                                                 bool required) {
    const std::string name = required ? section.required_text(key) : section.text(key).value_or("");
    if (name.empty())
        return {};
    const std::filesystem::path path = folder_ / name;
    std::error_code code;
    if (!std::filesystem::is_regular_file(path, code))
        section.problem(key, "there is no file " + path.string(),
                        "expected a path relative to the scene file");
    file_.files.push_back(path);
    return path;
}

std::optional<Spectrum> SceneReader::reflectance(const Section &section) {
    const auto constant = section.number("reflectance", 0, 1);
    if (!section.has("dye"))
        return constant ? std::optional(Spectrum::constant(*constant)) : std::nullopt;
    if (constant)
        section.problem("dye", "dye and reflectance are both given", "expected one of them");
    return dyed(section, "dye");
}

std::optional<Spectrum> SceneReader::dyed(const Section &section, const char *key) {
    std::optional<Spectrum> result;
    if (const auto spec = section.text(key))
        note(section, key, [&] { result = parse_dye(*spec, folder_); });
    return result;
}

std::optional<Spectrum> SceneReader::colour(const Section &section, const char *key) {
    if (section.is_text(key))
        return dyed(section, key);
    const auto constant = section.number(key, 0, 1);
    return constant ? std::optional(Spectrum::constant(*constant)) : std::nullopt;
}

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

Placement SceneReader::placement(const Section &section) {
    Placement placement;
    placement.width = section.required_number("width_m", kSmallest, kLargest);
    if (const auto origin = section.numbers("origin_m")) {
        if (origin->size() == 2)
            placement.origin = {(*origin)[0], (*origin)[1]};
        else
            section.problem("origin_m",
                            "'origin_m' has " + std::to_string(origin->size()) + " numbers",
                            "expected two, such as [0.1, 0]");
    }
    placement.turn = section.number("turn_deg", -360, 360).value_or(0) * kDegree;
    if (const auto repeat = section.text("repeat")) {
        const auto found = std::ranges::find(kRepeatNames, *repeat);
        placement.repeat = static_cast<Repeat>(found - kRepeatNames.begin());
        if (found == kRepeatNames.end()) {
            placement.repeat = Repeat::tile;
            section.problem("repeat", "no repeat '" + *repeat + "'",
                            "expected tile, mirror or once");
        }
    }
    return placement;
}

std::optional<std::size_t> SceneReader::opacity(const Section &of) {
    const auto section = of.section("opacity");
    if (!section)
        return {};
    file_.opacities.push_back({existing_file(*section, "picture", true), placement(*section)});
    return file_.opacities.size() - 1;
}

std::optional<std::size_t> SceneReader::pattern(const Section &of, const std::string &owner) {
    const auto section = of.section("pattern");
    if (!section)
        return {};
    PatternEntry entry{.name = owner};
    entry.placement = placement(*section);
    if (section->has("picture"))
        entry.screens.push_back({existing_file(*section, "picture", true), {}});
    if (const auto screens = section->section("screens"))
        for (const auto &[name, screen] : screens->sections()) {
            const auto dye = reflectance(screen);
            if (!dye)
                screen.problem("dye", "the screen '" + name + "' has no dye",
                               "expected dye or reflectance");
            entry.screens.push_back(
                {existing_file(screen, "picture", true), dye.value_or(Spectrum::constant(0))});
        }
    if (section->has("picture") && section->has("screens"))
        section->problem("screens", "picture and screens are both given", "expected one of them");
    if (entry.screens.empty())
        section->problem("picture", "'picture' is missing",
                         "expected a picture, or [...pattern.screens.NAME] with picture and dye");
    file_.patterns.push_back(std::move(entry));
    return file_.patterns.size() - 1;
}

LightGroupIndex SceneReader::group(const Section &section, const std::string &otherwise) {
    const std::string name = section.text("group").value_or(otherwise);
    auto &groups = file_.light_groups;
    note(section, "group", [&] { check_light_group(name, "group"); });
    const auto found = std::find(groups.begin(), groups.end(), name);
    const auto index = static_cast<std::uint32_t>(found - groups.begin());
    if (found == groups.end())
        groups.push_back(name);
    return {index};
}

void SceneReader::read() {
    read_camera();
    read_fabrics();
    read_meshes("garments", true, file_.garments);
    read_meshes("bodies", false, file_.bodies);
    read_backdrop();
    read_lights();
    read_environment();
    read_render();
    read_output();
    if (file_.garments.empty() && file_.bodies.empty())
        root_.problem("garments", "the scene has no garment and no body",
                      "expected [garments.NAME] with mesh and fabric");
    if (!names_light_ && !file_.environment)
        root_.problem("lights", "the scene has no light",
                      "expected [lights.NAME] or [environment]");
}

void SceneReader::read_camera() {
    Framing &framing = file_.framing;
    framing = {.azimuth = 25 * kDegree, .elevation = 3 * kDegree, .vertical_angle = 24 * kDegree};
    const auto camera = root_.section("camera");
    if (!camera)
        return;
    framing.width = camera->integer("width", 1, 32768).value_or(framing.width);
    framing.height = camera->integer("height", 1, 32768).value_or(framing.height);
    framing.vertical_angle = camera->number("vertical_angle_deg", 0.1, 179).value_or(24) * kDegree;
    const auto eye = camera->vector("eye"), target = camera->vector("target"),
               up = camera->vector("up");
    if (!eye) {
        if (target || up)
            camera->problem(target ? "target" : "up", "the camera has no eye",
                            "expected eye with target and up, or azimuth_deg and elevation_deg");
        return read_framing(*camera);
    }
    for (const char *key : {"azimuth_deg", "elevation_deg", "margin"})
        if (camera->has(key))
            camera->problem(key, std::string(key) + " has no meaning beside eye",
                            "expected eye, target and up, or a camera that frames by itself");
    if (!target)
        camera->problem("target", "'target' is missing", "expected a point beside eye");
    file_.camera = Camera{.eye = *eye,
                          .target = target.value_or(*eye - glm::dvec3(0, 0, 1)),
                          .up = up.value_or(glm::dvec3(0, 1, 0)),
                          .vertical_angle = framing.vertical_angle,
                          .width = framing.width,
                          .height = framing.height};
    const Camera &c = *file_.camera;
    if (!(glm::length(glm::cross(c.target - c.eye, c.up)) > 0))
        camera->problem("target", "the camera looks nowhere or along its up direction",
                        "expected eye and target apart, and up not parallel to the view");
}

void SceneReader::read_framing(const Section &camera) {
    Framing &framing = file_.framing;
    framing.azimuth = camera.number("azimuth_deg", -360, 360).value_or(25) * kDegree;
    framing.elevation = camera.number("elevation_deg", -89, 89).value_or(3) * kDegree;
    framing.margin = camera.number("margin", 0, 0.9).value_or(framing.margin);
}

void SceneReader::read_fabrics() {
    const auto fabrics = root_.section("fabrics");
    if (!fabrics)
        return;
    for (const auto &[name, section] : fabrics->sections()) {
        FabricEntry entry{.name = name, .file = existing_file(section, "file", false)};
        entry.dye = reflectance(section);
        entry.f0 = section.number("f0", kSmallest, 1);
        entry.transmittance = colour(section, "transmittance");
        entry.specular_tint = colour(section, "specular_tint");
        entry.weft_tint = colour(section, "weft_tint");
        entry.warp_tint = colour(section, "warp_tint");
        entry.weft_dye = colour(section, "weft_dye");
        entry.warp_dye = colour(section, "warp_dye");
        if (const auto lustre = section.text("lustre"))
            note(section, "lustre", [&] { entry.lustre = lustre_named(*lustre, ""); });
        entry.delustre = section.number("delustre", 0, 1);
        entry.pattern = pattern(section, "fabrics." + name);
        entry.opacity = opacity(section);
        file_.fabrics.push_back(std::move(entry));
    }
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
        if (const auto unit = section.text("unit"))
            note(section, "unit",
                 [&] { entry.options.metres_per_unit = garment::metres_per(*unit); });
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
        entry.translate = section.vector("translate").value_or(glm::dvec3(0));
        entry.visible = section.flag("visible").value_or(true);
        entry.options.want_frames = yarn || has_pictures(entry);
        entry.options.metres_per_uv = section.number("metres_per_uv", kSmallest, kLargest);
        if (yarn)
            read_cloth(section, entry);
        entries.push_back(std::move(entry));
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
    // The document knows a key once it was read, so the panels' names are read.
    note(grain, "", [&] {
        for (const std::string &panel : garment::read_mesh(entry.mesh, progress_).mesh.panel_name)
            if (const auto angle = grain.number(panel, -360, 360))
                entry.options.frames.grain[panel] = *angle * kDegree;
    });
}

void SceneReader::read_backdrop() {
    const auto section = root_.section("backdrop");
    if (!section)
        return;
    BackdropEntry entry{.where = section->where()};
    Cyclorama &shape = entry.shape;
    shape.centre = section->vector("centre").value_or(shape.centre);
    // Faces the camera unless the file says otherwise
    double towards = file_.framing.azimuth;
    if (file_.camera) {
        const glm::dvec3 back = file_.camera->eye - file_.camera->target;
        towards = std::atan2(back.x, back.z);
    }
    shape.azimuth = section->number("azimuth_deg", -360, 360).value_or(towards / kDegree) * kDegree;
    const auto length = [&](const char *key, double &value) {
        value = section->number(key, kSmallest, kLargest).value_or(value);
    };
    length("width", shape.width);
    length("front", shape.front);
    length("back", shape.back);
    length("height", shape.height);
    length("radius", shape.radius);
    entry.reflectance = reflectance(*section).value_or(entry.reflectance);
    if (!(shape.back > shape.radius && shape.height > shape.radius))
        section->problem(section->has("radius") ? "radius" : "back", "the bend does not fit",
                         "expected back and height above the radius");
    file_.backdrop = std::move(entry);
}

void SceneReader::read_lights() {
    if (const auto lights = root_.section("lights"))
        for (const auto &[name, section] : lights->sections()) {
            names_light_ = true;
            read_light(name, section);
        }
}

void SceneReader::read_light(const std::string &name, const Section &section) {
    if (!section.has("centre"))
        section.problem("centre", "'centre' is missing", "expected such as [-2, 2.5, 2]");
    const Softbox standard;
    const Softbox box{.centre = section.vector("centre").value_or(standard.centre),
                      .target = section.vector("target").value_or(standard.target),
                      .up = section.vector("up").value_or(standard.up),
                      .width = section.number("width", kSmallest, kLargest).value_or(1),
                      .height = section.number("height", kSmallest, kLargest).value_or(1),
                      .strength = section.number("strength", 0, kLargest).value_or(1),
                      .group = group(section, name)};
    const auto radiance = section.number("radiance", 0, kLargest);
    if (radiance && section.has("strength"))
        section.problem("radiance", "radiance and strength are both given", "expected one of them");
    note(section, "centre", [&] {
        file_.lights.push_back(make_light(box));
        file_.lights.back().name = name;
        file_.light_places.push_back(section.where());
        if (radiance)
            file_.lights.back().radiance = *radiance;
    });
}

void SceneReader::read_environment() {
    const auto section = root_.section("environment");
    if (!section)
        return;
    Environment &environment = file_.environment.emplace(
        Environment{.radiance = section->number("radiance", 0, kLargest).value_or(1),
                    .group = group(*section, "environment"),
                    .visible = section->flag("visible").value_or(true)});
    if (const auto picture = existing_file(*section, "picture", false); !picture.empty())
        note(*section, "picture", [&] { environment.picture = read_image(picture); });
}

void SceneReader::read_render() {
    const auto section = root_.section("render");
    if (!section)
        return;
    RenderSettings &render = file_.render;
    StopRule &stop = render.stop;
    stop.relative_error = section->number("error", kSmallest, 1);
    stop.seconds = section->number("seconds", 1e-3, kLargest);
    stop.samples_per_pixel =
        section->integer("samples_per_pixel", 1, 65536)
            .value_or(stop.relative_error || stop.seconds ? 65536 : stop.samples_per_pixel);
    render.max_bounces = section->integer("max_bounces", 0, 4096).value_or(render.max_bounces);
    render.seed =
        section->integer("seed", std::uint32_t{0}, std::numeric_limits<std::uint32_t>::max())
            .value_or(render.seed);
    if (const auto channels = section->integer("channels", 8, 32)) {
        render.channels = *channels;
        if (*channels != 8 && *channels != 16 && *channels != 32)
            section->problem("channels", std::to_string(*channels) + " channels",
                             "expected 8, 16 or 32");
    }
    const std::vector<std::string> known = aov_names();
    render.aovs = section->texts("aovs").value_or(std::vector<std::string>{});
    for (const std::string &aov : render.aovs)
        if (std::find(known.begin(), known.end(), aov) == known.end())
            section->problem("aovs", "no AOV '" + aov + "'", accepted_names(aov, known));
}

void SceneReader::read_output() {
    const auto section = root_.section("output");
    if (!section)
        return;
    if (const auto lamps = section->texts("lamps"); lamps && !lamps->empty())
        note(*section, "lamps", [&] { file_.output.lamps = parse_lamps(*lamps, folder_); });
    DisplayOptions &look = file_.output.look;
    if (const auto adapt = section->text("adapt"))
        note(*section, "adapt", [&] { look.adapt = parse_adaptation(*adapt); });
    if (const auto view = section->text("view")) {
        note(*section, "view", [&] { view_description(*view); });
        look.view = *view;
    }
    look.exposure_stops = section->number("exposure", -20, 20).value_or(0);
}

} // namespace tsuya::scene
