#include "tsuya/scene/output_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::scene {
namespace {

namespace fs = std::filesystem;

std::string joined(const std::vector<std::string> &words) {
    std::string text;
    for (const std::string &word : words)
        text += (text.empty() ? "" : " or ") + word;
    return text;
}

[[noreturn]] void refuse_folder(const fs::path &folder, const std::string &what) {
    throw Error({what, folder.string(), "expected a folder that may be written to"});
}

// The folder or, where it is missing, the first one above that is there.
fs::path nearest_folder(const fs::path &folder) {
    std::error_code code;
    fs::path there = folder.empty() ? fs::path(".") : folder;
    while (!fs::exists(there, code) && there.has_relative_path())
        there = there.parent_path().empty() ? fs::path(".") : there.parent_path();
    if (!fs::is_directory(there, code))
        throw Error({"it is a file", there.string(), "expected a folder, or a new name"});
    return there;
}

// The system's error number; 0: a file of that name can be written into the folder. Permissions
// alone do not tell: nobody may write into /proc, and names have a greatest length.
int try_writing(const fs::path &folder, const fs::path &name) {
    const fs::path part = folder / temporary_name(name);
    const int descriptor = ::open(part.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
    if (descriptor < 0)
        return errno;
    ::close(descriptor);
    ::unlink(part.c_str());
    return 0;
}

void create_folder(const fs::path &folder) {
    std::error_code code;
    fs::create_directories(folder.empty() ? fs::path(".") : folder, code);
    if (code)
        refuse_folder(folder, "the folder cannot be created: " + code.message());
}

} // namespace

std::string frame_suffix(std::size_t frame) {
    constexpr std::size_t kDigits = 4;
    const std::string digits = std::to_string(frame);
    return "-" + std::string(digits.size() < kDigits ? kDigits - digits.size() : 0, '0') + digits;
}

void check_output_folder(const fs::path &folder) {
    const fs::path there = nearest_folder(folder);
    if (const int code = try_writing(there, "tsuya"); code != 0)
        refuse_folder(there, std::string("nothing can be written there: ") + std::strerror(code));
}

OutputFolder::OutputFolder(const fs::path &folder)
    : folder_(fs::absolute(folder.empty() ? fs::path(".") : folder).lexically_normal()) {
    check_output_folder(folder);
    if (!folder_.has_filename()) // it ended in a slash
        folder_ = folder_.parent_path();
    std::error_code code;
    for (fs::path at = folder_; !fs::exists(at, code); at = at.parent_path())
        ++created_;
    create_folder(folder);
}

OutputFolder::~OutputFolder() {
    std::error_code code;
    for (; created_ > 0 && fs::is_empty(folder_, code) && fs::remove(folder_, code); --created_)
        folder_ = folder_.parent_path();
}

void check_output_file(const fs::path &file, const std::vector<std::string> &extensions) {
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
    if (const int error = try_writing(nearest_folder(file.parent_path()), file.filename()))
        throw Error({std::string("the file cannot be written: ") + std::strerror(error),
                     file.string(), accepted_for_writing(error)});
}

void prepare_output_file(const fs::path &file, const std::vector<std::string> &extensions) {
    check_output_file(file, extensions);
    check_output_folder(file.parent_path());
    create_folder(file.parent_path());
}

} // namespace tsuya::scene
