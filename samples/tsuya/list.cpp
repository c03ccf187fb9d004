// tsuya list: what can be named.

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

#include "command.h"
#include "json_file.h"
#include "tsuya/color/color_rendering.h"
#include "tsuya/color/config.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/lab/weave.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/studio_preset.h"
#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/model.h"

namespace tsuya::program {
namespace {

struct Entry {
    std::string name;
    std::string description;
    std::optional<LampFigures> figures{};
};

/// A number with some decimals, `-` where there is none; at the right of a column.
std::string column(const std::optional<double> &number, int decimals, std::size_t width) {
    std::ostringstream text;
    if (number)
        // Not "-0": rounded first
        text << std::fixed << std::setprecision(decimals)
             << std::round(*number * std::pow(10, decimals)) / std::pow(10, decimals) + 0.0;
    else
        text << '-';
    return std::string(width - std::min(width, text.str().size()), ' ') + text.str();
}

std::optional<double> kelvin_of(const LampFigures &figures) {
    return figures.temperature ? std::optional(figures.temperature->kelvin) : std::nullopt;
}

std::optional<double> duv_of(const LampFigures &figures) {
    return figures.temperature ? std::optional(figures.temperature->duv) : std::nullopt;
}

constexpr const char *kFigureNames = "     x      y    CCT     Duv    Ra   Rf   Rg";

std::string figures_text(const LampFigures &f) {
    return column(f.xy.x, 4, 6) + column(f.xy.y, 4, 7) + column(kelvin_of(f), 0, 7) +
           column(duv_of(f), 4, 8) + column(f.ra, 0, 6) + column(f.rf, 0, 5) + column(f.rg, 0, 5);
}

Json json_of(const Entry &entry) {
    Json json{{"name", entry.name}, {"description", entry.description}};
    if (!entry.figures)
        return json;
    const LampFigures &f = *entry.figures;
    const auto number = [](const std::optional<double> &value) {
        return value ? Json(*value) : Json(nullptr);
    };
    json["x"] = f.xy.x;
    json["y"] = f.xy.y;
    json["cct_k"] = number(kelvin_of(f));
    json["duv"] = number(duv_of(f));
    json["ra"] = number(f.ra);
    json["rf"] = number(f.rf);
    json["rg"] = number(f.rg);
    return json;
}

struct List final : Command {
    std::string kind{};
    bool json = false;
    std::filesystem::path data{}, output{};

    void options(Options &o) override {
        o.argument(&kind, "KIND", "kind of thing")
            .required()
            .one_of({"lamps", "fabrics", "weaves", "dyes", "models", "views", "displays", "studios",
                     "config"});
        o.flag("--json", &json, "print the names as JSON");
        o.option("--data", &data, "DIR", "folder of the sample data");
        o.option("-o,--output", &output, "FILE.ocio",
                 "file for `tsuya list config`; else it is printed")
            .result({".ocio"})
            .check([this] {
                if (!output.empty() && kind != "config")
                    throw Error({"only `tsuya list config` writes a file", "", "expected none"});
            });
        o.example("tsuya list lamps\n"
                  "tsuya list config -o tsuya.ocio");
        o.notes(
            "Lamps: chromaticity, correlated colour temperature in K, distance from the Planckian "
            "locus, colour rendering index Ra, fidelity and gamut index Rf and Rg of TM-30. "
            "D4000 to D25000, 500K to 100000K and mixtures are known, too.\n"
            "Config: the OpenColorIO config of the program's pictures, with displays, views and a "
            "look "
            "for each lamp, for --ocio and for other programs.");
    }

    Status run(Console &) override {
        if (kind == "config")
            return write_config();
        const std::vector<Entry> list = entries();
        if (json) {
            Json named{{"schema", "tsuya-list 1"}, {"kind", kind}, {"entries", Json::array()}};
            for (const Entry &entry : list)
                named["entries"].push_back(json_of(entry));
            std::cout << named.text() << "\n";
            return kDone;
        }
        std::size_t width = 0;
        for (const Entry &entry : list)
            width = std::max(width, entry.name.size());
        if (kind == "lamps")
            std::cout << std::string(width + 2, ' ') << kFigureNames << "\n";
        for (const Entry &entry : list)
            std::cout << entry.name << std::string(width + 2 - entry.name.size(), ' ')
                      << (entry.figures ? figures_text(*entry.figures) + "  " : "")
                      << entry.description << "\n";
        return kDone;
    }

    Status write_config() const {
        const DisplayConfig config = full_config();
        if (output.empty()) {
            std::cout << config.text();
            return kDone;
        }
        scene::prepare_output_file(output);
        config.save(output);
        std::cout << output.string() << "\n";
        return kDone;
    }

    template <class Describe>
    static std::vector<Entry> described(const std::vector<std::string> &names, Describe describe) {
        std::vector<Entry> list;
        for (const std::string &name : names)
            list.push_back({name, describe(name)});
        return list;
    }

    static std::string weave_description(const std::string &name) {
        const lab::Weave weave = lab::weave(name);
        std::ostringstream text;
        text << "repeat of " << weave.draft.ends << " ends and " << weave.draft.picks << " picks, "
             << weave.warp.per_cm << " ends/cm and " << weave.weft.per_cm << " picks/cm, "
             << lab::name_of(weave.warp.material);
        return text.str();
    }

    static std::string description_of(const Fabric &fabric) {
        const auto material = fabric.keys.find("material");
        std::string what = material == fabric.keys.end() ? fabric.name : material->second;
        if (fabric.colours.any_dye())
            what += ", dyed";
        const auto lustre = static_cast<std::size_t>(fabric.colours.lustre);
        return lustre == 0 ? what : what + ", " + std::string(kLustreNames[lustre]);
    }

    /// Those with tables, other names for them, and sets.
    static std::vector<Entry> lamps() {
        std::vector<Entry> list = described(lamp_names(), lamp_description);
        for (const LampAlias &alias : lamp_aliases())
            list.push_back({alias.name, lamp_description(alias.name)});
        for (Entry &entry : list)
            entry.figures = lamp_figures(lamp(entry.name));
        for (const LampSet &set : lamp_sets()) {
            std::string members;
            for (const std::string &member : set.lamps)
                members += (members.empty() ? "" : ", ") + member;
            list.push_back({set.name, "a set: " + members});
        }
        return list;
    }

    std::vector<Entry> entries() const {
        if (kind == "lamps")
            return lamps();
        if (kind == "dyes")
            return described(dye_names(), dye_description);
        if (kind == "views")
            return described(view_names(), view_description);
        if (kind == "displays")
            return described(display_names(), display_description);
        if (kind == "studios")
            return described(scene::studio_names(), scene::studio_description);
        if (kind == "weaves")
            return described(lab::weave_names(), weave_description);
        if (kind == "fabrics") {
            const std::filesystem::path folder = scene::data_folder(data);
            return described(scene::sample_fabrics(folder), [&](const std::string &name) {
                return description_of(read_fabric(scene::find_fabric(name, folder)));
            });
        }
        std::vector<Entry> models;
        for (const ModelName &model : model_names())
            models.push_back({std::string(model.name), std::string(model.description)});
        return models;
    }
};

} // namespace

std::unique_ptr<Command> make_list() { return std::make_unique<List>(); }

} // namespace tsuya::program
