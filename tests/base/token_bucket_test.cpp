#include "terrane/base/timing.h"

#include <gtest/gtest.h>

namespace terrane::base {
namespace {

TEST(TokenBucket, GivesSoManyASecond) {
    TokenBucket bucket(10, 5);
    TokenBucket::Time now{std::chrono::seconds(1)};
    for (int k = 0; k < 5; ++k) EXPECT_TRUE(bucket.take(1, now));
    EXPECT_FALSE(bucket.take(1, now));
    now += std::chrono::milliseconds(100);
    EXPECT_TRUE(bucket.take(1, now));
    EXPECT_FALSE(bucket.take(1, now));
    now += std::chrono::hours(1);
    EXPECT_FALSE(bucket.take(6, now)) << "no more than `most`";
    EXPECT_TRUE(bucket.take(5, now));
}

}  // namespace
}  // namespace terrane::base
