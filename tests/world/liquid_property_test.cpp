// Random worlds: flow compared with a slow automaton that computes every cell, in any order of chunks.
#include <random>

#include "tests/world/flow_world.h"

namespace terrane::world {
namespace {

constexpr int kHeight = 9;  // layers with blocks

// The rules of liquid_flow.h for one liquid, cell by cell over a box; outside of it there is stone.
struct SlowAutomaton {
    // -1 stone, 0 air, else 1 + form.
    using Cells = std::map<BlockPos, int>;
    Cells cells;

    int at(BlockPos pos) const {
        const auto found = cells.find(pos);
        return found == cells.end() ? (pos.z >= kHeight + 3 ? 0 : -1) : found->second;
    }
    int next(BlockPos pos) const {
        const int now = at(pos);
        if (now < 0 || now == 1) return now;
        int sources = 0, level = 8;
        for (const Face side : {kFaceNegX, kFacePosX, kFaceNegY, kFacePosY}) {
            const BlockPos next = adjacent(pos, side);
            const int there = at(next);
            if (there <= 0) continue;
            sources += there == 1;
            if (there == 1 || at(adjacent(next, kFaceNegZ)) < 0) level = std::min(level, (there - 1) % 8 + 1);
        }
        const int below = at(adjacent(pos, kFaceNegZ));
        if (sources >= 2 && (below < 0 || below == 1)) return 1;
        if (at(adjacent(pos, kFacePosZ)) > 0) return 1 + 8;
        return level < 8 ? 1 + level : 0;
    }
    bool tick() {
        Cells after = cells;
        for (auto& [pos, value] : after) value = next(pos);
        std::swap(after, cells);
        return after != cells;
    }
};

struct RandomEdit {
    BlockPos pos;
    std::string_view name;
};

// Terraces of stone in walls, with some water on them.
std::vector<RandomEdit> randomEdits(unsigned seed, int count) {
    std::mt19937 random(seed);
    const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
    std::vector<RandomEdit> edits;
    for (int k = 0; k < count; ++k) {
        const int kind = below(10);
        const BlockPos pos{below(24) + 4, below(24) + 4, 1 + below(kHeight - 1)};
        edits.push_back({pos, kind < 2 ? "water" : kind < 4 ? "air" : "stone"});
    }
    return edits;
}

bool isWall(BlockPos pos) {
    return pos.x < 4 || pos.y < 4 || pos.x >= 28 || pos.y >= 28;
}

// Chunks 0, 0 to 1, 1 with a basin, and stone around.
void fillBasin(FlowWorld& flow, const std::vector<ChunkPos>& order) {
    for (const ChunkPos at : order) flow.addChunks(at.x, at.y, at.x, at.y);
    for (int y = -1; y < 33; ++y)
        for (int x = -1; x < 33; ++x)
            for (int z = 1; z < kHeight + 3; ++z)
                if (isWall({x, y, z})) putBlock(flow.world, {x, y, z}, contentBlock("stone"));
}

std::vector<ChunkPos> chunkOrder(unsigned seed) {
    std::vector<ChunkPos> order;
    for (int y = -1; y <= 2; ++y)
        for (int x = -1; x <= 2; ++x) order.push_back({x, y});
    std::mt19937 random(seed);
    for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random() % k]);
    return order;
}

SlowAutomaton slowOf(const FlowWorld& flow) {
    SlowAutomaton slow;
    for (int z = 1; z < kHeight + 3; ++z)
        for (int y = 4; y < 28; ++y)
            for (int x = 4; x < 28; ++x) {
                const BlockId id = flow.world.block({x, y, z});
                const int form = flow.world.blockState({x, y, z}) & kLiquidForm;
                slow.cells[{x, y, z}] = id == kAir ? 0 : id == flow.water ? 1 + form : -1;
            }
    return slow;
}

