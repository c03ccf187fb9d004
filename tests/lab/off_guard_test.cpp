#include "tsuya/lab/off_guard.h"

#include "lab/failing_line.h"

#include <gtest/gtest.h>

namespace tsuya::lab {
namespace {

TEST(OffGuard, DrivesOffWhenAnExceptionPasses) {
    VirtualClock clock;
    SimulatedLine lamp("lamp", clock);
    try {
        const OffGuard guard({&lamp});
        lamp.set(true);
        throw std::runtime_error("anything");
    } catch (const std::runtime_error &) {
    }
    EXPECT_FALSE(lamp.active());
}

TEST(OffGuard, ALineThatFailsDoesNotKeepTheNextOn) {
    VirtualClock clock;
    FailingLine broken("broken", clock, 2, 1000);
    SimulatedLine lamp("lamp", clock);
    {
        const OffGuard guard({&broken, nullptr, &lamp});
        broken.set(true);
        lamp.set(true);
    }
    EXPECT_FALSE(lamp.active());
    EXPECT_EQ(broken.calls(), 1 + OffGuard::kAttempts);
}

TEST(OffGuard, ReportsWhatMayStillBeOnAndTriesAgain) {
    VirtualClock clock;
    FailingLine lamp("lamp", clock, 2, OffGuard::kAttempts);
    {
        OffGuard guard({&lamp});
        lamp.set(true);
        const std::vector<Problem> problems = guard.drive_off();
        ASSERT_EQ(problems.size(), 1u);
        EXPECT_EQ(problems[0].where, "lamp");
        EXPECT_TRUE(lamp.active());
    }
    EXPECT_FALSE(lamp.active()); // the destructor's attempt went through
}

TEST(OffGuard, DrivesOffOnce) {
    VirtualClock clock;
    SimulatedLine lamp("lamp", clock);
    OffGuard guard({&lamp});
    lamp.set(true);
    EXPECT_TRUE(guard.drive_off().empty());
    lamp.set(true);
    EXPECT_TRUE(guard.drive_off().empty());
    EXPECT_TRUE(lamp.active());
}

} // namespace
} // namespace tsuya::lab
