#include "terrane/stream/chunk_pipeline.h"

#include <stdexcept>

#include "terrane/shared/hash.h"
#include "tests/stream/pipeline_fixture.h"

namespace terrane::stream {
namespace {

class ChunkPipelineTest : public PipelineTest {};

// Small numbers that look random and are the same in every run.
class Numbers {
  public:
    explicit Numbers(unsigned seed) : seed_(seed) {}
    int between(int low, int high) {
        return low +
               static_cast<int>(shared::hash2(++count_, 0, seed_) % static_cast<unsigned>(high - low + 1));
    }

  private:
    unsigned seed_, count_ = 0;
};

TEST_F(ChunkPipelineTest, EveryChunkInViewEndsVisible) {
    for (const int distance : {0, 1, 3}) {
        setView({5, -7}, distance);
        settle();
        expectShowsTheView();
    }
}

TEST_F(ChunkPipelineTest, NothingIsRequestedWithoutAView) {
    update();
    jobs_.waitIdle();
    EXPECT_EQ(pipeline_->progress().inView, 0u);
    EXPECT_EQ(world_.chunkCount(), 0u);
    EXPECT_EQ(take(kAll), 0u);
}

TEST_F(ChunkPipelineTest, WaitingEndsWithoutWork) {
    setView({0, 0}, 1);
    settle();
    pipeline_->waitForWorkers(std::chrono::milliseconds(1));
    update();
    EXPECT_EQ(take(kAll), 0u) << "nobody finished";
}

TEST_F(ChunkPipelineTest, WithoutThreadsWaitingRunsTheJobs) {
    base::JobSystem noThreads(0);
    world::World world;
    ChunkPipeline pipeline(
        {noThreads, contentBlocks(), lightTable(), world, {&generator_}, nullptr, nullptr});
    pipeline.setView({0, 0}, 1);
    EXPECT_TRUE(pipeline.chunkAt({7, 7}));
    for (pipeline.update(now_); !pipeline.progress().isUpToDate(); pipeline.update(now_))
        pipeline.waitForWorkers(std::chrono::hours(1));
    EXPECT_EQ(pipeline.progress().visible, 9u);
}

TEST_F(ChunkPipelineTest, ASmallerViewRemovesMeshes) {
    setView({0, 0}, 3);
    settle();
    setView({0, 0}, 1);
    rest();
    expectShowsTheView();
    EXPECT_EQ(removals_.size(), 49u - 25u) << "one ring stays";
}

TEST_F(ChunkPipelineTest, ChunksOutOfViewAreRemovedOnce) {
    setView({0, 0}, 2);
    settle();
    const auto before = shown_;
    setView({4, 1}, 2);
    settle();
    for (const auto& [pos, shown] : before) {
        const bool isGone = !isWithin(pos, {4, 1}, 3);
        EXPECT_EQ(removals_.contains(pos) ? removals_[pos] : 0, isGone ? 1 : 0) << pos.x << ' ' << pos.y;
    }
    EXPECT_EQ(removals_.size(), 25u - 10u);
    expectShowsTheView();
}

TEST_F(ChunkPipelineTest, TheSameViewChangesNothing) {
    setView({0, 0}, 2);
    settle();
    setView({0, 0}, 2);
    settle();
    EXPECT_TRUE(removals_.empty());
    EXPECT_EQ(take(kAll), 0u);
}

TEST_F(ChunkPipelineTest, AWalkKeepsMemoryBoundedAndTheViewRight) {
    for (unsigned seed = 0; seed < 4; ++seed) {
        Numbers numbers(seed);
        ChunkPos center;
        for (int step = 0; step < 60; ++step) {
            center.x += numbers.between(-2, 2);
            center.y += numbers.between(-2, 2);
            if (numbers.between(0, 19) == 0) center.x += 1000;  // a jump
            setView(center, numbers.between(0, 3));
            update();
            if (numbers.between(0, 2) == 0) pipeline_->waitForWorkers(std::chrono::milliseconds(5));
            take(static_cast<std::size_t>(numbers.between(0, 8)));
            if (HasFatalFailure()) return;
            now_ += std::chrono::milliseconds(numbers.between(0, 900));
            if (numbers.between(0, 3) == 0 && world_.maybeChunkAt(center)) {
                placeBlock({center.x * 16 + numbers.between(0, 15), center.y * 16 + numbers.between(0, 15),
                            numbers.between(40, 90)},
                           numbers.between(0, 1) == 0 ? "lamp_red" : "air");
            }
        }
        rest();
        expectShowsTheView();
    }
}

TEST_F(ChunkPipelineTest, TakesAtMostTheLimitAndLosesNothing) {
    setView({0, 0}, 2);
    for (update(); !pipeline_->progress().complete(); update()) {
        pipeline_->waitForWorkers(std::chrono::milliseconds(100));
    }
    EXPECT_EQ(take(0), 0u);
    EXPECT_EQ(take(10), 10u);
    EXPECT_EQ(take(10), 10u);
    EXPECT_EQ(take(10), 5u);
    expectShowsTheView();
}

TEST_F(ChunkPipelineTest, ChunksThatWereNeverVisibleAreNotRemoved) {
    setView({0, 0}, 0);
    update();
    jobs_.waitIdle();
    update();  // all nine chunks are there, the mesh is requested
    setView({100, 0}, 0);
    EXPECT_EQ(take(kAll), 0u);
}

TEST_F(ChunkPipelineTest, ViewsAtTheCornersOfTheWorldComplete) {
    using world::kMaxChunk, world::kMinChunk;
    for (const ChunkPos corner : {ChunkPos{kMinChunk, kMinChunk},
                                  {kMaxChunk, kMinChunk},
                                  {kMinChunk, kMaxChunk},
                                  {kMaxChunk, kMaxChunk}}) {
        setView(corner, 2);
        settle();
        expectShowsTheView();
        EXPECT_EQ(pipeline_->progress().inView, 9u);
    }
    // The last block of the world: its neighbors are outside.
    placeBlock({std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max(), 60},
               "sand");
    settle();
    expectShowsTheView();
}

TEST_F(ChunkPipelineTest, ViewsNextToTheEdgeComplete) {
    setView({world::kMaxChunk - 1, 0}, 2);
    settle();
    expectShowsTheView();
    EXPECT_EQ(pipeline_->progress().inView, 4u * 5u);
}

// Everything is shown as before until the new meshes are there.
TEST_F(ChunkPipelineTest, OtherMeshOptionsMeshAgain) {
    setView({0, 0}, 1);
    settle();
    const auto before = shown_;
    const mesh::MeshOptions none{mesh::MergeMethod::None, 16};
    pipeline_->setMeshOptions(none);
    EXPECT_EQ(shown_, before);
    EXPECT_TRUE(pipeline_->progress().complete());
    settle();
    for (const auto& [pos, shown] : shown_) EXPECT_EQ(*shown.mesh, directMesh(world_, pos, none));
    EXPECT_GT(shown_.at({0, 0}).mesh->quads.size(), before.at({0, 0}).mesh->quads.size());
    pipeline_->setMeshOptions(none);
    EXPECT_EQ(take(kAll), 0u) << "the same options change nothing";
}

TEST_F(ChunkPipelineTest, RefusesWhatIsNotInTheWorld) {
    EXPECT_THROW(pipeline_->setView({0, 0}, -1), std::invalid_argument);
    EXPECT_THROW(pipeline_->maybeLoadChunkAt({world::kMaxChunk + 1, 0}), std::invalid_argument);
    EXPECT_THROW(pipeline_->maybeLoadChunkAt({0, 0, 1}), std::invalid_argument);
    EXPECT_THROW(pipeline_->chunkAt({0, world::kMinChunk - 1}), std::invalid_argument);
    EXPECT_EQ(world_.chunkCount(), 0u);
}

}  // namespace
}  // namespace terrane::stream
