#include "terrane/base/median.h"

#include <gtest/gtest.h>

namespace terrane::base {
namespace {

TEST(Median, IsTheMiddle) {
    EXPECT_EQ(medianOf({7.0}), 7);
    EXPECT_EQ(medianOf({9.0, 1.0, 2.0}), 2);
    EXPECT_EQ(medianOf({4.0, 100.0, 1.0, 2.0}), 3);
}

}  // namespace
}  // namespace terrane::base
