#include "terrane/io/world_options.h"

#include <gtest/gtest.h>

namespace terrane::io {
namespace {

TEST(ThreadCount, IsThatOfTheMachineUnlessGiven) {
    WorldOptions options;
    EXPECT_GE(threadCount(options), 1u);
    options.threads = 3;
    EXPECT_EQ(threadCount(options), 3u);
}

}  // namespace
}  // namespace terrane::io
