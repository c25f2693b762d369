#include "terrane/gen/generators/catalogue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "terrane/base/digest.h"
#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

using testing::HasSubstr;

TEST(Catalogue, NamesTheGeneratorsThatComeWithTerrane) {
    const std::vector<std::string> names = namesOf(builtInGenerators());
    EXPECT_THAT(names, testing::IsSupersetOf({"overworld", "flat"}));
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size()) << "each name once";
}

TEST(Catalogue, EveryGeneratorIsWithoutMistakes) {
    for (const std::string& name : namesOf(builtInGenerators())) {
        const auto graph = makeGenerator(name, contentBlocks());
        ASSERT_TRUE(graph.has_value()) << graph.error().message;
        EXPECT_EQ(graph->name, name);
        EXPECT_FALSE(graph->passes.empty());
        EXPECT_TRUE(graph->passes.back().is3D);
    }
}

// Clouds float as high over every sea but where ranges are tall: there peaks are above them.
TEST(Catalogue, CloudsFloatOverTheSea) {
    EXPECT_EQ(airLevelsOf("continents"), world::AirLevels());
    EXPECT_EQ(airLevelsOf("a pack's"), world::AirLevels());
    const world::AirLevels tall = airLevelsOf("wilderness");
    EXPECT_EQ(tall.sea, 0);
    EXPECT_GT(tall.clouds, 360);
    EXPECT_LT(tall.clouds, 1000);
}

// Highest water, of the sea wherever there is one, is at the sea level that maps and the like are told.
TEST(Catalogue, SeasHaveTheSeaLevelOfTheirGenerator) {
    EXPECT_EQ(seaLevelOf("continents"), kSeaLevel);
    EXPECT_EQ(seaLevelOf("a pack's"), kSeaLevel);
    for (const CatalogueEntry& entry : builtInGenerators()) {
        EXPECT_EQ(seaLevelOf(entry.name), entry.seaLevel);
        const Generator generator(makeGenerator(entry.name, contentBlocks(), 6).value(), kTestSeed);
        const auto named = [&](const world::Chunk& chunk, int z) {
            return contentBlocks().type(chunk.block(world::blockIndex(8, 8, z))).name;
        };
        int seas = 0, openWater = 0;  // columns where the sea is highest; where other water is
        for (int k = 0; k < 64; ++k) {
            const world::Chunk chunk = generator.generate({k % 8 * 5 - 20, k / 8 * 5 - 20, 6});
            int z = chunk.heights().top - 1;
            while (z > chunk.heights().bottom && named(chunk, z) == "air") --z;
            const bool isWater = named(chunk, z) == "water" || named(chunk, z) == "ice";
            seas += isWater && z == entry.seaLevel;
            openWater += isWater && z != entry.seaLevel;
        }
        EXPECT_GE(seas, 4 * openWater) << entry.name;
        if (entry.biomes.empty()) continue;
        EXPECT_GT(seas, 6) << entry.name;
    }
}

// Fields are bytes to maps and to Python.
TEST(Catalogue, BiomesHaveNamesAndAField) {
    for (const CatalogueEntry& entry : builtInGenerators()) {
        const auto names = biomesOf(entry.name);
        EXPECT_LE(names.size(), 256u);
        const std::set<std::string_view> different(names.begin(), names.end());
        EXPECT_EQ(different.size(), names.size()) << entry.name << ": each name once";
        EXPECT_FALSE(different.contains("")) << entry.name;
        if (names.empty()) continue;
        const GeneratorGraph graph = makeGenerator(entry.name, contentBlocks()).value();
        EXPECT_NE(std::ranges::find(graph.fields, "biome", &FieldInfo::name), graph.fields.end());
    }
    EXPECT_TRUE(biomesOf("underworld").empty());
}

TEST(Catalogue, AnUnknownNameListsTheKnownOnes) {
    const auto graph = makeGenerator("underworld", contentBlocks());
    ASSERT_FALSE(graph.has_value());
    EXPECT_THAT(graph.error().message, HasSubstr("unknown generator \"underworld\""));
    for (const std::string& name : namesOf(builtInGenerators()))
        EXPECT_THAT(graph.error().message, HasSubstr(name));
}

// Chunks by the names of their blocks: the ids may change with the content file.
std::string digestOf(const Generator& generator, const std::vector<ChunkPos>& chunks) {
    base::Digest digest;
    std::map<BlockId, std::uint16_t> numbers;  // of the blocks in the order in which they are met
    for (const ChunkPos pos : chunks) {
        for (const BlockId id : blocksOf(generator.generate(pos))) {
            const auto [number, isNew] = numbers.try_emplace(id, static_cast<std::uint16_t>(numbers.size()));
            if (isNew) digest.update(contentBlocks().type(id).name);
            digest.update(std::as_bytes(std::span(&number->second, 1)));
        }
    }
    return digest.hex();
}

Generator builtIn(const std::string& name, int level) {
    return Generator(makeGenerator(name, contentBlocks(), level).value(), kTestSeed);
}

std::string digestOf(const std::string& name, int level, std::int32_t count) {
    std::vector<ChunkPos> chunks;
    for (std::int32_t k = 0; k < count; ++k)
        chunks.push_back({53 * k - 500, 700 - 71 * k, static_cast<std::uint8_t>(level)});
    return digestOf(builtIn(name, level), chunks);
}

