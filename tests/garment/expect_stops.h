#pragma once
/// \file
/// Long work ends soon after it is asked to stop.

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::test {

using Work = std::function<void(const Progress &)>;

inline std::vector<std::string> stages_of(const Work &work) {
    std::vector<std::string> stages;
    work({.report = [&](std::string_view stage, double) {
        if (stages.empty() || stages.back() != stage)
            stages.emplace_back(stage);
    }});
    return stages;
}

/// The flag is set at the first report of each stage in turn: the work has to end in that stage.
inline void expect_stops_in_every_stage(const Work &work,
                                        const std::vector<std::string> &expected) {
    const std::vector<std::string> stages = stages_of(work);
    EXPECT_EQ(stages, expected);
    for (std::size_t n = 0; n < stages.size(); ++n) {
        std::atomic<bool> stop = false;
        std::vector<std::string> seen;
        const Progress progress{.report =
                                    [&](std::string_view stage, double) {
                                        if (seen.empty() || seen.back() != stage)
                                            seen.emplace_back(stage);
                                        stop = stop || seen.size() == n + 1;
                                    },
                                .stop = &stop};
        EXPECT_THROW(work(progress), Interrupted) << stages[n];
        EXPECT_EQ(seen.size(), n + 1) << "went on to " << seen.back();
    }
}

} // namespace tsuya::test
