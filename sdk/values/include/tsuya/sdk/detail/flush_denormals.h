#pragma once
/// \file
/// Denormal numbers as 0 on one thread.

#include <cstdint>

namespace tsuya::detail {

/// While it lives, denormal numbers count as 0 on this thread: they are slow, to Embree above all,
/// and mean nothing in light transport. Does nothing on processors other than x86-64 and 64-bit
/// ARM.
class FlushDenormals {
  public:
    FlushDenormals();
    ~FlushDenormals();
    FlushDenormals(const FlushDenormals &) = delete;
    FlushDenormals &operator=(const FlushDenormals &) = delete;

  private:
    std::uint64_t saved_; ///< the control register before
};

} // namespace tsuya::detail
