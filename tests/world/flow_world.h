// Small worlds with flowing water, for the tests of liquid_flow.h.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "terrane/base/digest.h"
#include "terrane/world/changes/liquid_flow.h"
#include "tests/world/content_blocks.h"
#include "tests/world/put_block.h"

namespace terrane::world {

struct FlowWorld {
    explicit FlowWorld(Heights heights = {}) : world(heights) {}

    World world;
    std::vector<BlockEdit> edits;

    BlockId water = contentBlock("water");

    // Empty chunks x0 … x1, y0 … y1 with a floor of stone at the bottom.
    void addChunks(int x0, int y0, int x1, int y1) {
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                auto chunk = std::make_shared<Chunk>(world.heights());
                for (int i = 0; i < kChunkSize * kChunkSize; ++i)
                    chunk->setBlock(i | blockIndex(0, 0, world.heights().bottom), contentBlock("stone"));
                world.insert({x, y}, std::move(chunk));
            }
    }

    void set(BlockPos pos, std::string_view name) {
        const BlockId id = contentBlock(name);
        applyChange(world, contentBlocks(), pos, SetBlock{id, id == water ? kUnsettled : std::uint16_t{0}},
                    edits);
    }
    void clear(BlockPos pos) { applyChange(world, contentBlocks(), pos, SetBlock{kAir}, edits); }

    std::size_t tick(int radius = 6) {
        return flowLiquids(world, contentBlocks(), chunksWithin({0, 0}, radius), edits);
    }
    // Runs ticks until no cell is unsettled; returns their number.
    int settle(int limit = 1000, int radius = 6) {
        int ticks = 0;
        while (ticks < limit && tick(radius) > 0) ++ticks;
        EXPECT_LT(ticks, limit) << "settles";
        return ticks;
    }

    // 's' a source, '1' … '7' a level, 'f' falling, '.' air, '#' anything else.
    char at(BlockPos pos) const {
        const BlockId id = world.block(pos);
        if (id == kAir) return '.';
        if (id != water) return '#';
        const int form = world.blockState(pos) & kLiquidForm;
        return form == 0 ? 's' : form >= kLiquidFalling ? 'f' : static_cast<char>('0' + form);
    }
    std::string row(int x0, int x1, int y, int z) const {
        std::string text;
        for (int x = x0; x <= x1; ++x) text += at({x, y, z});
        return text;
    }
};

inline bool isEqual(const World& a, const World& b) {
    bool isSame = a.chunkCount() == b.chunkCount();
    a.forEachChunk([&](ChunkPos pos, const ChunkPtr& chunk) {
        const ChunkPtr other = b.maybeChunkAt(pos);
        isSame = isSame && other && *chunk == *other;
    });
    return isSame;
}

}  // namespace terrane::world
