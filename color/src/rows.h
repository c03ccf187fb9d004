#pragma once
/// \file
/// Rows of a picture shared among threads.

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

namespace tsuya {

/// Calls `work(first_row, end_row)` for parts of [0, height) on all cores; the first exception of a
/// part is thrown again here. Small pictures stay on the calling thread.
template <class Work> void for_rows(int height, std::size_t values_a_row, const Work &work) {
    constexpr std::size_t kWorthAThread = 1u << 17;
    const std::size_t values = static_cast<std::size_t>(height) * values_a_row;
    const auto cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    const int parts =
        std::clamp(static_cast<int>(std::min<std::size_t>(values / kWorthAThread, 64)), 1, cores);
    std::vector<std::exception_ptr> failures(static_cast<std::size_t>(parts));
    const auto run = [&](int part) {
        try {
            work(height * part / parts, height * (part + 1) / parts);
        } catch (...) {
            failures[static_cast<std::size_t>(part)] = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> threads;
        for (int part = 1; part < parts; ++part)
            threads.emplace_back(run, part);
        run(0);
    }
    for (const std::exception_ptr &failure : failures)
        if (failure)
            std::rethrow_exception(failure);
}

} // namespace tsuya
