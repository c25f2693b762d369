#include "terrane/formats/minecraft_chunk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "terrane/formats/block_mapping.h"

namespace terrane::formats {
namespace {

using testing::HasSubstr;

enum class Layout { Numbered, Crossing, Aligned, Root };

struct ChunkToWrite {
    Layout layout = Layout::Root;
    std::int8_t y = 0;
    std::vector<NamedState> palette;
    std::vector<std::uint16_t> blocks;
};

NbtTag paletteOf(const std::vector<NamedState>& palette) {
    NbtList list{10, {}};
    for (const NamedState& state : palette) {
        NbtCompound entry, properties;
        entry.add("Name", {state.name});
        for (const auto& [name, value] : state.properties) properties.add(name, {value});
        if (!state.properties.empty()) entry.add("Properties", {properties});
        list.tags.push_back({entry});
    }
    return {list};
}

// Packs bit by bit, as the format is described.
NbtTag packed(const std::vector<std::uint16_t>& blocks, std::size_t paletteSize, bool isAligned) {
    const auto bits = std::max<std::size_t>(4, static_cast<std::size_t>(std::bit_width(paletteSize - 1)));
    std::vector<std::uint64_t> words(isAligned ? (4096 + 64 / bits - 1) / (64 / bits) : 64 * bits);
    std::size_t bit = 0;
    for (const std::uint16_t value : blocks) {
        if (isAligned && bit % 64 + bits > 64) bit += 64 - bit % 64;
        for (std::size_t k = 0; k < bits; ++k, ++bit)
            words[bit / 64] |= std::uint64_t{(value >> k & 1u) != 0} << bit % 64;
    }
    return {std::vector<std::int64_t>(words.begin(), words.end())};
}

NbtCompound nbtOf(const ChunkToWrite& chunk) {
    NbtCompound root, level, section;
    section.add("Y", {chunk.y});
    if (chunk.layout == Layout::Root) {
        NbtCompound states;
        states.add("palette", paletteOf(chunk.palette));
        if (chunk.palette.size() > 1) states.add("data", packed(chunk.blocks, chunk.palette.size(), true));
        section.add("block_states", {states});
    } else {
        section.add("Palette", paletteOf(chunk.palette));
        section.add("BlockStates",
                    packed(chunk.blocks, chunk.palette.size(), chunk.layout == Layout::Aligned));
    }
    const std::int32_t version = chunk.layout == Layout::Root      ? 2860
                                 : chunk.layout == Layout::Aligned ? 2529
                                                                   : 2528;
    root.add("DataVersion", {version});
    level.add("xPos", {std::int32_t{-5}}).add("zPos", {std::int32_t{7}});
    level.add(chunk.layout == Layout::Root ? "sections" : "Sections", {NbtList{10, {{section}}}});
    if (chunk.layout != Layout::Root) return root.add("Level", {level});
    level.add("DataVersion", {version});
    return level;
}

LegacyIds idsOf(std::string_view toml) {
    auto ids = LegacyIds::parse(toml, "ids.toml");
    EXPECT_TRUE(ids) << ids.error().message;
    return ids ? *ids : LegacyIds();
}

std::string chunkError(const NbtCompound& root) {
    const auto chunk = decodeAnvilChunk(root, LegacyIds());
    return chunk ? "" : chunk.error().message;
}

TEST(AnvilChunk, ReadsRandomSectionsOfEachLayout) {
    std::mt19937 random(11);
    for (const std::size_t size : {1u, 2u, 16u, 17u, 33u, 300u, 1100u}) {
        for (const Layout layout : {Layout::Crossing, Layout::Aligned, Layout::Root}) {
            ChunkToWrite chunk{layout, static_cast<std::int8_t>(random() % 24 - 4u), {}, {}};
            for (std::size_t k = 0; k < size; ++k)
                chunk.palette.push_back({"minecraft:b" + std::to_string(k), {{"p", std::to_string(k % 3)}}});
            for (int k = 0; k < kAnvilSectionBlocks; ++k)
                chunk.blocks.push_back(static_cast<std::uint16_t>(random() % size));
            const auto read = decodeAnvilChunk(nbtOf(chunk), LegacyIds());
            ASSERT_TRUE(read) << read.error().message;
            EXPECT_EQ(read->x, -5);
            EXPECT_EQ(read->z, 7);
            ASSERT_EQ(read->sections.size(), 1u);
            const AnvilSection& section = read->sections[0];
            EXPECT_EQ(section.y, chunk.y);
            EXPECT_EQ(section.palette, chunk.palette);
            for (std::size_t k = 0; k < 4096; ++k)
                ASSERT_EQ(section.blocks.empty() ? 0 : section.blocks[k], chunk.blocks[k])
                    << size << " at " << k;
        }
    }
}

TEST(AnvilChunk, ReadsNumbersOfOldWorlds) {
    const LegacyIds ids = idsOf("[ids]\n0 = 'air'\n1 = ['stone', 'granite']\n300 = 'mod:b[facing=east]'\n");
    std::string low(4096, '\0'), data(2048, '\0'), high(2048, '\0');
    low[0] = 1;  // stone
    low[1] = 1;  // granite
    data[0] = 1 << 4;
    low[4095] = 44;  // 256 + 44
    high[2047] = 1 << 4;
    low[17] = 7;  // unknown
    NbtCompound section, level, root;
    section.add("Y", {std::int8_t{3}}).add("Blocks", {NbtBytes{low}}).add("Data", {NbtBytes{data}});
    section.add("Add", {NbtBytes{high}});
    level.add("xPos", {std::int32_t{0}}).add("zPos", {std::int32_t{0}});
    level.add("Sections", {NbtList{10, {{section}}}});
    const auto chunk = decodeAnvilChunk(root.add("Level", {level}), ids);
    ASSERT_TRUE(chunk) << chunk.error().message;
    const auto at = [&](std::size_t k) {
        const AnvilSection& s = chunk->sections[0];
        return textOf(s.palette[s.blocks[k]]);
    };
    EXPECT_EQ(at(0), "minecraft:stone");
    EXPECT_EQ(at(1), "minecraft:granite");
    EXPECT_EQ(at(2), "minecraft:air");
    EXPECT_EQ(at(17), "minecraft:id_7_0");
    EXPECT_EQ(at(4095), "mod:b[facing=east]");
}

TEST(AnvilChunk, TellsWhatIsBroken) {
    const ChunkToWrite good{Layout::Root, 0, {{"a", {}}, {"b", {}}}, std::vector<std::uint16_t>(4096, 1)};
    EXPECT_EQ(chunkError(nbtOf(good)), "");
    ChunkToWrite bad = good;
    bad.blocks[9] = 3;
    EXPECT_THAT(chunkError(nbtOf(bad)), HasSubstr("no entry"));
    bad = good;
    bad.blocks.resize(10);
    NbtCompound root = nbtOf(bad);
    EXPECT_EQ(chunkError(root), "");  // words of zeros
    EXPECT_THAT(chunkError(nbtOf({Layout::Root, 0, {}, {}})), HasSubstr("palette is empty"));
    EXPECT_THAT(chunkError(nbtOf({Layout::Root, 0, {{"", {}}}, {}})), HasSubstr("no name"));
    EXPECT_THAT(chunkError(NbtCompound()), HasSubstr("no position"));
}

TEST(AnvilChunk, KnowsWhatMinecraftHasNotFinished) {
    NbtCompound root = nbtOf({Layout::Root, 0, {{"a", {}}}, {}});
    root.add("Status", {std::string("minecraft:noise")});
    EXPECT_FALSE(decodeAnvilChunk(root, LegacyIds())->isFinished);
    root = nbtOf({Layout::Root, 0, {{"a", {}}}, {}});
    root.add("Status", {std::string("minecraft:full")});
    NbtCompound chest;
    chest.add("id", {std::string("minecraft:chest")});
    root.add("block_entities", {NbtList{10, {{chest}, {chest}}}});
    const auto chunk = decodeAnvilChunk(root, LegacyIds());
    EXPECT_TRUE(chunk->isFinished);
    EXPECT_EQ(chunk->blockEntities.at("minecraft:chest"), 2);
}

TEST(LegacyIds, TakesDataOfEightLessWhereTheListEnds) {
    const LegacyIds ids = idsOf("[ids]\n5 = ['a', 'b', 'c']\n");
    EXPECT_EQ(ids.stateOf(5, 9).name, "minecraft:b");
    EXPECT_EQ(ids.stateOf(5, 7).name, "minecraft:a");
    EXPECT_FALSE(LegacyIds::parse("[ids]\nx = 'a'", "t"));
    EXPECT_FALSE(LegacyIds::parse("[ids]\n4096 = 'a'", "t"));
    EXPECT_FALSE(LegacyIds::parse("[ids]\n4 = []", "t"));
    EXPECT_FALSE(LegacyIds::parse("ids = 4", "t"));
    const auto builtIn = builtInLegacyIds();
    ASSERT_TRUE(builtIn) << builtIn.error().message;
    EXPECT_EQ(textOf(builtIn->stateOf(53, 6)), "minecraft:oak_stairs[facing=south,half=top]");
}

}  // namespace
}  // namespace terrane::formats
