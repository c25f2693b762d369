#include "terrane/stream/chunk_pipeline.h"

#include <future>
#include <set>
#include <thread>
#include <utility>

#include "terrane/shared/hash.h"
#include "terrane/store/memory_store.h"
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

// A worker that is busy until open() is called.
class BusyWorker {
  public:
    explicit BusyWorker(base::JobSystem& jobs) {
        std::promise<void> started;
        jobs.submit(-1, [this, &started](const base::CancelToken&) {
            started.set_value();
            gate_.get_future().wait();
        });
        started.get_future().wait();
    }
    ~BusyWorker() { open(); }
    void open() {
        if (!std::exchange(isOpen_, true)) gate_.set_value();
    }

  private:
    std::promise<void> gate_;
    bool isOpen_ = false;
};

TEST_F(ChunkPipelineTest, EveryChunkInViewEndsVisible) {
    for (const int distance : {0, 1, 3}) {
        setView({5, -7}, distance);
        settle();
        expectShowsTheView();
    }
}

TEST_F(ChunkPipelineTest, NothingIsWantedWithoutAView) {
    update();
    jobs_.waitIdle();
    EXPECT_EQ(pipeline_->progress().wanted, 0u);
    EXPECT_TRUE(world_.chunks().empty());
    EXPECT_EQ(take(kAll), 0u);
}

