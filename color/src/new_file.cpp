#include "new_file.h"

#include <fstream>
#include <random>
#include <system_error>

#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

// A random name: two processes, or two threads, may write the same target at once.
std::filesystem::path temporary_for(const std::filesystem::path &target) {
    std::random_device random;
    std::filesystem::path name = ".";
    name += target.stem();
    name += ".tmp" + std::to_string(random()) + std::to_string(random());
    name += target.extension(); // image writers choose the format by it
    return target.parent_path() / name;
}

} // namespace

NewFile::NewFile(std::filesystem::path target)
    : target_(std::move(target)), temporary_(temporary_for(target_)) {
    std::error_code ignored;
    const std::filesystem::path folder = target_.parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored))
        throw Error({"the folder of the file does not exist", target_.string(),
                     "expected a file in an existing folder"});
    if (target_.filename().empty() || std::filesystem::is_directory(target_, ignored))
        throw Error({"cannot write a file under the name of a folder", target_.string(),
                     "expected the name of a file"});
}

NewFile::~NewFile() {
    std::error_code ignored;
    if (!temporary_.empty())
        std::filesystem::remove(temporary_, ignored);
}

void NewFile::commit() {
    std::error_code code;
    std::filesystem::rename(temporary_, target_, code);
    if (code)
        throw Error({"cannot write the file: " + code.message(), target_.string(),
                     "expected a folder that may be written to"});
    temporary_.clear();
}

void write_text_file(const std::filesystem::path &path, const std::string &text) {
    NewFile file(path);
    {
        std::ofstream stream(file.temporary(), std::ios::binary);
        stream << text;
        stream.close();
        if (!stream)
            throw Error({"cannot write the file", path.string(),
                         "expected a folder that may be written to, with room"});
    }
    file.commit();
}

} // namespace tsuya
