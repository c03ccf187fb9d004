#include "project/links.h"

#include "project/comments.h"

#include <filesystem>
#include <regex>

namespace tsuya::project {
namespace {

/// The path that a link leads to, relative to the root; empty for an address or an anchor.
std::string target_of(const std::string &document, const std::string &link) {
    static const std::regex kScheme(R"re(^[a-z]+:)re");
    const std::string path = link.substr(0, link.find('#'));
    if (path.empty() || std::regex_search(path, kScheme))
        return "";
    std::string target =
        (std::filesystem::path(document).parent_path() / path).lexically_normal().generic_string();
    if (target.ends_with('/'))
        target.pop_back();
    return target;
}

} // namespace

Findings check_links(const std::vector<TextFile> &files,
                     const std::function<bool(const std::string &)> &exists) {
    static const std::regex kLink(R"re(\]\(([^()\s]+)\))re");
    Findings findings;
    for (const TextFile &file : files) {
        if (!is_markdown(file.path))
            continue;
        const std::vector<std::string> lines = lines_of(markdown_prose(file.text));
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const std::sregex_iterator end;
            for (std::sregex_iterator it(lines[i].begin(), lines[i].end(), kLink); it != end;
                 ++it) {
                const std::string target = target_of(file.path, (*it)[1]);
                if (!target.empty() && (target.starts_with("..") || !exists(target)))
                    findings.push_back(finding(file, i, "there is no " + target));
            }
        }
    }
    return findings;
}

} // namespace tsuya::project
