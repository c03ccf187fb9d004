#include "project/documents.h"

#include <algorithm>
#include <optional>
#include <regex>

namespace tsuya::project {
namespace {

using Lines = std::vector<std::string>;

std::string trimmed(const std::string &line) {
    const std::size_t begin = line.find_first_not_of(" \t");
    return begin == std::string::npos
               ? ""
               : line.substr(begin, line.find_last_not_of(" \t") - begin + 1);
}

/// Without common indentation, spaces at ends, and empty lines at both ends.
Lines normalized(Lines lines) {
    std::size_t indentation = std::string::npos;
    for (std::string &line : lines) {
        line.erase(line.find_last_not_of(" \t") + 1);
        if (!line.empty())
            indentation = std::min(indentation, line.find_first_not_of(' '));
    }
    for (std::string &line : lines)
        line.erase(0, line.empty() ? 0 : indentation);
    while (!lines.empty() && lines.back().empty())
        lines.pop_back();
    while (!lines.empty() && lines.front().empty())
        lines.erase(lines.begin());
    return lines;
}

/// The lines between the marks, or what is wrong with the marks.
std::optional<Lines> cut(const TextFile &file, const std::string &name, std::string &problem) {
    const auto is_mark = [&](const std::string &line, const std::string &mark) {
        const std::string text = trimmed(line);
        return text == "// [" + mark + "]" || text == "# [" + mark + "]";
    };
    Lines inside;
    int opened = 0;
    int closed = 0;
    for (const std::string &line : lines_of(file.text)) {
        const bool mark = is_mark(line, "doc:" + name);
        if (is_mark(line, "/doc:" + name) || (mark && opened > closed))
            ++closed;
        else if (mark)
            ++opened;
        else if (opened > closed)
            inside.push_back(line);
    }
    if (opened == 1 && closed == 1)
        return inside;
    problem = file.path + " has " + std::to_string(opened) + " opening and " +
              std::to_string(closed) + " closing marks doc:" + name;
    return std::nullopt;
}

struct Block {
    std::size_t fence = 0; ///< line of the opening fence
    std::string language{};
    std::string announced{}; ///< what the `code:` comment before it says; empty without one
    Lines lines{};
};

std::vector<Block> blocks_of(const TextFile &file) {
    static const std::regex kAnnounce(R"re(^\s*<!-- code: (.*\S) -->\s*$)re");
    std::vector<Block> blocks;
    std::string announced;
    bool inside = false;
    const Lines lines = lines_of(file.text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string line = trimmed(lines[i]);
        std::smatch match;
        if (line.starts_with("```")) {
            inside = !inside;
            if (inside)
                blocks.push_back({i, line.substr(3), announced, {}});
            announced.clear();
        } else if (inside) {
            blocks.back().lines.push_back(lines[i]);
        } else if (std::regex_match(line, match, kAnnounce)) {
            announced = match[1];
        } else if (!line.empty()) {
            announced.clear();
        }
    }
    return blocks;
}

/// What is wrong with a block; empty if nothing is.
std::string problem_of(const Block &block, const std::vector<TextFile> &files) {
    static const std::regex kSource(R"re((\S+) \[doc:([a-z0-9_-]+)\])re");
    if (block.announced.empty())
        return block.language == "cpp" ? "C++ without a `code:` comment before it" : "";
    if (block.announced.starts_with("not compiled: "))
        return "";
    std::smatch match;
    if (!std::regex_match(block.announced, match, kSource))
        return "`code: " + block.announced + "` is not `path [doc:name]`";
    const auto source = std::find_if(files.begin(), files.end(), [&](const TextFile &file) {
        return file.path == match[1].str();
    });
    if (source == files.end())
        return "there is no file " + match[1].str();
    std::string problem;
    const std::optional<Lines> expected = cut(*source, match[2], problem);
    if (!expected)
        return problem;
    const Lines wanted = normalized(*expected);
    const Lines got = normalized(block.lines);
    const auto differ = std::mismatch(wanted.begin(), wanted.end(), got.begin(), got.end());
    if (differ.first == wanted.end() && differ.second == got.end())
        return "";
    const auto text = [](const auto &it, const Lines &all) {
        return it == all.end() ? std::string("(the end)") : "`" + *it + "`";
    };
    return "differs from " + match[1].str() + " in line " +
           std::to_string(differ.second - got.begin() + 1) +
           " of the block: " + text(differ.second, got) + " in place of " +
           text(differ.first, wanted);
}

} // namespace

Findings check_documents(const std::vector<TextFile> &files) {
    Findings findings;
    for (const TextFile &file : files) {
        if (!is_markdown(file.path))
            continue;
        for (const Block &block : blocks_of(file))
            if (const std::string problem = problem_of(block, files); !problem.empty())
                findings.push_back(finding(file, block.fence, problem));
    }
    return findings;
}

} // namespace tsuya::project
