#include "terrane/gen/generators/biomes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "terrane/gen/generators/catalogue.h"
#include "tests/world/content_blocks.h"

namespace terrane::gen {
namespace {

TEST(BiomeMap, GeneratorsWithNamesOfBiomesHaveThem) {
    for (const CatalogueEntry& entry : builtInGenerators())
        EXPECT_EQ(BiomeMap::create(entry.name, contentBlocks(), 1).has_value(), !entry.biomes.empty())
            << entry.name;
    EXPECT_FALSE(BiomeMap::create("no such generator", contentBlocks(), 1));
    EXPECT_FALSE(biomesOf("continents").empty());
    EXPECT_FALSE(biomesOf("wilderness").empty());
}

// Places some kilometers apart differ, and the same place does not.
TEST(BiomeMap, NamesTheBiomeOfAColumn) {
    for (const CatalogueEntry& entry : builtInGenerators()) {
        if (entry.biomes.empty()) continue;
        SCOPED_TRACE(entry.name);
        auto map = BiomeMap::create(entry.name, contentBlocks(), 1);
        ASSERT_TRUE(map);
        std::set<std::string> seen;
        for (int k = 0; k < 12; ++k) seen.emplace(map->at(k * 3000 - 16000, 2000 - k * 2500));
        EXPECT_GE(seen.size(), 3u);
        for (const std::string& name : seen)
            EXPECT_NE(std::ranges::find(entry.biomes, name), entry.biomes.end()) << name;
        const std::string there(map->at(-7, 33));
        map->at(5000, 5000);
        EXPECT_EQ(map->at(-7, 33), there);
    }
}

}  // namespace
}  // namespace terrane::gen
