#pragma once
/// \file
/// Lamp off and shutter closed, however a block of code is left.

#include "tsuya/lab/line.h"
#include "tsuya/sdk/error.h"

#include <vector>

namespace tsuya::lab {

/// Drives its lines inactive when it goes out of scope. Lamps come first in the list.
class OffGuard {
  public:
    /// \param lines null entries are ignored; all must outlive the guard
    explicit OffGuard(std::vector<OutputLine *> lines) : lines_(std::move(lines)) {}
    OffGuard(const OffGuard &) = delete;
    OffGuard &operator=(const OffGuard &) = delete;
    /// Drives off what `drive_off` has not; silent, as a destructor must be.
    ~OffGuard();

    /// Drives every line inactive, also when one of them fails, which is tried again `kAttempts`
    /// times in all.
    /// \return one problem for each line that may still be on; empty when all are off
    std::vector<Problem> drive_off();

    static constexpr int kAttempts = 3;

  private:
    std::vector<OutputLine *> lines_;
};

} // namespace tsuya::lab
