/// read_weave(): a weave from TOML or from a Weaving Information File.
#include <glm/gtc/color_space.hpp>

#include "tsuya/lab/weave.h"
#include "tsuya/lab/wif.h"
#include "tsuya/sdk/document.h"
#include "tsuya/sdk/error.h"
#include "wif_text.h"

namespace tsuya::lab {
namespace {

/// Runs `check` and notes its problems at a key.
template <class Check> void note(const Section &section, std::string_view key, Check check) {
    try {
        check();
    } catch (const Error &error) {
        section.problem(key, error);
    }
}

FilamentSection parse_section(const std::string &name) {
    const std::vector<std::string> names{"round", "triangular", "trilobal"};
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == name)
            return static_cast<FilamentSection>(i);
    throw Error({"unknown filament section \"" + name + "\"", "", accepted_names(name, names)});
}

void read_transmission(const Section &section, Yarn &yarn) {
    const auto values = section.numbers("transmission");
    if (!values)
        return;
    for (std::size_t i = 0; i < values->size(); ++i)
        if (values->size() != 3 || (*values)[i] < 0 || (*values)[i] > 1) {
            section.problem("transmission", "not three shares",
                            "expected [red, green, blue], each 0 to 1");
            return;
        }
    if (values->size() == 3)
        yarn.transmission = {(*values)[0], (*values)[1], (*values)[2]};
}

// A name or micrometres.
void read_lustre(const Section &section, Yarn &yarn) {
    if (section.is_text("lustre")) {
        const auto name = section.text("lustre");
        note(section, "lustre", [&] { yarn.scattering_length = scattering_length(*name, ""); });
    } else if (const auto length = section.number("lustre", 0.1, 1e6)) {
        yarn.scattering_length = *length * 1e-6;
    }
}

void read_yarn(const Section &section, Yarn &yarn) {
    yarn.per_cm = section.number("per_cm", 1, 500).value_or(yarn.per_cm);
    yarn.width = section.number("width_mm", 0.001, 10).value_or(yarn.width * 1e3) * 1e-3;
    yarn.flattening = section.number("flattening", 0.02, 1).value_or(yarn.flattening);
    yarn.filaments = section.integer("filaments", 1, 500).value_or(yarn.filaments);
    if (const auto name = section.text("section"))
        note(section, "section", [&] { yarn.section = parse_section(*name); });
    yarn.corner_rounding = section.number("corner_rounding", 0, 1).value_or(yarn.corner_rounding);
    yarn.twist_per_m = section.number("twist_per_m", -4000, 4000).value_or(yarn.twist_per_m);
    yarn.tension = section.number("tension", 0.01, 100).value_or(yarn.tension);
    if (const auto name = section.text("material")) {
        yarn.refractive_index.reset();
        note(section, "material", [&] { yarn.material = parse_fiber_material(*name); });
    }
    if (const auto index = section.number("refractive_index", 1, 3))
        yarn.refractive_index = *index;
    yarn.surface_roughness =
        section.number("surface_roughness", 0, 1).value_or(yarn.surface_roughness);
    read_lustre(section, yarn);
    read_transmission(section, yarn);
    if (yarn.width > kMostPressed * yarn.spacing())
        section.problem(section.has("width_mm") ? "width_mm" : "per_cm",
                        "yarns " + std::to_string(yarn.width * 1e3) + " mm wide lie " +
                            std::to_string(yarn.spacing() * 1e3) + " mm apart",
                        "expected a width_mm of at most 20 / per_cm");
}

/// Rows of a drawdown as printed, the last pick first.
Draft parse_plan(const std::vector<std::string> &rows) {
    constexpr std::string_view kUp = "Xx#1", kDown = ".-0 ";
    Draft draft{
        rows.empty() ? 0 : static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), {}};
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
        if (row->size() != rows[0].size())
            throw Error({"rows of different length", "", "expected one letter for each end"});
        for (const char c : *row) {
            if ((kUp.find(c) == kUp.npos) == (kDown.find(c) == kDown.npos))
                throw Error({"'" + std::string(1, c) + "' in a plan", "",
                             "expected X where the warp is above and . where the weft is"});
            draft.warp_up.push_back(kUp.find(c) != kUp.npos ? 1 : 0);
        }
    }
    return draft;
}

void read_draft(const Section &section, Weave &weave) {
    const auto name = section.text("draft");
    const auto plan = section.texts("plan");
    if (name && plan)
        section.problem("plan", "both a draft and a plan", "expected one of them");
    if (name)
        note(section, "draft", [&] { weave.draft = parse_draft(*name); });
    if (plan)
        note(section, "plan", [&] {
            weave.draft = parse_plan(*plan);
            check_draft(weave.draft, "");
            weave.draft = smallest_repeat(weave.draft);
        });
    if (!name && !plan && !section.has("preset"))
        section.problem("", "no draft, plan or preset", "expected one of them");
}

Weave read_toml(const std::filesystem::path &file) {
    const Document document(file);
    const Section root = document.root();
    Weave result = weave("polyester taffeta");
    result.name = file.stem().string();
    if (const auto section = root.section("weave")) {
        if (const auto preset = section->text("preset"))
            note(*section, "preset", [&] { result = weave(*preset); });
        result.name = section->text("name").value_or(result.name);
        read_draft(*section, result);
    } else {
        root.problem("weave", "section [weave] is missing",
                     "expected [weave] with a draft, plan or preset");
    }
    if (const auto section = root.section("warp"))
        read_yarn(*section, result.warp);
    if (const auto section = root.section("weft"))
        read_yarn(*section, result.weft);
    document.finish();
    check_weave(result, file.string());
    return result;
}

void apply(const WifYarns &yarns, Yarn &yarn) {
    if (yarns.spacing) {
        // The same cloth at another scale: a file tells how far threads lie apart, not what they
        // are.
        yarn.width *= *yarns.spacing / yarn.spacing();
        yarn.per_cm = 0.01 / *yarns.spacing;
    }
    if (yarns.color.empty())
        return;
    glm::dvec3 sum(0);
    for (const glm::dvec3 &color : yarns.color)
        sum += glm::convertSRGBToLinear(color);
    sum /= static_cast<double>(yarns.color.size());
    yarn.transmission = {sum.x, sum.y, sum.z};
}

} // namespace

Weave read_weave(const std::filesystem::path &file) {
    if (detail::lower_case(file.extension().string()) != ".wif")
        return read_toml(file);
    const Wif wif = read_wif(file);
    Weave result = weave("polyester taffeta");
    result.name = wif.title.empty() ? file.stem().string() : wif.title;
    result.draft = wif.draft;
    apply(wif.warp, result.warp);
    apply(wif.weft, result.weft);
    check_weave(result, file.string());
    return result;
}

} // namespace tsuya::lab
