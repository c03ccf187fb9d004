#include "project/repository.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

namespace tsuya::project {
namespace {

constexpr std::uintmax_t kMaxTextBytes = 4u << 20;

bool ends_with_any(std::string_view path, std::initializer_list<std::string_view> endings) {
    return std::any_of(endings.begin(), endings.end(),
                       [&](std::string_view ending) { return path.ends_with(ending); });
}

/// `.git` is a folder in a clone and a file in a further work tree.
bool is_left_out(const std::filesystem::path &entry) {
    static constexpr std::array<std::string_view, 5> kNames{".git", ".cache", "build", "out",
                                                            "__pycache__"};
    const std::string name = entry.filename().string();
    return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

} // namespace

std::vector<TextFile> read_repository(const std::filesystem::path &root) {
    std::vector<TextFile> files;
    const std::filesystem::recursive_directory_iterator end;
    for (auto entry = std::filesystem::recursive_directory_iterator(root); entry != end; ++entry) {
        if (is_left_out(entry->path())) {
            entry.disable_recursion_pending();
            continue;
        }
        // Others may be editing: a file can be gone by now.
        std::error_code gone;
        if (!entry->is_regular_file(gone) || entry->file_size(gone) > kMaxTextBytes)
            continue;
        std::ostringstream text;
        text << std::ifstream(entry->path(), std::ios::binary).rdbuf();
        if (text.str().find('\0') == std::string::npos)
            files.push_back({entry->path().lexically_relative(root).generic_string(), text.str()});
    }
    std::sort(files.begin(), files.end(),
              [](const TextFile &a, const TextFile &b) { return a.path < b.path; });
    return files;
}

std::filesystem::path repository_root() { return TSUYA_REPOSITORY; }

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    std::istringstream stream{std::string(text)};
    for (std::string line; std::getline(stream, line);) {
        if (line.ends_with('\r'))
            line.pop_back();
        lines.push_back(std::move(line));
    }
    return lines;
}

std::string finding(const TextFile &file, std::size_t line, std::string_view message) {
    return file.path + ':' + std::to_string(line + 1) + ": " + std::string(message);
}

std::string as_text(const Findings &findings) {
    std::string text;
    for (const std::string &one : findings)
        text += one + '\n';
    return text;
}

bool is_cpp(std::string_view path) { return ends_with_any(path, {".h", ".cpp", ".hpp", ".inl"}); }

bool is_markdown(std::string_view path) { return path.ends_with(".md"); }

bool has_hash_comments(std::string_view path) {
    return ends_with_any(path, {".py", ".sh", ".cmake", "CMakeLists.txt", ".toml"});
}

} // namespace tsuya::project
