#include "terrane/io/world_options.h"

#include <gtest/gtest.h>

#include "terrane/base/digest.h"

namespace terrane::io {
namespace {

TEST(SeedFrom, TakesAllWholeNumbersOf64Bits) {
    for (const std::string text : {"0", "7", "18446744073709551615"}) {
        const auto seed = seedFrom(text);
        ASSERT_TRUE(seed) << text;
        EXPECT_EQ(std::to_string(seed->seed), text);
        EXPECT_EQ(seed->text, "");
    }
}

TEST(SeedFrom, HashesOtherTexts) {
    for (const std::string text : {"my world", "7 ", "0x10", "1.5"}) {
        const auto seed = seedFrom(text);
        ASSERT_TRUE(seed) << text;
        EXPECT_EQ(seed->seed, base::hash64(text));
        EXPECT_EQ(seed->text, text);
    }
}

TEST(SeedFrom, RefusesNumbersOutOfRangeAndAnEmptyText) {
    for (const char* text : {"", "-1", "+5", "18446744073709551616"}) EXPECT_FALSE(seedFrom(text)) << text;
}

TEST(ThreadCount, IsThatOfTheMachineUnlessGiven) {
    WorldOptions options;
    EXPECT_GE(threadCount(options), 1u);
    options.threads = 3;
    EXPECT_EQ(threadCount(options), 3u);
}

}  // namespace
}  // namespace terrane::io
