#pragma once
/// \file
/// Links between documents.

#include <functional>

#include "project/repository.h"

namespace tsuya::project {

/// Findings on relative links and pictures of Markdown files, `[text](path)` and `![text](path)`,
/// that lead to no file or folder of the repository. Code, addresses with a scheme, and anchors
/// within a page are left out.
/// \param exists whether there is something at a path relative to the root
Findings check_links(const std::vector<TextFile> &files,
                     const std::function<bool(const std::string &)> &exists);

} // namespace tsuya::project
