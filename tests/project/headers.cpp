#include "project/headers.h"

#include <algorithm>

namespace tsuya::project {
namespace {

bool is_public_header(const std::string &path) {
    return path.ends_with(".h") && path.find("/include/") != std::string::npos &&
           path.find("/detail/") == std::string::npos && !path.starts_with("tests/");
}

bool names(const std::string &text, const std::string &header) {
    return text.find("`" + header + "`") != std::string::npos ||
           text.find("/" + header + "`") != std::string::npos;
}

} // namespace

Findings check_headers(const std::vector<TextFile> &files) {
    Findings findings;
    for (const TextFile &file : files) {
        if (!is_public_header(file.path))
            continue;
        const std::string page = file.path.substr(0, file.path.find('/')) + "/README.md";
        const auto readme = std::ranges::find(files, page, &TextFile::path);
        const std::string name = file.path.substr(file.path.rfind('/') + 1);
        if (readme == files.end() || !names(readme->text, name))
            findings.push_back(finding(file, 0, page + " does not name this header"));
    }
    return findings;
}

} // namespace tsuya::project
