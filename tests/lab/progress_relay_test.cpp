#include "tsuya/lab/progress_relay.h"

#include <gtest/gtest.h>

#include <future>
#include <stdexcept>
#include <vector>

namespace tsuya::lab {
namespace {

TEST(ProgressRelay, DeliversInOrderBeforeItEnds) {
    std::vector<double> told;
    {
        ProgressRelay relay({.report = [&](std::string_view stage, double fraction) {
            EXPECT_EQ(stage, "pulses");
            told.push_back(fraction);
        }});
        const Progress progress = relay.progress();
        for (const double fraction : {0.0, 0.5, 1.0})
            progress("pulses", fraction);
    }
    EXPECT_EQ(told, (std::vector<double>{0.0, 0.5, 1.0}));
}

// The receiver blocks until all were reported: a relay that waited for it would never end.
TEST(ProgressRelay, IsNotHeldUpByAReceiverThatBlocks) {
    std::promise<void> resume;
    std::vector<double> told;
    {
        ProgressRelay relay({.report = [&](std::string_view, double fraction) {
            if (told.empty())
                resume.get_future().wait();
            told.push_back(fraction);
        }});
        const Progress progress = relay.progress();
        for (int i = 0; i < 10'000; ++i)
            progress("pulses", i);
        resume.set_value();
    }
    // The one that was being received, and the newest that fit into the queue.
    ASSERT_LE(told.size(), 1 + ProgressRelay::kCapacity);
    EXPECT_EQ(told.back(), 9'999);
    EXPECT_EQ(told[told.size() - 2], 9'998);
}

TEST(ProgressRelay, SurvivesAReceiverThatThrows) {
    ProgressRelay relay(
        {.report = [](std::string_view, double) { throw std::runtime_error("anything"); }});
    for (int i = 0; i < 1'000; ++i)
        relay.progress()("pulses", 0.0);
}

TEST(ProgressRelay, PassesTheStopFlagAndNoReceiverOn) {
    const std::atomic<bool> stop{true};
    ProgressRelay relay({.stop = &stop});
    EXPECT_TRUE(relay.progress().stopped());
    EXPECT_FALSE(relay.progress().report);
}

} // namespace
} // namespace tsuya::lab
