// Edits and the store: edited chunks are saved, loaded again, and not replaced by generated ones.
#include "terrane/store/overlay_store.h"
#include "terrane/store/save_queue.h"
#include "tests/stream/pipeline_fixture.h"

namespace terrane::stream {
namespace {

class PipelineStoreTest : public PipelineTest {
  protected:
    PipelineStoreTest() { restart(); }

    // As a program that is closed and started again.
    void restart(bool storesGenerated = false) {
        pipeline_ = nullptr;
        world_ = {};
        shown_.clear();
        pipeline_ = makePipeline({&generator_, &store_, storesGenerated});
    }

    store::MemoryStore store_{{.seed = 1, .generator = "bumpy", .generatorVersion = 1}};
};

TEST_F(PipelineStoreTest, EditsComeBackAfterARestart) {
    setView({0, 0}, 1);
    settle();
    placeBlock({3, 3, 90}, "lamp_red");
    placeBlock({15, 15, 20}, "sand");
    restart();
    setView({0, 0}, 1);
    settle();
    EXPECT_EQ(world_.block({3, 3, 90}), contentBlock("lamp_red"));
    EXPECT_EQ(world_.block({15, 15, 20}), contentBlock("sand"));
    expectShowsTheView();
}

TEST_F(PipelineStoreTest, EditsComeBackAfterTheViewReturns) {
    setView({0, 0}, 1);
    settle();
    placeBlock({3, 3, 90}, "lamp_red");
    setView({50, 0}, 1);
    rest();
    ASSERT_FALSE(world_.maybeChunkAt({0, 0})) << "it was unloaded";
    setView({0, 0}, 1);
    settle();
    EXPECT_EQ(world_.block({3, 3, 90}), contentBlock("lamp_red"));
}

TEST_F(PipelineStoreTest, OnlyEditedChunksAreStored) {
    setView({0, 0}, 1);
    settle();
    placeBlock({3, 3, 90}, "sand");
    update();
    EXPECT_FALSE(store_.contains({0, 0})) << "not yet";
    now_ += ChunkPipeline::kSaveDelay;
    update();
    EXPECT_TRUE(store_.contains({0, 0}));
    EXPECT_FALSE(store_.contains({1, 0}));
}

// Including the delay of a file's queue, edits are saved within two seconds.
TEST_F(PipelineStoreTest, EditsAreHandedToTheStoreInTime) {
    setView({0, 0}, 1);
    settle();
    placeBlock({3, 3, 90}, "sand");
    const auto inTime = now_ + std::chrono::seconds(2) - store::SaveLimits{}.delay;
    while (!store_.contains({0, 0})) {
        now_ += std::chrono::milliseconds(50);  // a frame
        update();
        ASSERT_LE(now_, inTime);
    }
}

TEST_F(PipelineStoreTest, GeneratedChunksAreStoredWhereThatIsAskedFor) {
    restart(true);
    setView({0, 0}, 0);
    settle();
    for (int n = 0; n < 9; ++n) EXPECT_TRUE(store_.contains({n % 3 - 1, n / 3 - 1}));
}

TEST_F(PipelineStoreTest, DataOfBlocksIsSaved) {
    setView({0, 0}, 0);
    settle();
    ASSERT_TRUE(edit({3, 3, 20}, world::SetState{77}));
    ASSERT_TRUE(edit({4, 3, 20}, world::SetEntityData{{std::byte{1}, std::byte{2}}}));
    restart();
    setView({0, 0}, 0);
    settle();
    EXPECT_EQ(world_.blockState({3, 3, 20}), 77);
    ASSERT_TRUE(world_.blockEntityData({4, 3, 20}));
    EXPECT_EQ(*world_.blockEntityData({4, 3, 20}), (world::BlockEntityData{std::byte{1}, std::byte{2}}));
}

}  // namespace
}  // namespace terrane::stream