void expectSame(const FlowWorld& flow, const SlowAutomaton& slow) {
    const SlowAutomaton found = slowOf(flow);
    for (const auto& [pos, value] : slow.cells)
        ASSERT_EQ(found.cells.at(pos), value) << pos.x << ' ' << pos.y << ' ' << pos.z;
}

TEST(LiquidProperty, EqualsAnAutomatonThatLooksAtEveryCell) {
    for (unsigned seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(seed);
        FlowWorld flow;
        fillBasin(flow, chunkOrder(seed));
        const std::vector<RandomEdit> edits = randomEdits(seed, 500);
        for (std::size_t k = 0; k < edits.size(); ++k) {
            flow.set(edits[k].pos, edits[k].name);
            if (k % 50 != 49) continue;
            SlowAutomaton slow = slowOf(flow);
            for (int tick = 0; tick < 6; ++tick) {
                slow.tick();
                flow.tick();
                ASSERT_NO_FATAL_FAILURE(expectSame(flow, slow));
            }
        }
        flow.settle();
        EXPECT_FALSE(slowOf(flow).tick()) << "nothing is left to do";
    }
}

TEST(LiquidProperty, OrderOfChunksAndWhereTheCenterIsDoNotMatter) {
    for (unsigned seed = 30; seed < 36; ++seed) {
        FlowWorld a, b;
        fillBasin(a, chunkOrder(seed));
        fillBasin(b, chunkOrder(seed + 100));
        for (const RandomEdit& edit : randomEdits(seed, 300)) {
            a.set(edit.pos, edit.name);
            b.set(edit.pos, edit.name);
        }
        for (int tick = 0; tick < 60; ++tick) {
            flowLiquids(a.world, contentBlocks(), chunksWithin({0, 0}, 6), a.edits);
            flowLiquids(b.world, contentBlocks(), chunksWithin({2, 1}, 5), b.edits);
            ASSERT_TRUE(isEqual(a.world, b.world)) << "seed " << seed << " tick " << tick;
        }
    }
}

// As a save might hold them.
TEST(LiquidProperty, AnyStatesComeToRest) {
    for (unsigned seed = 80; seed < 84; ++seed) {
        FlowWorld flow;
        fillBasin(flow, chunkOrder(seed));
        std::mt19937 random(seed);
        for (int k = 0; k < 3000; ++k) {
            const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
            const BlockPos pos{below(24) + 4, below(24) + 4, 1 + below(kHeight)};
            putBlock(flow.world, pos, below(3) == 0 ? contentBlock("stone") : flow.water);
            putState(flow.world, pos, static_cast<std::uint16_t>(random()));
        }
        flow.settle();
    }
}

// No water above a source, nor where there was no source.
TEST(LiquidProperty, NeverRisesAboveItsSources) {
    for (unsigned seed = 60; seed < 66; ++seed) {
        FlowWorld flow;
        fillBasin(flow, chunkOrder(seed));
        int highest = 0;
        for (const RandomEdit& edit : randomEdits(seed, 300)) {
            flow.set(edit.pos, edit.name);
            if (edit.name == "water") highest = std::max(highest, edit.pos.z);
        }
        flow.settle();
        for (const auto& [pos, value] : slowOf(flow).cells) EXPECT_TRUE(value <= 0 || pos.z <= highest);
    }
}

TEST(LiquidProperty, WithoutSourcesAllRunsDry) {
    FlowWorld flow;
    fillBasin(flow, chunkOrder(3));
    for (const RandomEdit& edit : randomEdits(3, 400)) flow.set(edit.pos, edit.name);
    flow.settle();
    for (int round = 0; round < 40; ++round) {
        for (const auto& [pos, value] : slowOf(flow).cells)
            if (value == 1) flow.clear(pos);
        flow.settle();
    }
    for (const auto& [pos, value] : slowOf(flow).cells) EXPECT_LE(value, 0);
}

}  // namespace
}  // namespace terrane::world
