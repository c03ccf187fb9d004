#pragma once
/// \file
/// Citations of papers and standards, such as the one of Takeda's fabric model.

#include "project/repository.h"

#include <set>

namespace tsuya::project {

/// Where the keys are defined, each by a list item that starts with the key in brackets and bold:
/// `- **[Key]** Author, "Title", ...`.
inline constexpr std::string_view kReferences = "sdk/docs/REFERENCES.md";

/// What the citations of a repository come to.
struct CitationReport {
    Findings findings{};            ///< citations without a definition, definitions given twice
    std::set<std::string> unused{}; ///< defined and never cited
    std::size_t citations = 0;
};

/// A citation is `[Key]`: two or more letters and digits, the first a capital letter, at the start
/// of a line or after a space or an opening bracket, and not before `(`, `[` or `:`, which make a
/// link. It is looked for in the comments of C++, in `#` comments, and in the prose of Markdown
/// outside code.
CitationReport check_citations(const std::vector<TextFile> &files);

} // namespace tsuya::project
