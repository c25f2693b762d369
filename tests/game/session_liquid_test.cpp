// Flowing water in a session: over time, over saving and loading, with undo, and its light.
#include <filesystem>

#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/base/temp_folder.h"
#include "tests/game/session_fixture.h"
#include "tests/world/put_block.h"

namespace terrane::game {
namespace {

constexpr double kFlowSeconds = 0.25;

void load(Session& session) {
    stream::ChunkPipeline& pipeline = session.pipeline();
    pipeline.setView({0, 0}, 2);
    for (pipeline.update(); !pipeline.progress().isUpToDate(); pipeline.update())
        pipeline.waitForWorkers(std::chrono::milliseconds(100));
}

void flow(Session& session, int ticks) {
    for (int k = 0; k < ticks; ++k) session.advance(kFlowSeconds, {0, 0});
}

// Two pillars at the corner of four chunks, water on both.
void placeSources(Session& session) {
    for (const world::BlockPos foot : {world::BlockPos{0, 0, kGroundHeight}, {-9, 3, kGroundHeight}}) {
        for (int z = 0; z < 6; ++z)
            session.edit(
                {kNoPlayer, {foot.x, foot.y, foot.z + z}, world::SetBlock{contentBlock("stone")}, {}});
        session.edit({kNoPlayer, {foot.x, foot.y, foot.z + 6}, world::SetBlock{contentBlock("water")}, {}});
    }
}

// Blocks and states around the origin, above the ground.
std::vector<int> blocksOf(const Session& session) {
    std::vector<int> blocks;
    for (int z = kGroundHeight; z < kGroundHeight + 8; ++z)
        for (int y = -24; y < 24; ++y)
            for (int x = -24; x < 24; ++x) {
                blocks.push_back(session.world().block({x, y, z}));
                blocks.push_back(session.world().blockState({x, y, z}));
            }
    return blocks;
}

int waterBlocks(const Session& session) {
    const std::vector<int> blocks = blocksOf(session);
    int count = 0;
    for (std::size_t k = 0; k < blocks.size(); k += 2) count += blocks[k] == contentBlock("water");
    return count;
}

SessionParts partsOf(const std::filesystem::path& file) {
    SessionParts parts = flatParts();
    const store::WorldIdentity identity{.seed = 1, .generator = "flat stone", .generatorVersion = 1};
    auto opened = store::SqliteStore::open(file, *parts.blocks, {.create = identity, .decide = {}});
    if (!opened) throw std::runtime_error(opened.error().message);
    parts.store = std::move(*opened);
    return parts;
}

TEST_F(SessionTest, WaterFlowsWithTime) {
    placeSources(session_);
    EXPECT_EQ(waterBlocks(session_), 2);
    flow(session_, 1);
    EXPECT_EQ(waterBlocks(session_), 2 + 8) << "one block in a quarter of a second";
    flow(session_, 60);
    const int settled = waterBlocks(session_);
    EXPECT_GT(settled, 200);
    flow(session_, 4);
    EXPECT_EQ(waterBlocks(session_), settled);
}

TEST_F(SessionTest, FlowingWaterIsLitLikeAnyBlock) {
    placeSources(session_);
    flow(session_, 60);
    settle();
    const light::LightTable table(contentBlocks());
    int checked = 0;
    for (const stream::ChunkChange& change : takeChanges()) {
        if (!change.light || world::chunkDistance(change.pos, {0, 0}) > 1) continue;
        stream::ChunkNeighborhood around;
        for (int n = 0; n < 9; ++n)
            around.chunks[static_cast<std::size_t>(n)] =
                session_.world().maybeChunkAt(world::offsetBy(change.pos, n % 3 - 1, n / 3 - 1));
        EXPECT_EQ(*change.light, *stream::lightOf(around, table));
        ++checked;
    }
    EXPECT_EQ(checked, 9);
}

TEST(SessionLiquid, GoesOnAfterSavingAndLoadingAsIfNothingHadBeen) {
    const base::TempFolder folder;
    Session whole(flatParts());
    load(whole);
    placeSources(whole);
    for (const int ticks : {7, 5, 9, 60}) {
        {
            Session session(partsOf(folder / "a.sqlite"));
            load(session);
            if (ticks == 7) placeSources(session);
            flow(session, ticks);
            flow(whole, ticks);
            EXPECT_EQ(blocksOf(session), blocksOf(whole)) << ticks;
            ASSERT_TRUE(session.save());
        }
    }
    EXPECT_GT(waterBlocks(whole), 200);
}

// As in a game: a source that a player placed, undone after it has flooded the ground.
TEST_F(SessionTest, UndoOfASourceLetsTheGroundRunDry) {
    session_.setPlayer(kLocalPlayer, {.position = {0.5, 0.5, kGroundHeight + 3.0}});
    const world::SetBlock source{contentBlock("water"), 0};
    ASSERT_EQ(session_.edit({kLocalPlayer, {0, 0, kGroundHeight}, source, {}}), EditResult::Applied);
    flow(session_, 20);
    EXPECT_GT(waterBlocks(session_), 100);
    EXPECT_EQ(session_.undoOrRedo(kLocalPlayer, HistoryWay::Undo).blocks, 1u);
    flow(session_, 40);
    EXPECT_EQ(waterBlocks(session_), 0);
    EXPECT_EQ(session_.undoOrRedo(kLocalPlayer, HistoryWay::Redo).blocks, 1u);
    flow(session_, 40);
    EXPECT_GT(waterBlocks(session_), 100);
}

TEST_F(SessionTest, EyesAreUnderWaterThatIsHighEnough) {
    session_.edit({kNoPlayer, {0, 0, kGroundHeight}, world::SetBlock{contentBlock("water")}, {}});
    flow(session_, 20);
    EXPECT_TRUE(isUnderWater(session_, {4.5, 0.5, kGroundHeight + 0.4}));
    EXPECT_FALSE(isUnderWater(session_, {4.5, 0.5, kGroundHeight + 0.5}));
    EXPECT_EQ(waterAbove(session_, {4.5, 0.5, kGroundHeight + 0.4}), 1);
}

}  // namespace
}  // namespace terrane::game
