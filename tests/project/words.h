#pragma once
/// \file
/// Words that a public repository does not say.

#include "project/repository.h"

namespace tsuya::project {

/// Findings on absolute paths of somebody's machine, and on folders of outside data, which tests
/// know by the variables TSUYA_TEST_DATA and TSUYA_TEST_CASES alone. `.ci/run` may look for them
/// beside the checkout.
Findings check_words(const std::vector<TextFile> &files);

} // namespace tsuya::project
