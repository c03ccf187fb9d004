#pragma once
/// \file
/// How many threads a piece of work gets.

#include <functional>

namespace tsuya::detail {

/// Runs `work` so that what it does in parallel uses `threads` threads, more than the machine has
/// processors too; 0: those of the caller's own arena, all if there is none. Exceptions pass
/// through.
void run_with_threads(int threads, const std::function<void()> &work);

} // namespace tsuya::detail
