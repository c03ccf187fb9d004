#include "rows.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace tsuya {
namespace {

constexpr std::size_t kWorthATask = 1u << 17; // values

} // namespace

void for_rows(int height, std::size_t values_a_row, const std::function<void(int, int)> &work) {
    const std::size_t rows =
        std::max<std::size_t>(1, kWorthATask / std::max<std::size_t>(1, values_a_row));
    tbb::parallel_for(tbb::blocked_range<int>(0, height, rows),
                      [&](const tbb::blocked_range<int> &part) { work(part.begin(), part.end()); });
}

} // namespace tsuya
