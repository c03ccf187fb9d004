#pragma once
/// \file
/// Rows of a picture shared among threads.

#include <cstddef>
#include <functional>

namespace tsuya {

/// Calls `work(first_row, end_row)` for parts of [0, height) on the threads of the caller's arena
/// (see run_with_threads); exceptions pass through. Small pictures stay on the calling thread. No
/// value may depend on where a part ends: then the results do not depend on the threads.
void for_rows(int height, std::size_t values_a_row,
              const std::function<void(int first_row, int end_row)> &work);

} // namespace tsuya
