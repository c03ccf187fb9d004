// Fabrics of scene files, and pictures on cloth.

#include <algorithm>

#include "scene_reader.h"
#include "tsuya/color/dye.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::scene {
namespace {

// In the place of a dye: it is chosen in the finished picture.
constexpr const char *kAnyDye = "any";

} // namespace

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
        note(section, key, [&] {
            NamedDye dye = find_dye(*spec, folder_);
            add_warnings(dye.warnings);
            result = std::move(dye.spectrum);
        });
    return result;
}

std::optional<Spectrum> SceneReader::colour(const Section &section, const char *key) {
    if (section.is_text(key))
        return dyed(section, key);
    const auto constant = section.number(key, 0, 1);
    return constant ? std::optional(Spectrum::constant(*constant)) : std::nullopt;
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

void SceneReader::read_fabrics() {
    const auto fabrics = root_.section("fabrics");
    if (!fabrics)
        return;
    for (const auto &[name, section] : fabrics->sections()) {
        FabricEntry entry{
            .name = name, .where = section.where(), .file = existing_file(section, "file", false)};
        entry.open_dye = section.is_text("dye") && section.text("dye") == kAnyDye;
        if (entry.open_dye && section.has("reflectance"))
            section.problem("dye", "dye and reflectance are both given", "expected one of them");
        if (!entry.open_dye)
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

} // namespace tsuya::scene