struct Pinned {
    int version;
    std::string digest;
};

TEST(Catalogue, AVersionAlwaysMakesTheSameBlocks) {
    const std::map<std::string, Pinned> pinned = {{"overworld", {2, "247563b3f32dad0f2eae5650c6696f48"}},
                                                  {"continents", {1, "a61ec06520ea6cdd07760639d97609bb"}},
                                                  {"wilderness", {1, "975f88d50d685df7bb95adb4ccd08c7e"}},
                                                  {"flat", {1, "4d68fdbedf2c769f7ee583e97eec48d1"}},
                                                  {"hills3d", {1, "80f368ad4c46696c44247587b0ba3ac9"}},
                                                  {"voronoi", {1, "4b6e6a3b3283b87d7c6373b014117425"}}};
    for (const std::string& name : namesOf(builtInGenerators())) {
        const std::string digest = digestOf(name, 0, 20);
        EXPECT_TRUE(pinned.contains(name)) << name << " is new: pin its digest " << digest;
        if (!pinned.contains(name)) continue;
        EXPECT_EQ(digest, pinned.at(name).digest)
            << "the generator " << name
            << " makes other blocks than before: raise its version in catalogue.cpp, "
            << "or saves mix chunks that do not fit together, and pin version and digest here";
        EXPECT_EQ(versionOf(builtInGenerators(), name), pinned.at(name).version)
            << name << " has a new version: pin it here, with its digest";
    }
}

// Land that the chunks above have not got: a lake and its shores, a river that falls through a gorge.
TEST(Catalogue, WatersStayAsTheyAre) {
    const auto digest = [](const std::string& name, ChunkPos first, std::int32_t step) {
        std::vector<ChunkPos> chunks;
        for (std::int32_t k = 0; k < 81; ++k)
            chunks.push_back({first.x + k % 9 * step, first.y + k / 9 * step});
        return digestOf(builtIn(name, 0), chunks);
    };
    EXPECT_EQ(digest("continents", {360, 228}, 4), "b1f30039135d15b9721929ec3a6e9d30");
    EXPECT_EQ(digest("wilderness", {-60, 213}, 1), "97b333a1a1349faabd0ee085b4dd0ce3");
}

// The first digits of the digests of levels 1 to 15.
std::string farDigestsOf(const std::string& name) {
    std::string digests;
    for (int level = 1; level <= world::kMaxLevel; ++level) {
        digests += (level == 1 ? "" : " ") + digestOf(name, level, 6).substr(0, 6);
    }
    return digests;
}

TEST(Catalogue, AVersionAlwaysMakesTheSameTiles) {
    const std::map<std::string, std::string> pinned = {
        {"overworld",
         "1b4772 f2129d 426e24 981adf b653aa 921e03 9b7d42 75dad5 8a05c2 f96f31 05973b bcbfcb db2d73 8db91f "
         "1f0195"},
        {"continents",
         "6ab4bb c2c7c3 280303 fa6296 b203c5 af28de 6fce05 68bd81 effa8c 926bc0 fedd7a 11c855 beca2e 7df9de "
         "9d7cf4"},
        {"wilderness",
         "bbf024 8b053c d4f3a0 792a75 18ba51 67b25b 87519f 8753e3 2d13cc eeabcb 7614f9 113056 8325b8 4583da "
         "18ea43"},
        {"flat",
         "c976ba c976ba c976ba c976ba c976ba c976ba c976ba c976ba c976ba c976ba c976ba c976ba c976ba c976ba "
         "c976ba"},
        {"hills3d",
         "11763e 8d30d2 45c5a1 359e49 c215b8 0e1a01 dfdcfe 2c01b0 e7b81d e7b81d e7b81d e7b81d e7b81d e7b81d "
         "e7b81d"},
        {"voronoi",
         "75aa40 4d5898 6ddf40 a068ba 44e6cd 4581b1 17a265 17a265 17a265 17a265 17a265 17a265 17a265 17a265 "
         "17a265"}};
    for (const std::string& name : namesOf(builtInGenerators())) {
        const std::string digests = farDigestsOf(name);
        EXPECT_TRUE(pinned.contains(name)) << name << " is new: pin its digests " << digests;
        if (!pinned.contains(name)) continue;
        EXPECT_EQ(digests, pinned.at(name)) << "the generator " << name
                                            << " makes other tiles than before: raise its version in "
                                               "catalogue.cpp, or far tiles that are stored do "
                                               "not fit beside those that are made, and pin the digests here";
    }
}

// A content file without the blocks a generator is made of: all that are missing are named at once.
TEST(Catalogue, BlocksThatTheContentLacksAreNamed) {
    const auto graph = makeGenerator("flat", parseBlocks(R"(
[[block]]
name = "stone"
shape = "cube"
texture = "stone"
)",
                                                         "little"));
    ASSERT_FALSE(graph.has_value());
    EXPECT_THAT(graph.error().message, HasSubstr("unknown block \"grass\""));
    EXPECT_THAT(graph.error().message, HasSubstr("unknown block \"dirt\""));
    EXPECT_THAT(graph.error().message, testing::Not(HasSubstr("\"stone\"")));
}

}  // namespace
}  // namespace terrane::gen
