#include "tsuya/sdk/detail/flush_denormals.h"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace tsuya::detail {
namespace {

#if defined(__x86_64__)
constexpr std::uint64_t kFlush = 0x8040; // MXCSR: flush to zero, denormals are zero

std::uint64_t control() { return _mm_getcsr(); }
void set_control(std::uint64_t c) { _mm_setcsr(static_cast<unsigned>(c)); }
#elif defined(__aarch64__)
constexpr std::uint64_t kFlush = 1u << 24; // FPCR.FZ

std::uint64_t control() {
    std::uint64_t c;
    asm volatile("mrs %0, fpcr" : "=r"(c));
    return c;
}
void set_control(std::uint64_t c) { asm volatile("msr fpcr, %0" : : "r"(c)); }
#else
constexpr std::uint64_t kFlush = 0;

std::uint64_t control() { return 0; }
void set_control(std::uint64_t) {}
#endif

} // namespace

FlushDenormals::FlushDenormals() : saved_(control()) { set_control(saved_ | kFlush); }
FlushDenormals::~FlushDenormals() { set_control(saved_); }

} // namespace tsuya::detail
