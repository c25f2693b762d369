#include "terrane/gen/generators/biomes.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/world/content_blocks.h"

namespace terrane::gen {
namespace {

TEST(BiomeMap, OnlyContinentsHaveBiomes) {
    EXPECT_FALSE(BiomeMap::create("flat", contentBlocks(), 1));
    EXPECT_FALSE(BiomeMap::create("no such generator", contentBlocks(), 1));
    EXPECT_TRUE(BiomeMap::create("continents", contentBlocks(), 1));
}

// Places some kilometers apart differ, and the same place does not.
TEST(BiomeMap, NamesTheBiomeOfAColumn) {
    auto map = BiomeMap::create("continents", contentBlocks(), 1);
    ASSERT_TRUE(map);
    std::set<std::string> seen;
    for (int k = 0; k < 12; ++k) seen.emplace(map->at(k * 3000 - 16000, 2000 - k * 2500));
    EXPECT_GE(seen.size(), 3u);
    EXPECT_FALSE(seen.contains(""));
    const std::string there(map->at(-7, 33));
    map->at(5000, 5000);
    EXPECT_EQ(map->at(-7, 33), there);
}

}  // namespace
}  // namespace terrane::gen
