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

class ListCommand final : public Command {
  public:
    explicit ListCommand(CLI::App &program)
        : app_(*program.add_subcommand("list", "What can be named")) {
        app_.footer("Example:\n  tsuya list lamps");
        app_.add_option("kind", kind_, "lamps, fabrics, weaves, dyes, models or views")
            ->required()
            ->check(CLI::IsMember({"lamps", "fabrics", "weaves", "dyes", "models", "views"}));
        app_.add_flag("--json", json_, "As JSON");
        app_.add_option("--data", data_, "Folder of the sample data");
    }

    bool called() const override { return app_.parsed(); }

    Status run(Console &) override {
        const std::vector<Entry> list = entries();
        if (json_) {
            Json json{{"schema", "tsuya-list 1"}, {"kind", kind_}, {"entries", Json::array()}};
            for (const Entry &entry : list)
                json["entries"].push_back(
                    {{"name", entry.name}, {"description", entry.description}});
            std::cout << json.dump(2) << "\n";
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

  private:
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

    std::vector<Entry> entries() const {
        if (kind_ == "lamps")
            return described(lamp_names(), lamp_description);
        if (kind_ == "dyes")
            return described(dye_names(), dye_description);
        if (kind_ == "views")
            return described(view_names(), view_description);
        if (kind_ == "weaves")
            return described(lab::weave_names(), weave_description);
        if (kind_ == "fabrics") {
            const std::filesystem::path data = scene::data_folder(data_);
            return described(scene::sample_fabrics(data), [&](const std::string &name) {
                const Fabric fabric = read_fabric(scene::find_fabric(name, data));
                const auto material = fabric.keys.find("material");
                return material == fabric.keys.end() ? fabric.name : material->second;
            });
        }
        std::vector<Entry> models;
        for (const ModelName &model : model_names())
            models.push_back({std::string(model.name), std::string(model.description)});
        return models;
    }

    CLI::App &app_;
    std::string kind_{};
    bool json_ = false;
    std::filesystem::path data_{};
};

} // namespace

std::unique_ptr<Command> make_list(CLI::App &program) {
    return std::make_unique<ListCommand>(program);
}

} // namespace tsuya::program
