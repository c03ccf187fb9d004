#pragma once
/// \file
/// The child's side of run_supervised().

#include "tsuya/lab/supervisor.h"

namespace tsuya::lab::detail {

/// Runs the work, says how it ended, and ends the process without running any destructor of the
/// caller's.
[[noreturn]] void be_worker(WorkerPipes &pipes, const std::function<void(Worker &)> &work);

} // namespace tsuya::lab::detail