TEST_F(ChunkPipelineTest, WaitingEndsWithoutWork) {
    setView({0, 0}, 1);
    settle();
    pipeline_->waitForWorkers(std::chrono::milliseconds(1));
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
        ChunkPos centre;
        for (int step = 0; step < 60; ++step) {
            centre.x += numbers.between(-2, 2);
            centre.y += numbers.between(-2, 2);
            if (numbers.between(0, 19) == 0) centre.x += 1000;  // a jump
            setView(centre, numbers.between(0, 3));
            update();
            if (numbers.between(0, 2) == 0) pipeline_->waitForWorkers(std::chrono::milliseconds(5));
            take(static_cast<std::size_t>(numbers.between(0, 8)));
            if (HasFatalFailure()) return;
            now_ += std::chrono::milliseconds(numbers.between(0, 900));
            if (numbers.between(0, 3) == 0 && world_.maybeChunkAt(centre)) {
                placeBlock({centre.x * 16 + numbers.between(0, 15), centre.y * 16 + numbers.between(0, 15),
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

TEST_F(ChunkPipelineTest, EditsMeshAgainTheChunksThatSeeThem) {
    setView({0, 0}, 2);
    settle();
    const auto changedBy = [&](world::BlockPos pos) {
        const auto before = shown_;
        placeBlock(pos, "sand");
        settle();
        expectShowsTheView();
        std::set<ChunkPos> changed;
        for (const auto& [at, shown] : shown_) {
            if (shown.mesh != before.at(at).mesh) changed.insert(at);
        }
        return changed;
    };
    using Chunks = std::set<ChunkPos>;
    EXPECT_EQ(changedBy({5, 9, 70}), (Chunks{{0, 0}}));
    EXPECT_EQ(changedBy({16, 9, 60}), (Chunks{{1, 0}, {0, 0}}));
    EXPECT_EQ(changedBy({-17, 9, 60}), (Chunks{{-2, 0}, {-1, 0}}));
    EXPECT_EQ(changedBy({5, 31, 60}), (Chunks{{0, 1}, {0, 2}}));
    EXPECT_EQ(changedBy({15, 0, 60}), (Chunks{{0, 0}, {1, 0}, {0, -1}}));
    EXPECT_EQ(changedBy({47, 5, 60}), (Chunks{{2, 0}})) << "the neighbour is not in view";
}

// Edits come faster than workers mesh: the meshes in between may be lost, the last may not.
TEST_F(ChunkPipelineTest, TheNewestMeshWins) {
    setView({0, 0}, 1);
    settle();
    for (int round = 0; round < 40; ++round) {
        for (int k = 0; k < 6; ++k) placeBlock({15, 15, 80 + (round * 6 + k) % 100}, k % 2 ? "air" : "stone");
        if (round % 3 == 0) update();
        if (round % 5 == 0) take(1);
    }
    settle();
    expectShowsTheView();
}

// Light and mesh that were on the way when a block changed are made again.
TEST_F(ChunkPipelineTest, ResultsOfOldBlocksAreDropped) {
    setView({0, 0}, 1);
    for (int step = 0; step < 200 && !pipeline_->progress().complete(); ++step) {
        update();
        for (const ChunkPos pos : {ChunkPos{0, 0}, {1, 0}, {-1, 1}, {2, 2}}) {
            if (!world_.maybeChunkAt(pos)) continue;
            placeBlock({pos.x * 16 + 15, pos.y * 16 + step % 16, 70 + step % 7},
                       step % 2 ? "lamp_green" : "air");
        }
        pipeline_->waitForWorkers(std::chrono::milliseconds(1));
    }
    settle();
    expectShowsTheView();
}

TEST_F(ChunkPipelineTest, AnEditIsOnScreenInTheNextUpdate) {
    setView({0, 0}, 1);
    settle();
    placeBlock({15, 3, 90}, "lamp_blue");
    update();
    take(kAll);
    expectShowsTheView();
}

TEST_F(ChunkPipelineTest, EditsOfWhatIsNotLoadedAreRefused) {
    setView({0, 0}, 1);
    EXPECT_FALSE(pipeline_->setBlock({1000, 0, 60}, contentBlock("sand")));
    EXPECT_FALSE(pipeline_->setSmallData({1000, 0, 60}, 3));
    EXPECT_FALSE(pipeline_->setLargeData({1000, 0, 60}, {std::byte{1}}));
    settle();
    EXPECT_FALSE(pipeline_->setBlock({3, 3, 256}, contentBlock("sand")));
    EXPECT_FALSE(pipeline_->setBlock({3, 3, -1}, contentBlock("sand")));
    expectShowsTheView();
    rest();
}

TEST_F(ChunkPipelineTest, EditsOutOfViewAreHarmless) {
    setView({0, 0}, 0);
    settle();
    ASSERT_TRUE(pipeline_->setBlock({20, 20, 90}, contentBlock("sand"))) << "active, and not visible";
    ASSERT_TRUE(pipeline_->chunkAt({40, 40}));
    ASSERT_TRUE(pipeline_->setBlock({645, 645, 90}, contentBlock("lamp_red")));
    settle();
    expectShowsTheView();
    setView({40, 40}, 1);
    settle();
    EXPECT_EQ(world_.block({645, 645, 90}), contentBlock("lamp_red"));
    expectShowsTheView();
}

// The view does not come near, and moves all the time: what others asked for comes all the same.
TEST_F(ChunkPipelineTest, WhatOthersAskForIsNotGivenUp) {
    BusyWorker first(jobs_), second(jobs_);
    setView({0, 0}, 1);
    pipeline_->maybeLoadChunkAt({40, 40});
    update();
    setView({1, 0}, 1);
    update();
    first.open();
    second.open();
    settle();
    EXPECT_TRUE(world_.maybeChunkAt({40, 40}));
}

// A worker that fails ends the wait for what it should have brought.
TEST_F(ChunkPipelineTest, WhatAWorkerThrowsIsThrownOn) {
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

TEST_F(ChunkPipelineTest, PlantsAreMeshedByTheirStage) {
    setView({0, 0}, 0);
    settle();
    ASSERT_TRUE(pipeline_->setBlock({3, 3, 100}, contentBlock("dirt")));
    ASSERT_TRUE(pipeline_->setBlock({3, 3, 101}, contentBlock("wheat")));
    std::set<std::uint16_t> left;
    for (int stage = 3;; --stage) {
        left.insert(world_.smallData({3, 3, 101}));
        settle();
        expectShowsTheView();
        if (stage == 0) break;
        const auto before = shown_.at({0, 0}).mesh;
        ASSERT_TRUE(pipeline_->setSmallData({3, 3, 101}, static_cast<std::uint16_t>(stage - 1)));
        update();
        take(kAll);
        EXPECT_NE(*shown_.at({0, 0}).mesh, *before) << "stage " << stage - 1;
    }
    EXPECT_EQ(left, (std::set<std::uint16_t>{3, 2, 1, 0}));
}

TEST_F(ChunkPipelineTest, AnEditNamesTheBricksWhoseLightItChanged) {
    setView({0, 0}, 1);
    settle();
    placeBlock({8, 8, 100}, "lamp_red");  // brick 6, 5 and 7 by its light, 4 by its shadow
    update();
    int lit = 0;
    for (const ChunkChange& change : pipeline_->takeChanges(kAll)) {
        lit += change.light ? 1 : 0;
        EXPECT_EQ(change.bricks & ~0b11110000, 0) << change.pos.x << ' ' << change.pos.y;
        if (change.pos == ChunkPos{0, 0}) {
            EXPECT_EQ(change.bricks, 0b11110000);
        }
    }
    EXPECT_GE(lit, 5);
}

TEST_F(ChunkPipelineTest, AnEditMeshesOnlyTheRegionsItTouches) {
    pipeline_->setMeshOptions({mesh::Method::Greedy, 32});
    setView({0, 0}, 1);
    settle();
    placeBlock({15, 8, 95}, "stone");  // in region 2, below 3, and beside region 2 of the next chunk
    update();
    std::map<ChunkPos, mesh::RegionSet> meshed;
    for (const ChunkChange& change : pipeline_->takeChanges(kAll)) {
        if (!change.mesh) continue;
        meshed[change.pos] = change.regions;
        for (std::size_t r = 0; r < change.mesh->regions.size(); ++r) {
            if (mesh::hasRegion(change.regions, r)) continue;
            EXPECT_EQ(change.mesh->regions[r].maxZ, 0) << "region " << r << " has quads";
        }
    }
    EXPECT_EQ(meshed, (std::map<ChunkPos, mesh::RegionSet>{{{0, 0}, 0b1100}, {{1, 0}, 0b0100}}));
}

// Where whole chunks are meshed elsewhere, edits still come with their mesh, but where the chunk has none
// yet.
TEST_F(ChunkPipelineTest, MeshesOfWholeChunksAreLeftOut) {
    pipeline_->leaveMeshesOut();
    setView({0, 0}, 1);
    for (update(); !pipeline_->progress().complete(); update()) {
        pipeline_->waitForWorkers(std::chrono::milliseconds(100));
    }
    placeBlock({8, 8, 80}, "stone");
    update();
    const std::vector<ChunkChange> changes = pipeline_->takeChanges(kAll);
    EXPECT_EQ(changes.size(), 9u);
    for (const ChunkChange& change : changes) {
        EXPECT_TRUE(change.needsMesh && !change.mesh && change.light) << change.pos.x << ' ' << change.pos.y;
        const mesh::MeshBlocks blocks = pipeline_->meshBlocks(change.pos);
        mesh::MeshScratch scratch;
        EXPECT_EQ(meshChunk(mesh::meshInput(blocks, contentBlocks(), {}), scratch),
                  directMesh(world_, change.pos));
    }
    placeBlock({8, 8, 90}, "stone");
    update();
    std::size_t meshed = 0;
    for (const ChunkChange& change : pipeline_->takeChanges(kAll)) {
        EXPECT_FALSE(change.needsMesh);
        meshed += change.mesh && change.regions != mesh::kAllRegions;
    }
    EXPECT_EQ(meshed, 1u);
    pipeline_->setMeshOptions({mesh::Method::None, 16});
    update();
    std::size_t again = 0;
    for (const ChunkChange& change : pipeline_->takeChanges(kAll)) again += change.needsMesh;
    EXPECT_EQ(again, 9u);
}

// Whatever is taken when, between edits and other options: what is shown is what meshing all again gives.
TEST_F(ChunkPipelineTest, RegionsOfManyEditsAddUp) {
    setView({0, 0}, 1);
    settle();
    mesh::MeshOptions options;
    for (unsigned step = 0; step < 200; ++step) {
        const auto random = [&](unsigned k, unsigned count) {
            return static_cast<int>(shared::hash2(step, k, 77) % count);
        };
        if (random(0, 25) == 0)
            pipeline_->setMeshOptions(options = {mesh::Method::Greedy, 8 << random(1, 5)});
        placeBlock({random(2, 48) - 16, random(3, 48) - 16, 40 + random(4, 60)},
                   step % 3 == 0 ? "air" : "stone");
        if (random(5, 2) == 0) update();
        if (random(6, 4) == 0) take(static_cast<std::size_t>(random(7, 4)));
    }
    settle();
    for (const auto& [pos, shown] : shown_) {
        EXPECT_EQ(*shown.mesh, directMesh(world_, pos, options)) << pos.x << ' ' << pos.y;
    }
}

TEST_F(ChunkPipelineTest, ChunksOthersAskForAreLoadedAndKept) {
    setView({0, 0}, 0);
    settle();
    EXPECT_EQ(pipeline_->maybeLoadChunkAt({40, 40}), nullptr);
    const world::ChunkPtr chunk = pipeline_->chunkAt({40, 40});
    ASSERT_TRUE(chunk);
    EXPECT_EQ(pipeline_->maybeLoadChunkAt({40, 40}), chunk);
    EXPECT_EQ(world_.maybeChunkAt({40, 40}), chunk);
}

// Chunks made elsewhere in batches of at most three, some updates later.
TEST_F(ChunkPipelineTest, ABatchGeneratorMakesTheSame) {
    std::vector<ChunkPos> running;
    int wait = 0;
    BatchGenerator batches;
    batches.submit = [&](std::span<const ChunkPos> wanted) -> std::size_t {
        if (!running.empty()) return 0;
        running.assign(wanted.begin(), wanted.begin() + std::min<long>(3, std::ssize(wanted)));
        wait = 2;
        return running.size();
    };
    batches.take = [&] {
        std::vector<std::pair<ChunkPos, world::Chunk>> done;
        if (running.empty() || --wait > 0) return done;
        for (const ChunkPos pos : running) done.emplace_back(pos, generator_.generate(pos));
        running.clear();
        return done;
    };
    pipeline_ = nullptr;
    pipeline_ = std::make_unique<ChunkPipeline>(
        PipelineParts{jobs_, contentBlocks(), lightTable(), world_, {}, &batches});
    setView({3, 3}, 2);
    settle();
    expectShowsTheView();
}

TEST_F(ChunkPipelineTest, ChunksThatWereNeverVisibleAreNotRemoved) {
    setView({0, 0}, 0);
    update();
    jobs_.waitIdle();
    update();  // all nine chunks are there, the mesh is asked for
    setView({100, 0}, 0);
    EXPECT_EQ(take(kAll), 0u);
}

TEST_F(ChunkPipelineTest, OfAChunkOnlyTheNewestMeshIsTaken) {
    setView({0, 0}, 1);
    settle();
    for (int round = 0; round < 3; ++round) {
        placeBlock({8, 8, 40 + round}, "sand");
        update();
    }
    EXPECT_EQ(take(kAll), 1u);
    expectShowsTheView();
}

TEST_F(ChunkPipelineTest, EditsSurviveWhileTheirChunkStaysInView) {
    setView({0, 0}, 1);
    settle();
    placeBlock({3, 3, 90}, "lamp_red");
    for (const ChunkPos centre : {ChunkPos{1, 0}, {2, 1}, {3, -1}, {0, 0}}) {
        setView(centre, 1);
        settle();
    }
    EXPECT_EQ(world_.block({3, 3, 90}), contentBlock("lamp_red"));
    expectShowsTheView();
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
        EXPECT_EQ(pipeline_->progress().wanted, 9u);
    }
    // The last block of the world: its neighbours are outside.
    placeBlock({std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max(), 60},
               "sand");
    settle();
    expectShowsTheView();
}

TEST_F(ChunkPipelineTest, ViewsNextToTheEdgeComplete) {
    setView({world::kMaxChunk - 1, 0}, 2);
    settle();
    expectShowsTheView();
    EXPECT_EQ(pipeline_->progress().wanted, 4u * 5u);
}

// A chunk whose job is cancelled while it waits must come when the view returns.
TEST_F(ChunkPipelineTest, ComesBackAfterItsJobWasCancelled) {
    BusyWorker first(jobs_), second(jobs_);
    setView({0, 0}, 1);
    update();
    setView({100, 0}, 1);
    update();
    setView({0, 0}, 1);
    update();
    first.open();
    second.open();
    settle();
    expectShowsTheView();
}

// Everything is shown as before until the new meshes are there.
TEST_F(ChunkPipelineTest, OtherMeshOptionsMeshAgain) {
    setView({0, 0}, 1);
    settle();
    const auto before = shown_;
    const mesh::MeshOptions none{mesh::Method::None, 16};
    pipeline_->setMeshOptions(none);
    EXPECT_EQ(shown_, before);
    EXPECT_TRUE(pipeline_->progress().complete());
    settle();
    for (const auto& [pos, shown] : shown_) EXPECT_EQ(*shown.mesh, directMesh(world_, pos, none));
    EXPECT_GT(shown_.at({0, 0}).mesh->quads.size(), before.at({0, 0}).mesh->quads.size());
    pipeline_->setMeshOptions(none);
    EXPECT_EQ(take(kAll), 0u) << "the same options change nothing";
}

TEST(ChunkPipeline, MayBeDestroyedWhileJobsRun) {
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
