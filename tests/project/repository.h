#pragma once
/// \file
/// The repository as text, for checks on its own sources and documents.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tsuya::project {

/// A text file of the repository.
struct TextFile {
    std::string path{}; ///< relative to the root, with `/`
    std::string text{};
};

/// Something that breaks a rule: `path:line: message`.
using Findings = std::vector<std::string>;

/// Every text file under `root` but those in build, out and dot folders of tools, sorted by path.
/// Files with a NUL byte or of more than 4 MB are data, not text, and are left out.
std::vector<TextFile> read_repository(const std::filesystem::path &root);

/// The root of the checkout that the tests were built from.
std::filesystem::path repository_root();

/// Lines without their ends.
std::vector<std::string> lines_of(std::string_view text);

/// A finding on a line counted from 0.
std::string finding(const TextFile &file, std::size_t line, std::string_view message);

/// All findings, one a line, for a message of a test.
std::string as_text(const Findings &findings);

bool is_cpp(std::string_view path);
bool is_markdown(std::string_view path);
/// Python, shell, CMake and TOML: comments start with `#`.
bool has_hash_comments(std::string_view path);

} // namespace tsuya::project
