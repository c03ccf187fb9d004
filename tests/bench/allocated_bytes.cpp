#include "bench/allocated_bytes.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::size_t> bytes = 0;
} // namespace

void *operator new(std::size_t size) {
    bytes += size;
    if (void *const made = std::malloc(std::max<std::size_t>(size, 1)))
        return made;
    throw std::bad_alloc();
}
void operator delete(void *made) noexcept { std::free(made); }
void operator delete(void *made, std::size_t) noexcept { std::free(made); }

std::size_t tsuya::allocated_bytes() { return bytes; }
