#pragma once
/// \file
/// Code in documents is cut from sources that are compiled and run.

#include "project/repository.h"

namespace tsuya::project {

/// Findings on the fenced code of Markdown files. Before a block, on a line of its own,
///
///     <!-- code: tests/lab/some_test.cpp [doc:name] -->
///
/// says that the block repeats the lines of that file between the marks `// [doc:name]` and
/// `// [/doc:name]`, or the first mark again (`#` in place of `//` for shell, CMake and TOML), each
/// alone on its line. Indentation of the whole, spaces at line ends and empty lines at both ends do
/// not count. Every block marked as cpp needs such a line, or `<!-- code: not compiled: REASON
/// -->`.
Findings check_documents(const std::vector<TextFile> &files);

} // namespace tsuya::project
