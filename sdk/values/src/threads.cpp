#include "tsuya/sdk/detail/threads.h"

#include <algorithm>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

namespace tsuya::detail {

void run_with_threads(int threads, const std::function<void()> &work) {
    if (threads <= 0) {
        work();
        return;
    }
    // More threads than processors must be allowed before an arena can have them
    const tbb::global_control limit(
        tbb::global_control::max_allowed_parallelism,
        static_cast<std::size_t>(std::max(threads, tbb::info::default_concurrency())));
    tbb::task_arena arena(threads);
    arena.execute([&] { work(); });
}

} // namespace tsuya::detail
