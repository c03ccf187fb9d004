#include "tsuya/scene/data_folder.h"

#include <algorithm>

#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

namespace fs = std::filesystem;

constexpr const char *kSuffix = ".fabric.toml";

bool holds_data(const fs::path &folder) {
    std::error_code code;
    return fs::is_regular_file(folder / "dress" / "dress.obj", code) &&
           fs::is_directory(folder / "fabrics", code);
}

} // namespace

fs::path data_folder(const fs::path &chosen) {
    const char *const accepted = "expected a folder with dress/dress.obj and fabrics/";
    if (!chosen.empty()) {
        if (!holds_data(chosen))
            throw Error({"the folder holds no sample data", chosen.string(), accepted});
        return chosen;
    }
    std::vector<fs::path> folders;
    std::error_code code;
    if (const fs::path program = fs::read_symlink("/proc/self/exe", code); !code)
        folders.push_back(program.parent_path().parent_path() / "share" / "tsuya");
    folders.emplace_back(TSUYA_INSTALLED_DATA);
    folders.emplace_back(TSUYA_SOURCE_DATA);
    std::string looked;
    for (const fs::path &folder : folders) {
        if (holds_data(folder))
            return folder;
        looked += (looked.empty() ? "" : ", ") + folder.string();
    }
    throw Error({"the sample data was not found; looked in " + looked, "data", accepted});
}

std::vector<std::string> sample_fabrics(const fs::path &data) {
    std::vector<std::string> names;
    std::error_code code;
    for (const fs::directory_entry &entry : fs::directory_iterator(data / "fabrics", code))
        if (const std::string name = entry.path().filename().string(); name.ends_with(kSuffix))
            names.push_back(name.substr(0, name.size() - std::string(kSuffix).size()));
    std::sort(names.begin(), names.end());
    return names;
}

fs::path find_fabric(const std::string &name, const fs::path &data) {
    if (name.ends_with(".toml"))
        return name;
    const std::vector<std::string> known = sample_fabrics(data);
    if (std::find(known.begin(), known.end(), name) == known.end())
        throw Error({"no sample fabric '" + name + "'", "fabric",
                     accepted_names(name, known) + "; or a file F.fabric.toml"});
    return data / "fabrics" / (name + kSuffix);
}

} // namespace tsuya::scene
