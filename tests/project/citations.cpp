#include "project/citations.h"

#include "project/comments.h"

#include <regex>

namespace tsuya::project {
namespace {

std::string readable_part(const TextFile &file) {
    if (is_cpp(file.path))
        return split_cpp(file.text).comments;
    if (is_markdown(file.path))
        return markdown_prose(file.text);
    if (has_hash_comments(file.path))
        return hash_comments(file.text);
    return "";
}

/// Keys and the line of their definition, counted from 0.
std::set<std::string> definitions(const TextFile &references, Findings &findings) {
    static const std::regex kDefinition(R"re(^- \*\*\[([A-Z][A-Za-z0-9]+)\]\*\* \S)re");
    std::set<std::string> keys;
    const std::vector<std::string> lines = lines_of(references.text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::smatch match;
        if (std::regex_search(lines[i], match, kDefinition) && !keys.insert(match[1]).second)
            findings.push_back(finding(references, i, match[1].str() + " is defined twice"));
    }
    return keys;
}

} // namespace

CitationReport check_citations(const std::vector<TextFile> &files) {
    static const std::regex kCitation(R"re((^|[\s(;,])\[([A-Z][A-Za-z0-9]+)\](?![(\[:]))re");
    CitationReport report;
    std::set<std::string> keys;
    for (const TextFile &file : files)
        if (file.path == kReferences)
            keys = definitions(file, report.findings);
    if (keys.empty())
        report.findings.push_back(std::string(kReferences) + ": defines no key");
    report.unused = keys;
    for (const TextFile &file : files) {
        if (file.path == kReferences)
            continue;
        const std::vector<std::string> lines = lines_of(readable_part(file));
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const std::sregex_iterator end;
            for (std::sregex_iterator it(lines[i].begin(), lines[i].end(), kCitation); it != end;
                 ++it) {
                const std::string key = (*it)[2];
                ++report.citations;
                report.unused.erase(key);
                if (!keys.contains(key))
                    report.findings.push_back(
                        finding(file, i, "[" + key + "] is not in " + std::string(kReferences)));
            }
        }
    }
    return report;
}

} // namespace tsuya::project
