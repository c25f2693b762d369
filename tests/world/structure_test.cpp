#include "terrane/world/changes/structure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "terrane/world/blocks/block_model.h"
#include "terrane/world/changes/block_edit.h"
#include "tests/world/content_blocks.h"

namespace terrane::world {
namespace {

class StructureTest : public testing::Test {
  protected:
    StructureTest() { world_.insert({0, 0}, std::make_shared<Chunk>()); }
    void put(BlockPos pos, std::string_view name, std::uint16_t state = 0,
             BlockEntityDataPtr data = nullptr) {
        const std::vector<PlacedBlock> block = {{pos, {contentBlock(name), state, std::move(data)}}};
        std::vector<BlockEdit> edits;
        restoreBlocks(world_, contentBlocks(), block, edits);
    }
    // Random blocks with random states, some with data.
    Structure random(glm::ivec3 size, unsigned seed) {
        std::mt19937 number(seed);
        std::vector<PlacedBlock> blocks;
        const BlockBox box{{1, 1, 1}, {size.x, size.y, size.z}};
        for (std::int64_t i = 0; i < box.blockCount(); ++i) {
            const auto id = static_cast<BlockId>(number() % contentBlocks().types().size());
            BlockValue value{id, static_cast<std::uint16_t>(number() % 256), nullptr};
            if (number() % 5 == 0)
                value = {id, 0, std::make_shared<const BlockEntityData>(BlockEntityData(3))};
            blocks.push_back({box.blockAt(i), value});
        }
        BlockUpdate update(world_, contentBlocks(), edits_);
        update.restore(blocks);  // without consequences
        return copyBlocks(world_, contentBlocks(), box);
    }
    std::vector<BlockEdit> edits_;
    World world_;
};

TEST_F(StructureTest, HoldsTheBlocksOfABox) {
    const auto data = std::make_shared<const BlockEntityData>(BlockEntityData(7));
    put({2, 3, 4}, "stone");
    put({3, 3, 4}, "chest", 0, data);
    put({3, 4, 4}, "oak_stairs", 2);
    const Structure structure = copyBlocks(world_, contentBlocks(), {{2, 3, 4}, {3, 4, 4}});
    EXPECT_EQ(structure.size, glm::ivec3(2, 2, 1));
    const std::vector<StructureBlock> palette = {{"stone", 0}, {"chest", 0}, {"air", 0}, {"oak_stairs", 2}};
    EXPECT_EQ(structure.palette, palette);
    EXPECT_EQ(structure.cells, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    ASSERT_EQ(structure.data.size(), 1u);
    EXPECT_EQ(structure.data[0].cell, 1u);
    EXPECT_EQ(*structure.data[0].data, *data);
}

TEST_F(StructureTest, FourTurnsAndTwoMirrorsAreNone) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const Structure one = random({2 + static_cast<int>(seed % 5), 3, 4}, seed);
        EXPECT_TRUE(turnedStructure(one, contentBlocks(), 4) == one);
        EXPECT_FALSE(turnedStructure(one, contentBlocks(), 1) == one);
        EXPECT_TRUE(turnedStructure(turnedStructure(one, contentBlocks(), 3), contentBlocks(), -3) == one);
        for (const MirrorAxis axis : {MirrorAxis::X, MirrorAxis::Y}) {
            const Structure mirrored = mirroredStructure(one, contentBlocks(), axis);
            EXPECT_FALSE(mirrored == one);
            EXPECT_TRUE(mirroredStructure(mirrored, contentBlocks(), axis) == one);
        }
        // Both mirrors together are half a turn.
        const Structure both = mirroredStructure(mirroredStructure(one, contentBlocks(), MirrorAxis::X),
                                                 contentBlocks(), MirrorAxis::Y);
        EXPECT_TRUE(both == turnedStructure(one, contentBlocks(), 2));
    }
}

TEST_F(StructureTest, AQuarterTurnIsAgainstTheClock) {
    put({0, 0, 5}, "stone");
    put({1, 0, 5}, "oak_log");
    const Structure turned =
        turnedStructure(copyBlocks(world_, contentBlocks(), {{0, 0, 5}, {1, 0, 5}}), contentBlocks(), 1);
    EXPECT_EQ(turned.size, glm::ivec3(1, 2, 1));
    EXPECT_EQ(turned.palette[turned.cells[turned.cellAt({0, 1, 0})]].name, "oak_log") << "+x became +y";
}

// The boxes of a turned block are the turned boxes of the block, in every state.
TEST_F(StructureTest, ATurnedStateHasTheTurnedShape) {
    using Corners = std::vector<std::array<float, 6>>;
    const auto sorted = [](Corners corners) {
        std::ranges::sort(corners);
        return corners;
    };
    for (const BlockType& type : contentBlocks().types()) {
        if (!type.model) continue;
        for (std::uint16_t state = 0; state < 256; ++state) {
            Corners turned, there, mirrored, thereMirrored;
            for (const Box& box : collisionBoxes(type, state)) {
                const auto low = box.min, high = box.max;
                turned.push_back({1 - high.y, low.x, low.z, 1 - low.y, high.x, high.z});
                mirrored.push_back({1 - high.x, low.y, low.z, 1 - low.x, high.y, high.z});
            }
            for (const Box& box : collisionBoxes(type, turnedState(type, state, 1)))
                there.push_back({box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z});
            ASSERT_EQ(sorted(turned), sorted(there)) << type.name << " " << state;
            if (type.name.find("door") != std::string::npos) continue;  // keeps its hinge
            for (const Box& box : collisionBoxes(type, mirroredState(type, state, MirrorAxis::X)))
                thereMirrored.push_back({box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z});
            ASSERT_EQ(sorted(mirrored), sorted(thereMirrored)) << type.name << " " << state;
        }
    }
}

TEST_F(StructureTest, NamesThatARegistryLacksAreMissing) {
    const Structure structure{
        .size = {1, 1, 2}, .palette = {{"stone", 3}, {"moon_cheese", 0}}, .cells = {0, 1}, .data = {}};
    const auto values = paletteValues(structure, contentBlocks());
    EXPECT_EQ(values[0].id, contentBlock("stone"));
    EXPECT_EQ(values[0].state, 3);
    EXPECT_EQ(values[1].id, contentBlocks().missing());
    EXPECT_EQ(unknownNames(structure, contentBlocks()), std::vector<std::string>{"moon_cheese"});
}

TEST_F(StructureTest, ABoxWithoutBlocksOrWithTooManyIsRefused) {
    const auto copied = [&](BlockPos low, BlockPos high) {
        return copyBlocks(world_, contentBlocks(), {low, high});
    };
    EXPECT_THROW(copied({5, 5, 5}, {4, 5, 5}), std::invalid_argument);
    EXPECT_THROW(copied({0, 0, 0}, {99'999, 99'999, 255}), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::world
