#include "scene_reader.h"

#include <algorithm>
#include <limits>

#include "tsuya/scene/own_lamps.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
std::filesystem::path SceneReader::existing_file(const Section &section, std::string_view key,
                                                 bool required) {
    const std::string name = required ? section.required_text(key) : section.text(key).value_or("");
    if (name.empty())
        return {};
    std::filesystem::path path = folder_ / name;
    std::error_code code;
    if (!std::filesystem::is_regular_file(path, code))
        section.problem(key, "there is no file " + path.string(),
                        "expected a path relative to the scene file");
    file_.files.push_back(path);
    return path;
}

void SceneReader::read() {
    read_camera();
    read_studio();
    read_fabrics();
    read_meshes("garments", true, file_.garments);
    read_meshes("bodies", false, file_.bodies);
    read_backdrop();
    read_units();
    read_lights();
    read_environment();
    read_render();
    read_output();
    check_own_lamps();
    if (file_.garments.empty() && file_.bodies.empty())
        root_.problem("garments", "the scene has no garment and no body",
                      "expected [garments.NAME] with mesh and fabric");
    if (!names_light_ && !file_.environment && file_.studio.empty())
        root_.problem("lights", "the scene has no light",
                      "expected [lights.NAME], [environment] or a studio");
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
    render.denoise = section->flag("denoise").value_or(false);
    render.widen_after_diffuse =
        section->flag("widen_after_diffuse").value_or(render.widen_after_diffuse);
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
        note(*section, "lamps", [&] {
            file_.output.lamps = parse_picture_lamps(*lamps, folder_);
            for (const NamedLamp &lamp : file_.output.lamps)
                add_warnings(lamp.warnings);
        });
    DisplayOptions &look = file_.output.look;
    if (const auto adapt = section->text("adapt"))
        note(*section, "adapt", [&] { look.adapt = parse_adaptation(*adapt); });
    if (const auto view = section->text("view")) {
        note(*section, "view", [&] { view_description(*view); });
        look.view = *view;
    }
    file_.output.alpha = section->flag("alpha").value_or(false);
    if (!section->is_text("exposure")) {
        look.exposure_stops = section->number("exposure", -20, 20).value_or(0);
    } else {
        file_.output.metered = section->required_text("exposure") == "metered";
        if (!file_.output.metered)
            section->problem("exposure", "'exposure' is another text",
                             "expected stops from -20 to 20, or \"metered\"");
    }
}

} // namespace tsuya::scene
