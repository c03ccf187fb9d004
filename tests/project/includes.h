#pragma once
/// \file
/// Which layer may include what.

#include "project/repository.h"

namespace tsuya::project {

/// Findings on the #include lines of sources and headers of the six folders:
/// - a layer (sdk/values, sdk/reflectance, ..., tests) includes itself and layers below it;
/// - `src` of a layer is its own, but tests/sdk may look into that of sdk's layers, and so on; a
///   room in it (such as garment's mesh, files, repair, limit) does not include one above;
/// - headers of other projects appear only in sources (not headers in `include/`) of the layer
///   that owns them, but GLM everywhere.
Findings check_includes(const std::vector<TextFile> &files);

} // namespace tsuya::project
