// Work of workers and batch generators, and requests of others than the view.
#include "terrane/store/overlay_store.h"
#include "tests/base/job_gates.h"
#include "tests/stream/pipeline_fixture.h"

namespace terrane::stream {
namespace {

class PipelineJobsTest : public PipelineTest {};

// After long frames workers get more jobs at once, so that they are busy until the next frame.
TEST_F(PipelineJobsTest, ALongFrameIsFilledWithWork) {
    base::Blocker first(jobs_), second(jobs_);
    setView({0, 0}, 10);
    update();
    EXPECT_EQ(pipeline_->queuedCount(), 2u * 8);
    now_ += std::chrono::milliseconds(100);
    update();
    EXPECT_EQ(pipeline_->queuedCount(), 2u * 100);
    now_ += std::chrono::seconds(10);
    update();
    EXPECT_EQ(pipeline_->queuedCount(), 2u * 128);
}

// The view stays away and moves all the time: requests of others are still loaded.
TEST_F(PipelineJobsTest, WhatOthersAskForIsNotGivenUp) {
    base::Blocker first(jobs_), second(jobs_);
    setView({0, 0}, 1);
    pipeline_->maybeLoadChunkAt({40, 40});
    update();
    setView({1, 0}, 1);
    update();
    first.release();
    second.release();
    settle();
    EXPECT_TRUE(world_.maybeChunkAt({40, 40}));
}

// A failing worker ends the wait for its result.
TEST_F(PipelineJobsTest, WhatAWorkerThrowsIsThrownOn) {
    class FailingStore : public store::MemoryStore {
      public:
        using MemoryStore::MemoryStore;
        store::LoadedChunk load(world::ChunkPos) override { throw std::runtime_error("no memory"); }
    } store({.seed = 1, .generator = "bumpy", .generatorVersion = 1});
    pipeline_ = nullptr;
    pipeline_ = makePipeline({&generator_, &store, false});
    EXPECT_THROW(pipeline_->chunkAt({0, 0}), std::runtime_error);
    pipeline_ = nullptr;
}

TEST_F(PipelineJobsTest, ChunksOthersAskForAreLoadedAndKept) {
    setView({0, 0}, 0);
    settle();
    const std::size_t localLight = pipeline_->localLightBytes();
    EXPECT_EQ(pipeline_->maybeLoadChunkAt({40, 40}), nullptr);
    const world::ChunkPtr chunk = pipeline_->chunkAt({40, 40});
    ASSERT_TRUE(chunk);
    EXPECT_EQ(pipeline_->localLightBytes(), localLight) << "chunks beyond the view are not lit";
    EXPECT_EQ(pipeline_->maybeLoadChunkAt({40, 40}), chunk);
    EXPECT_EQ(world_.maybeChunkAt({40, 40}), chunk);
}

// A generator with batches of at most three, done two calls after they were submitted.
class SlowBatches : public gen::BatchGenerator {
  public:
    explicit SlowBatches(const gen::Generator& generator) : generator_(generator) {}

    std::size_t submit(std::span<const ChunkPos> positions) override {
        if (!running_.empty()) return 0;
        running_.assign(positions.begin(), positions.begin() + std::min<long>(3, std::ssize(positions)));
        calls_ = 2;
        return running_.size();
    }
    std::vector<gen::GeneratedChunk> take(bool) override {
        std::vector<gen::GeneratedChunk> done;
        if (running_.empty() || --calls_ > 0) return done;
        for (const ChunkPos pos : running_)
            done.push_back({pos, std::make_shared<world::Chunk>(generator_.generate(pos))});
        running_.clear();
        return done;
    }
    std::string_view backend() const override { return "test"; }

  private:
    const gen::Generator& generator_;
    std::vector<ChunkPos> running_;
    int calls_ = 0;
};

TEST_F(PipelineJobsTest, ABatchGeneratorMakesTheSame) {
    SlowBatches batches(generator_);
    pipeline_ = nullptr;
    pipeline_ = std::make_unique<ChunkPipeline>(
        PipelineParts{jobs_, contentBlocks(), lightTable(), world_, {}, &batches, nullptr});
    setView({3, 3}, 2);
    settle();
    expectShowsTheView();
}

// A lighter whose batches are done some updates after they were submitted.
TEST_F(PipelineJobsTest, ABatchLighterMakesTheSame) {
    for (const MeshPolicy meshing : {MeshPolicy::Workers, MeshPolicy::Caller}) {
        const auto lighter = light::makeCpuLighter(lightTable());
        pipeline_ = nullptr;
        world_ = {};
        shown_.clear();
        pipeline_ = std::make_unique<ChunkPipeline>(PipelineParts{
            jobs_, contentBlocks(), lightTable(), world_, {&generator_}, nullptr, lighter.get(), meshing});
        setView({3, 3}, 3);
        settle();
        EXPECT_EQ(shown_.size(), 49u);
        for (const auto& [pos, shown] : shown_) EXPECT_EQ(*shown.light, directLight(world_, pos));
        if (meshing == MeshPolicy::Workers) expectShowsTheView();
    }
}

// Edits while batches are in progress: the result equals lighting and meshing all from scratch.
TEST_F(PipelineJobsTest, EditsOutdateBatches) {
    SlowBatches batches(generator_);
    const auto lighter = light::makeCpuLighter(lightTable());
    pipeline_ = nullptr;
    pipeline_ = std::make_unique<ChunkPipeline>(
        PipelineParts{jobs_, contentBlocks(), lightTable(), world_, {}, &batches, lighter.get()});
    setView({0, 0}, 2);
    for (int step = 0; step < 500 && !pipeline_->progress().complete(); ++step) {
        update();
        const world::BlockPos pos{step * 7 % 80 - 32, step * 13 % 80 - 32, 60 + step % 9};
        placeBlock(pos, step % 2 == 0 ? "lamp_green" : "stone");
        pipeline_->waitForWorkers(std::chrono::milliseconds(1));
        take(kAll);
    }
    settle();
    expectShowsTheView();
}

// A chunk whose job is cancelled while it waits must come when the view returns.
TEST_F(PipelineJobsTest, ComesBackAfterItsJobWasCancelled) {
    base::Blocker first(jobs_), second(jobs_);
    setView({0, 0}, 1);
    update();
    setView({100, 0}, 1);
    update();
    setView({0, 0}, 1);
    update();
    first.release();
    second.release();
    settle();
    expectShowsTheView();
}

TEST(PipelineJobs, MayBeDestroyedWhileJobsRun) {
    const gen::Generator generator = bumpyGenerator();
    base::JobSystem jobs(2);
    for (int round = 0; round < 30; ++round) {
        world::World world;
        ChunkPipeline pipeline(
            {jobs, contentBlocks(), lightTable(), world, {&generator, nullptr, false}, nullptr});
        pipeline.setView({round, 0}, 2);
        for (int step = 0; step < round % 5; ++step) {
            pipeline.update();
            pipeline.waitForWorkers(std::chrono::milliseconds(2));
        }
    }
    EXPECT_EQ(jobs.queuedCount(), 0u);
}

}  // namespace
}  // namespace terrane::stream
