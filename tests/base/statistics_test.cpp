#include "terrane/base/statistics.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace terrane::base {
namespace {

TEST(Median, IsTheMiddle) {
    EXPECT_EQ(medianOf({7.0}), 7);
    EXPECT_EQ(medianOf({9.0, 1.0, 2.0}), 2);
    EXPECT_EQ(medianOf({4.0, 100.0, 1.0, 2.0}), 3);
}

TEST(Median, NothingHasNone) {
    EXPECT_THROW(medianOf({}), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::base
