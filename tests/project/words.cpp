#include "project/words.h"

#include <array>
#include <regex>

namespace tsuya::project {
namespace {

constexpr std::size_t kMaxLine = 2000;

struct Forbidden {
    std::regex pattern;
    std::string message;
    std::string allowed_in{}; ///< the one file that may say it
};

/// A path that starts with `folder`, as opposed to the middle of another path or of an address.
std::regex absolute(const std::string &folder) {
    return std::regex("(^|[^A-Za-z0-9_./-])/" + folder + "(/|[^A-Za-z0-9_.-]|$)");
}

} // namespace

// The words are put together here, as this file is checked, too.
Findings check_words(const std::vector<TextFile> &files) {
    const std::string machine = "a path of one machine";
    const std::array<Forbidden, 6> forbidden{{
        {absolute("work"), machine},
        {absolute("root"), machine},
        {absolute("home/[a-z]+"), machine},
        {absolute("Users/[A-Za-z]+"), machine},
        {absolute("tmp/build[A-Za-z0-9-]*"), machine},
        {std::regex("shared"
                    "/(data|cases)"),
         "outside data is known by TSUYA_TEST_DATA and TSUYA_TEST_CASES", ".ci/run"},
    }};
    Findings findings;
    for (const TextFile &file : files) {
        const std::vector<std::string> lines = lines_of(file.text);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            // Long lines are data, and std::regex recurses once for each character.
            if (lines[i].size() > kMaxLine || lines[i].find('/') == std::string::npos)
                continue;
            for (const Forbidden &word : forbidden)
                if (file.path != word.allowed_in && std::regex_search(lines[i], word.pattern))
                    findings.push_back(finding(file, i, word.message));
        }
    }
    return findings;
}

} // namespace tsuya::project
