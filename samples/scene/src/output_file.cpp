#include "tsuya/scene/output_file.h"

#include <algorithm>

#include <unistd.h>

#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

namespace fs = std::filesystem;

std::string joined(const std::vector<std::string> &words) {
    std::string text;
    for (const std::string &word : words)
        text += (text.empty() ? "" : " or ") + word;
    return text;
}

} // namespace

void prepare_output_folder(const fs::path &folder) {
    const fs::path path = folder.empty() ? fs::path(".") : folder;
    std::error_code code;
    if (fs::exists(path, code) && !fs::is_directory(path, code))
        throw Error({"it is a file", path.string(), "expected a folder, or a new name"});
    fs::create_directories(path, code);
    if (code)
        throw Error({"the folder cannot be created: " + code.message(), path.string(),
                     "expected a folder that may be written to"});
    if (access(path.c_str(), W_OK | X_OK) != 0)
        throw Error({"the folder may not be written to", path.string(),
                     "expected a folder that may be written to"});
}

void prepare_output_file(const fs::path &file, const std::vector<std::string> &extensions) {
    const std::string extension = file.extension().string();
    if (!extensions.empty() &&
        std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
        throw Error({extension.empty() ? "the name has no extension"
                                       : "files of type '" + extension + "' are not written here",
                     file.string(), "expected a name that ends in " + joined(extensions)});
    std::error_code code;
    if (file.empty() || fs::is_directory(file, code))
        throw Error({"it is a folder", file.string(), "expected the name of a file"});
    if (fs::exists(file, code) && access(file.c_str(), W_OK) != 0)
        throw Error({"the file may not be replaced", file.string(), "expected another name"});
    prepare_output_folder(file.parent_path());
}

} // namespace tsuya::scene
