#include "new_file.h"

#include <system_error>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya {

NewFile::NewFile(std::filesystem::path target)
    : target_(std::move(target)), temporary_(temporary_name(target_)) {
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

} // namespace tsuya
