#pragma once
/// \file
/// Each public header is listed in the README of its folder.

#include "project/repository.h"

namespace tsuya::project {

/// Findings on headers `FOLDER/**/include/**/NAME.h` that `FOLDER/README.md` does not name between
/// backquotes, alone or at the end of a path. Headers in a folder `detail` are insides.
Findings check_headers(const std::vector<TextFile> &files);

} // namespace tsuya::project
