#pragma once
/// \file
/// Words that a public repository does not say.

#include "project/repository.h"

namespace tsuya::project {

/// Findings on absolute paths of somebody's machine, and on the folder of outside data, which tests
/// know by the variable TSUYA_TEST_DATA alone. `.ci/run` may look for it beside the checkout.
Findings check_words(const std::vector<TextFile> &files);

} // namespace tsuya::project
