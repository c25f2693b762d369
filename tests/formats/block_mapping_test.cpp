#include "terrane/formats/block_mapping.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "terrane/content/built_in.h"
#include "terrane/formats/minecraft_chunk.h"
#include "terrane/world/blocks/block_model.h"
#include "tests/support/default_heights.h"

namespace terrane::formats {
namespace {

using testing::HasSubstr;

class BlockMappingTest : public testing::Test {
  protected:
    // The block of a text as "name" or "name/state".
    std::string blockOf(std::string_view text) const {
        const auto state = namedState(text);
        EXPECT_TRUE(state) << text;
        const BlockAndState block = mapping.blockOf(*state);
        const std::string& name = blocks.type(block.id).name;
        return block.state == 0 ? name : name + "/" + std::to_string(block.state);
    }
    std::string nameOf(std::string_view block, std::uint16_t state = 0) const {
        return textOf(mapping.nameOf({blocks.find(block)->id, state}));
    }
    std::string errorOf(std::string_view toml) const {
        const std::vector<MappingFile> files{{toml, "my.toml"}};
        const auto read = BlockMapping::create(blocks, files);
        return read ? "" : read.error().message;
    }

    world::BlockRegistry blocks = *content::loadBlocks();
    BlockMapping mapping = *loadMapping(blocks, {});
};

TEST_F(BlockMappingTest, KnowsNames) {
    EXPECT_EQ(blockOf("minecraft:air"), "air");
    EXPECT_EQ(blockOf("stone"), "stone");
    EXPECT_EQ(blockOf("minecraft:grass_block[snowy=false]"), "grass");
    EXPECT_EQ(blockOf("minecraft:nothing_like_that"), "missing");
    EXPECT_FALSE(mapping.isKnown(*namedState("minecraft:nothing_like_that")));
    EXPECT_EQ(blockOf("minecraft:oak_slab[type=double,waterlogged=false]"), "oak_planks");
    EXPECT_EQ(blockOf("minecraft:snow[layers=8]"), "snow");
    EXPECT_EQ(blockOf("minecraft:snow[layers=2]"), "white_carpet");
}

// South is +y and facing 0; quarter turns go counterclockwise: east, north, west.
TEST_F(BlockMappingTest, TurnsAndHalves) {
    EXPECT_EQ(blockOf("oak_stairs[facing=north,half=bottom]"), "oak_stairs/2");
    EXPECT_EQ(blockOf("oak_stairs[facing=west,half=top]"), "oak_stairs/7");
    EXPECT_EQ(blockOf("oak_slab[type=top]"), "oak_slab/4");
    EXPECT_EQ(blockOf("oak_door[facing=east,half=upper,hinge=left,open=true]"), "oak_door_top/9");
    EXPECT_EQ(blockOf("ladder[facing=north]"), "ladder");
    EXPECT_EQ(blockOf("wall_torch[facing=east]"), "torch/11");
    EXPECT_EQ(blockOf("torch"), "torch");
    EXPECT_EQ(blockOf("oak_sign[rotation=8]"), "sign");
    EXPECT_EQ(blockOf("oak_fence[north=true,east=false,south=true,west=false]"), "oak_fence/192");
    EXPECT_EQ(blockOf("lantern[hanging=true]"), "lantern/4");
    EXPECT_EQ(blockOf("waxed_copper_lantern[hanging=true]"), "lantern/4");
    EXPECT_EQ(blockOf("copper_wall_torch[facing=east]"), "torch/11");
    EXPECT_EQ(blockOf("copper_bars[north=true,east=false,south=true,west=false]"),
              blockOf("iron_bars[north=true,east=false,south=true,west=false]"));
    EXPECT_EQ(blockOf("oak_fence_gate[facing=south,open=true]"), "oak_gate/8");
    EXPECT_EQ(blockOf("water[level=5]"), "water/5");
    EXPECT_EQ(blockOf("water[level=9]"), "water/8");
    EXPECT_EQ(blockOf("wheat[age=7]"), "wheat");
    EXPECT_EQ(blockOf("wheat[age=0]"), "wheat/3");
    EXPECT_EQ(blockOf("beetroots[age=3]"), "wheat") << "its last age";
    EXPECT_EQ(blockOf("nether_wart[age=0]"), "wheat/3");
}

TEST_F(BlockMappingTest, NamesComeBackAsTheSameBlockForEveryBlockAndState) {
    int named = 0;
    for (const world::BlockType& type : blocks.types()) {
        const int states = type.model ? type.model->stateMask + 1 : 16;
        for (int state = 0; state < states; ++state) {
            const BlockAndState block{type.id, static_cast<std::uint16_t>(state)};
            const NamedState name = mapping.nameOf(block);
            ASSERT_EQ(mapping.blockOf(name), block) << textOf(name);
            ASSERT_EQ(*namedState(textOf(name)), name);
            named += name.name.starts_with("minecraft:") ? 1 : 0;
        }
    }
    EXPECT_GT(named, 450);
}

TEST_F(BlockMappingTest, NamesAreMinecraftsWhereThereIsOne) {
    EXPECT_EQ(nameOf("stone"), "minecraft:stone");
    EXPECT_EQ(nameOf("oak_stairs", 5), "minecraft:oak_stairs[facing=east,half=top]");
    EXPECT_EQ(nameOf("torch", 9), "minecraft:wall_torch[facing=west]");
    EXPECT_EQ(nameOf("torch"), "minecraft:torch");
    EXPECT_EQ(nameOf("sign", 2), "minecraft:oak_sign[rotation=0]");
    EXPECT_EQ(nameOf("oak_planks"), "minecraft:oak_planks");
    EXPECT_EQ(nameOf("heather"), "terrane:heather");
    EXPECT_EQ(nameOf("stone", 3), "terrane:stone[state=3]");
    EXPECT_EQ(nameOf("wheat", 2), "minecraft:wheat[age=3]");
}

TEST_F(BlockMappingTest, EveryNumberOfOldWorldsIsKnown) {
    const LegacyIds ids = *builtInLegacyIds();
    int known = 0;
    for (int id = 0; id < 256; ++id) {
        const NamedState state = ids.stateOf(id, 0);
        if (state.name.starts_with("minecraft:id_")) continue;
        EXPECT_TRUE(mapping.isKnown(state)) << id << " " << textOf(state);
        ++known;
    }
    EXPECT_GT(known, 200);
}

TEST_F(BlockMappingTest, FilesOfTheUserComeFirst) {
    const std::vector<MappingFile> files{{"[blocks]\nstone = ['stone', 'oak_slab[type=double]']\n", "a.toml"},
                                         {"[blocks]\ndirt = ['stone', 'mod:x', 'mod:y[lit=true]']\nsand = "
                                          "['mod:y']\n[colors]\n'#ff0080' = 'sand'",
                                          "b.toml"}};
    const auto both = BlockMapping::create(blocks, files);
    ASSERT_TRUE(both) << both.error().message;
    const auto name = [&](std::string_view text) {
        return blocks.type(both->blockOf(*namedState(text)).id).name;
    };
    EXPECT_EQ(name("stone"), "dirt");
    EXPECT_EQ(name("mod:x"), "dirt");
    EXPECT_EQ(name("mod:y"), "sand");
    EXPECT_EQ(name("mod:y[lit=true,a=b]"), "dirt");
    EXPECT_EQ(name("mod:y[lit=false]"), "sand");
    EXPECT_EQ(both->colors().at(0xff0080), blocks.find("sand")->id);
}

TEST_F(BlockMappingTest, MistakesNameTheirLine) {
    EXPECT_THAT(errorOf("[blocks]\n\nnope = ['stone']"), HasSubstr("my.toml:3: nope: there is no block"));
    EXPECT_THAT(errorOf("[blocks]\nstone = 'stone'"), HasSubstr("my.toml:2: stone: expected a list"));
    EXPECT_THAT(errorOf("[blocks]\nstone = ['a[']"), HasSubstr("expected a name"));
    EXPECT_THAT(errorOf("[blocks]\nstone = [3]"), HasSubstr("expected a name"));
    EXPECT_THAT(errorOf("[blocks]\n'torch[' = ['a']"), HasSubstr("block state"));
    EXPECT_THAT(errorOf("[blocks]\n'torch[70000]' = ['a']"), HasSubstr("block state"));
    EXPECT_THAT(errorOf("[colors]\nred = 'stone'"), HasSubstr("#rrggbb"));
    EXPECT_THAT(errorOf("opposite = 3"), HasSubstr("list of blocks"));
    EXPECT_THAT(errorOf("x = 3"), HasSubstr("my.toml:1: x"));
    EXPECT_THAT(errorOf("= 3"), HasSubstr("my.toml:1"));
}

TEST(NamedState, ReadsTexts) {
    EXPECT_EQ(textOf(*namedState("a[z=1,b=2]")), "minecraft:a[b=2,z=1]");
    EXPECT_EQ(textOf(*namedState("m:a[]")), "m:a");
    for (const char* text : {"", "[a=b]", "a[", "a[b", "a[b]", "a[=b]", "a[b=c"})
        EXPECT_EQ(namedState(text), std::nullopt) << text;
}

// Minecraft's x, y, z are our -x, z, y.
TEST_F(BlockMappingTest, ChunksAreNotMirrored) {
    AnvilChunk chunk;
    chunk.x = 3;
    chunk.z = -4;
    AnvilSection section{-1, {{"minecraft:air", {}}, {"minecraft:stone", {}}, {"other:thing", {}}}, {}};
    section.blocks.assign(4096, 0);
    section.blocks[2 + 16 * 5 + 256 * 7] = 1;  // x 2, z 5, y -9
    section.blocks[0] = 2;                     // y -16
    chunk.sections = {section};
    ImportCounts counts;
    const world::Chunk made = toChunk(chunk, mapping, {.shift = 12}, counts);
    EXPECT_EQ(chunkPosOf(chunk), (world::ChunkPos{-4, -4}));
    EXPECT_EQ(made.block(world::blockIndex(13, 5, 3)), blocks.find("stone")->id);
    EXPECT_EQ(counts.blocks.at("minecraft:air"), 4094u);
    EXPECT_EQ(counts.unknown.at("other:thing"), 1u);
    EXPECT_EQ(counts.below, 1u);
    int solid = 0;
    for (int k = 0; k < world::kBlocksPerChunk; ++k)
        solid += made.block(static_cast<world::BlockIndex>(k)) != world::kAir ? 1 : 0;
    EXPECT_EQ(solid, 1);
    ImportCounts all;
    const world::Chunk whole = toChunk(chunk, mapping, {.heights = {-64, 320}}, all);
    EXPECT_EQ(whole.block(world::blockIndex(13, 5, -9)), blocks.find("stone")->id);
    EXPECT_EQ(whole.block(world::blockIndex(15, 0, -16)), blocks.missing());
    EXPECT_EQ(all.below + all.above, 0u);
}

TEST_F(BlockMappingTest, DoorsOfOldWorldsAreWhole) {
    AnvilChunk chunk;
    AnvilSection section{0,
                         {{"minecraft:air", {}},
                          *namedState("oak_door[half=lower,facing=east,open=true]"),
                          *namedState("oak_door[half=upper]")},
                         {}};
    section.blocks.assign(4096, 0);
    section.blocks[0] = 1;
    section.blocks[256] = 2;
    chunk.sections = {section};
    ImportCounts counts;
    const world::Chunk made = toChunk(chunk, mapping, {}, counts);
    EXPECT_EQ(made.blockState(world::blockIndex(15, 0, 0)), 9);
    EXPECT_EQ(made.blockState(world::blockIndex(15, 0, 1)), 9);
}

}  // namespace
}  // namespace terrane::formats
