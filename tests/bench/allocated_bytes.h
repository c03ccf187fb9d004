#pragma once
// What this program has asked of the heap: the difference over a copy is the size of what was
// copied.

#include <cstddef>

namespace tsuya {

std::size_t allocated_bytes();

} // namespace tsuya
