#include "terrane/stream/meshing.h"

#include <random>

#include "tests/stream/pipeline_fixture.h"

namespace terrane::stream {
namespace {

constexpr std::array<std::pair<int, int>, 4> kBeside = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

// The chunks of a tile of level 1 are shown if the view distance holds all of them.
TEST(TileBorders, AreWhereShownChunksEnd) {
    std::mt19937 random(3);
    for (int n = 0; n < 50; ++n) {
        const TileView view{{static_cast<int>(random() % 9) - 4, static_cast<int>(random() % 9) - 4},
                            1 + static_cast<int>(random() % 6),
                            64};
        for (int k = 0; k < 30 * 30; ++k) {
            const ChunkPos pos{k % 30 - 15, k / 30 - 15};
            for (std::size_t side = 0; side < kBeside.size(); ++side) {
                const ChunkPos beside = world::offsetBy(pos, kBeside[side].first, kBeside[side].second);
                const bool isBorder =
                    isWithinView(view, parentOf(pos)) && !isWithinView(view, parentOf(beside));
                ASSERT_EQ((openSides(view, pos) >> side & 1) != 0, isBorder);
            }
        }
    }
}

TEST(TileBorders, AreNowhereWithoutTilesOrBeyondTheWorld) {
    EXPECT_EQ(openSides({{0, 0}, 3, 0}, {3, 0}), 0);
    const ChunkPos corner = world::chunkOf(world::BlockPos{INT32_MAX, INT32_MAX, 0});
    const TileView view{corner, 3, 64};
    EXPECT_EQ(openSides(view, corner), 0);
    EXPECT_NE(openSides(view, world::offsetBy(corner, -3, 0)), 0);
}

// A dark cave through the whole chunk along x, one that daylight enters, one that does not reach the border.
TEST(TileBorders, CavesAreClosedTowardTiles) {
    constexpr int kGround = 100;
    const world::BlockId stone = contentBlocks().find("stone")->id, dirt = contentBlocks().find("dirt")->id;
    world::Chunk land;
    const auto fill = [&](world::BlockPos from, world::BlockPos to, world::BlockId block) {
        for (int z = from.z; z < to.z; ++z)
            for (int y = from.y; y < to.y; ++y)
                for (int x = from.x; x < to.x; ++x) land.setBlock(world::blockIndex(x, y, z), block);
    };
    fill({0, 0, 0}, {16, 16, 60}, stone);
    fill({0, 0, 60}, {16, 16, kGround}, dirt);
    fill({0, 4, 30}, {16, 9, 70}, world::kAir);
    fill({15, 5, 70}, {16, 7, 71}, contentBlock("crystal_rock"));  // in the roof: it does not close the cave
    fill({12, 0, 90}, {16, 3, 98}, world::kAir);
    fill({12, 0, 98}, {13, 3, kGround}, world::kAir);
    fill({4, 12, 20}, {12, 15, 25}, world::kAir);
    ChunkNeighborhood around;
    around.meshed[0] = around.chunks[4] = std::make_shared<const world::Chunk>(land);
    const light::ChunkLightPtr light = lightOf(around, light::LightTable(contentBlocks()));
    const auto closedAt = [&](SideSet sides) {
        around.openSides = sides;
        return closeCaves(around, *light, contentBlocks())[0];
    };
    EXPECT_EQ(closedAt(0), around.meshed[0]);
    EXPECT_EQ(closedAt(1 << 2 | 1 << 3), around.meshed[0]) << "no dark cave leads there";
    const world::ChunkPtr closed = closedAt(1 << 1);
    for (int z = 0; z < 256; ++z) {
        for (int y = 0; y < 16; ++y) {
            for (int x = 0; x < 16; ++x) {
                const world::BlockIndex index = world::blockIndex(x, y, z);
                const bool isClosed = x == 15 && y >= 4 && y < 9 && z >= 30 && z < 70;
                ASSERT_EQ(closed->block(index), isClosed ? dirt : land.block(index))
                    << x << ',' << y << ',' << z;
            }
        }
    }
}

class TileBordersTest : public PipelineTest {
  protected:
    // The expected mesh of a chunk that borders on tiles.
    mesh::ChunkMesh expected(const TileView& view, ChunkPos pos) const {
        mesh::MeshBlocks blocks = meshBlocksOf(chunksAround(world_, pos));
        for (std::size_t side = 0; side < 4; ++side) {
            if ((openSides(view, pos) >> side & 1) != 0)
                blocks[1 + side] = borderChunk(contentBlocks(), world_.heights());
        }
        return *meshOf(blocks, contentBlocks(), {});
    }

    void expectBorders(const TileView& view) {
        std::size_t open = 0;
        settle();
        for (const auto& [pos, shown] : shown_) {
            EXPECT_EQ(*shown.mesh, expected(view, pos)) << pos.x << ',' << pos.y;
            if (openSides(view, pos) == 0) continue;
            EXPECT_GT(shown.mesh->quads.size(), directMesh(world_, pos).quads.size());
            ++open;
        }
        EXPECT_EQ(open > 0, view.horizon > 0);
    }
};

TEST_F(TileBordersTest, ChunksAreOpenTowardTiles) {
    for (const TileView& view : {TileView{{0, 0}, 3, 64},
                                 {{1, 0}, 3, 64},
                                 {{2, 1}, 3, 64},
                                 {{2, 1}, 3, 0},
                                 {{2, 1}, 2, 64},
                                 {{-30, 7}, 3, 64}}) {
        setView(view.center, view.viewDistance);
        pipeline_->setView(view.center, view.viewDistance, {}, view.horizon);
        expectBorders(view);
    }
}

// The view moves on while chunks are lit and meshed.
TEST_F(TileBordersTest, AlsoWhileChunksCome) {
    for (int x = 0; x < 12; ++x) {
        pipeline_->setView({x, 0}, 3, {}, 64);
        for (int n = 0; n < 2; ++n) {
            update();
            take(kAll);
        }
    }
    expectBorders({{11, 0}, 3, 64});
}

TEST_F(TileBordersTest, EditsLeaveThemOpen) {
    const TileView view{{0, 0}, 3, 64};
    pipeline_->setView(view.center, view.viewDistance, {}, view.horizon);
    expectBorders(view);
    placeBlock({-2 * 16, 5, 75}, "stone");
    placeBlock({3 * 16 + 15, 5, 75}, "stone");
    expectBorders(view);
}

}  // namespace
}  // namespace terrane::stream
