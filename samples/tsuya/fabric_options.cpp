#include "fabric_options.h"

#include <algorithm>

#include "tsuya/scene/data_folder.h"
#include "tsuya/sdk/error.h"

namespace tsuya::program {
namespace {

/// `PANELS=FABRIC`, or `FABRIC` for all.
struct FabricWord {
    std::string panels, fabric;

    explicit FabricWord(const std::string &word) {
        const std::size_t at = word.rfind('=');
        fabric = at == std::string::npos ? word : word.substr(at + 1);
        panels = at == std::string::npos ? "" : word.substr(0, at);
        if (fabric.empty() || (at != std::string::npos && panels.empty()))
            throw Error({"'" + word + "' has no " + (fabric.empty() ? "fabric" : "panels"), "",
                         "expected FABRIC, or PANELS=FABRIC"});
    }
};

} // namespace

void FabricOptions::add_to(Options &o) {
    o.option("--fabric", &fabrics_, "[PANELS=]FABRIC",
             "F.fabric.toml, or a name of `tsuya list fabrics`; with PANELS= of some panels alone, "
             "see notes; may be given again")
        .check([this] { check(fabrics_); });
    o.option("--back", &backs_, "[PANELS=]FABRIC",
             "what is seen from behind, such as a lining; may be given again")
        .check([this] { check(backs_); });
}

void FabricOptions::add_data(Options &o) {
    o.option("--data", &data_, "DIR", "folder of the sample data");
}

std::string FabricOptions::notes() {
    return "PANELS is the name of a panel, object, group, material or UV island as `tsuya garment "
           "check` lists them; * stands for any letters, ? for one: --fabric black_satin --fabric "
           "\"Button*=plastic\". The last that names a panel counts. Panels of their own keep "
           "their own dye.";
}

void FabricOptions::fill(scene::TryOn &job) const {
    const auto find = [&](const std::string &name) {
        return scene::find_fabric(name, data_folder());
    };
    for (const std::string &word : fabrics_) {
        const FabricWord cloth(word);
        if (cloth.panels.empty())
            job.fabric = find(cloth.fabric);
        else
            job.panels.push_back({.panels = cloth.panels, .fabric = find(cloth.fabric)});
    }
    if (job.fabric.empty())
        job.fabric = scene::find_fabric("black_satin", data_folder(true));
    for (const std::string &word : backs_) {
        const FabricWord cloth(word);
        if (cloth.panels.empty())
            job.back = find(cloth.fabric);
        else
            job.panels.push_back({.panels = cloth.panels, .back = find(cloth.fabric)});
    }
}

/// Throws Error for a word that is no cloth, two cloths for all panels, and a name that no sample
/// fabric has. Where there is no sample data, the run says so.
void FabricOptions::check(const std::vector<std::string> &words) const {
    std::size_t for_all = 0;
    for (const std::string &word : words) {
        const FabricWord cloth(word);
        if (cloth.panels.empty() && ++for_all > 1)
            throw Error({"two fabrics for all panels, the second is " + cloth.fabric, "",
                         "expected one, and others as PANELS=FABRIC"});
        std::filesystem::path folder;
        try {
            folder = data_folder();
        } catch (const Error &) {
            continue;
        }
        scene::find_fabric(cloth.fabric, folder);
    }
}

std::filesystem::path FabricOptions::data_folder(bool wanted) const {
    const auto is_name = [](const std::string &word) { return !word.ends_with(".toml"); };
    return wanted || std::ranges::any_of(fabrics_, is_name) || std::ranges::any_of(backs_, is_name)
               ? scene::data_folder(data_)
               : std::filesystem::path{};
}

} // namespace tsuya::program
