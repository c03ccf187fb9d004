#pragma once
/// \file
/// Which folder may include what.

#include "project/repository.h"

namespace tsuya::project {

/// Findings on the #include lines of sources and headers of the six folders:
/// - sdk knows no other folder; garment and color know sdk; lab knows color and sdk; samples know
///   these four; nothing but tests knows tests;
/// - `src` of a folder is its own, but tests/sdk may look into sdk/src, and so on;
/// - headers of other projects appear only in sources (not headers in `include/`) of the folder
///   that owns them, but GLM everywhere.
Findings check_includes(const std::vector<TextFile> &files);

} // namespace tsuya::project
