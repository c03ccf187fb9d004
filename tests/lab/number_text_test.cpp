#include "tsuya/lab/number_text.h"

#include <gtest/gtest.h>

namespace tsuya::lab {
namespace {

TEST(NumberText, HasNoMoreDigitsThanNeeded) {
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(number_text(45), "45");
    EXPECT_EQ(number_text(-2.0 / 3), "-0.666667");
    EXPECT_EQ(number_text(2.0 / 3, 2), "0.67");
    EXPECT_EQ(number_text(1e-6), "1e-06");
    EXPECT_EQ(number_text(123456789, 9), "123456789");
}

} // namespace
} // namespace tsuya::lab
