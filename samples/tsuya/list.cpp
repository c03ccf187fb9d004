// tsuya list: what can be named.

#include <algorithm>
#include <iostream>
#include <sstream>

#include "command.h"
#include "json_file.h"
#include "tsuya/color/config.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/lab/weave.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/model.h"

namespace tsuya::program {
namespace {

struct Entry {
    std::string name;
    std::string description;
};

struct List final : Command {
    std::string kind{};
    bool json = false;
    std::filesystem::path data{};

    void options(Options &o) override {
        o.argument(&kind, "KIND", "kind of thing")
            .required()
            .one_of({"lamps", "fabrics", "weaves", "dyes", "models", "views"});
        o.flag("--json", &json, "print the names as JSON");
        o.option("--data", &data, "DIR", "folder of the sample data");
        o.example("tsuya list lamps");
    }

    Status run(Console &) override {
        const std::vector<Entry> list = entries();
        if (json) {
            Json named{{"schema", "tsuya-list 1"}, {"kind", kind}, {"entries", Json::array()}};
            for (const Entry &entry : list)
                named["entries"].push_back(
                    {{"name", entry.name}, {"description", entry.description}});
            std::cout << named.text() << "\n";
            return kDone;
        }
        std::size_t width = 0;
        for (const Entry &entry : list)
            width = std::max(width, entry.name.size());
        for (const Entry &entry : list)
            std::cout << entry.name << std::string(width + 2 - entry.name.size(), ' ')
                      << entry.description << "\n";
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

    std::vector<Entry> entries() const {
        if (kind == "lamps")
            return described(lamp_names(), lamp_description);
        if (kind == "dyes")
            return described(dye_names(), dye_description);
        if (kind == "views")
            return described(view_names(), view_description);
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
