#include "terrane/mesh_gpu/mesh_queue.h"

#include <chrono>
#include <map>
#include <stdexcept>
#include <thread>

#include "terrane/gpu/readback_buffer.h"
#include "terrane/shared/hash.h"
#include "tests/base/wait_until.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/mesh/test_blocks.h"
#include "tests/mesh_gpu/mesh_comparison.h"
#include "tests/render/content.h"
#include "tests/support/default_heights.h"

namespace terrane::mesh_gpu {
namespace {

using world::ChunkPos;

// A few chunks that change, a store that is drawn from, and the queue between them.
class MeshQueueTest : public gpu::GlTest {
  protected:
    static constexpr int kSide = 3;

    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped()) return;
        for (int k = 0; k < kSide * kSide; ++k) change({k % kSide, k / kSide});
        makeQueue(0);
    }
    void TearDown() override {
        queue_.reset();
        store_.reset();
        GlTest::TearDown();
    }

    void makeQueue(double budgetMilliseconds, std::uint32_t maxQuads = 0, std::uint32_t maxArenas = 1) {
        auto mesher = GpuMesher::create(render::contentShaders(), mesh::testBlocks());
        ASSERT_TRUE(mesher) << mesher.error().message;
        queue_.emplace(std::move(*mesher), budgetMilliseconds);
        store_.emplace(render::QuadStoreSizes{maxQuads, maxArenas});
    }

    // Changes the blocks of a chunk.
    void change(ChunkPos pos) {
        auto chunk = std::make_shared<world::Chunk>();
        const unsigned seed = ++changes_;
        for (unsigned k = 0; k < 300; ++k) {
            const auto index =
                static_cast<world::BlockIndex>(shared::hash2(k, 1, seed) % world::kBlocksPerChunk);
            chunk->setBlock(index, mesh::testBlocks().types()[shared::hash2(k, 2, seed) % 16 + 1].id);
        }
        chunks_[pos] = std::move(chunk);
    }

    mesh::MeshBlocks blocksOf(ChunkPos pos) const {
        const auto at = [&](int dx, int dy) {
            const auto found = chunks_.find({pos.x + dx, pos.y + dy});
            return found != chunks_.end() ? found->second : nullptr;
        };
        return {at(0, 0), at(-1, 0), at(1, 0), at(0, -1), at(0, 1)};
    }

    void advance() {
        if (queue_->isCounted()) writeMeshes();
        std::vector<mesh::MeshBlocks> blocks;
        for (const ChunkPos pos : queue_->takeWaiting()) blocks.push_back(blocksOf(pos));
        if (blocks.empty()) return;
        std::vector<mesh::MeshInput> inputs;
        for (const mesh::MeshBlocks& chunk : blocks) {
            inputs.push_back(mesh::meshInput(chunk, mesh::testBlocks(), options_));
        }
        queue_->count(inputs);
    }
    void writeMeshes() {
        std::vector<FirstQuads> places;
        for (const CountedChunk& chunk : queue_->takeCounted()) {
            FirstQuads& firstQuads = places.emplace_back();
            if (!store_->reserve(chunk.pos, chunk.meshSections)) continue;
            for (const mesh::MeshSection& meshSection : store_->meshSectionsOf(chunk.pos)) {
                firstQuads.push_back(mesh::firstQuad(meshSection));
            }
        }
        queue_->write(places, store_->buffers());
    }
    // Polls without waiting, as frames do, which now and then wait for a fence of their own. Without that
    // wait a polled fence may never pass: zink on lavapipe (Mesa 22.3.6), where glFinish changes nothing
    // either.
    void finish() {
        // A guard against a queue that never ends. Beside other tests the driver's threads may wait for long.
        const auto end = std::chrono::steady_clock::now() + base::kHangs;
        for (int k = 0; queue_->size() > 0; ++k) {
            ASSERT_LT(std::chrono::steady_clock::now(), end) << "the queue never ends";
            advance();
            if (k % 1000 == 999) gpu::Fence::insert().wait();
            std::this_thread::yield();
        }
    }

    mesh::ChunkMesh expected(ChunkPos pos) const {
        mesh::MeshScratch scratch;
        const mesh::MeshBlocks blocks = blocksOf(pos);
        return meshChunk(mesh::meshInput(blocks, mesh::testBlocks(), options_), scratch);
    }
    void expectStored(ChunkPos pos) const {
        EXPECT_TRUE(sorted(meshIn(*store_, pos)) == sorted(expected(pos))) << pos.x << ' ' << pos.y;
    }

    std::map<ChunkPos, world::ChunkPtr> chunks_;
    unsigned changes_ = 0;
    mesh::MeshOptions options_;
    std::optional<MeshQueue> queue_;
    std::optional<render::QuadStore> store_;
};

TEST_F(MeshQueueTest, WritesWhatTheCpuWouldUpload) {
    for (const auto& [pos, chunk] : chunks_) queue_->add(pos);
    finish();
    for (const auto& [pos, chunk] : chunks_) expectStored(pos);
    EXPECT_EQ(store_->uploadedBytes(), 0u);
}

// Batches progress with the smallest budget.
TEST_F(MeshQueueTest, ABudgetMakesSmallBatches) {
    makeQueue(1e-9);
    for (const auto& [pos, chunk] : chunks_) queue_->add(pos);
    advance();
    EXPECT_EQ(queue_->size(), chunks_.size());
    EXPECT_TRUE(store_->chunks().empty()) << "quads are written a frame later";
    finish();
    for (const auto& [pos, chunk] : chunks_) expectStored(pos);
}

TEST_F(MeshQueueTest, OldQuadsStayUntilTheNewOnesAreThere) {
    queue_->add({1, 1});
    finish();
    const mesh::ChunkMesh before = meshIn(*store_, {1, 1});
    change({1, 1});
    queue_->add({1, 1});
    advance();
    ASSERT_TRUE(queue_->contains({1, 1}));
    EXPECT_TRUE(meshIn(*store_, {1, 1}) == before);
    finish();
    expectStored({1, 1});
    EXPECT_FALSE(meshIn(*store_, {1, 1}) == before);
}

// A chunk that changes while its old blocks are in flight is meshed again.
TEST_F(MeshQueueTest, AddedAgainOnTheWayItIsMeshedAgain) {
    queue_->add({1, 1});
    advance();
    change({1, 1});
    queue_->add({1, 1});
    finish();
    expectStored({1, 1});
}

TEST_F(MeshQueueTest, RemovedChunksAreNotStored) {
    queue_->add({0, 0});
    queue_->add({1, 0});
    queue_->remove({0, 0});  // while it waits
    advance();
    queue_->add({2, 0});
    queue_->remove({1, 0});  // on the way
    EXPECT_FALSE(queue_->contains({1, 0}));
    finish();
    EXPECT_EQ(store_->chunks().size(), 1u);
    expectStored({2, 0});
}

TEST_F(MeshQueueTest, RemovedAndAddedAgainOnTheWayItIsStored) {
    queue_->add({1, 0});
    advance();
    queue_->remove({1, 0});
    queue_->add({1, 0});
    finish();
    expectStored({1, 0});
}

TEST_F(MeshQueueTest, WithoutRoomOthersAreStored) {
    const auto quads = static_cast<std::uint32_t>(expected({0, 0}).quads.size());
    makeQueue(0, quads + quads / 2);
    queue_->add({0, 0});
    queue_->add({1, 0});
    finish();
    EXPECT_EQ(store_->chunks().size(), 1u);
    expectStored({0, 0});
}

TEST_F(MeshQueueTest, WritesIntoSeveralArenas) {
    const auto quads = static_cast<std::uint32_t>(expected({0, 0}).quads.size());
    makeQueue(0, 2 * quads, 16);
    for (const auto& [pos, chunk] : chunks_) queue_->add(pos);
    finish();
    EXPECT_GT(store_->buffers().buffers.size(), 3u);
    for (const auto& [pos, chunk] : chunks_) expectStored(pos);
}

TEST_F(MeshQueueTest, ManyChangesAddUp) {
    makeQueue(1);
    for (unsigned step = 0; step < 300; ++step) {
        const auto random = [&](unsigned k, unsigned count) {
            return static_cast<int>(shared::hash2(step, k, 5) % count);
        };
        const ChunkPos pos{random(0, kSide), random(1, kSide)};
        if (random(2, 4) == 0) {
            queue_->remove(pos);
            store_->remove(pos);
        } else {
            if (random(3, 3) == 0) {
                change(pos);
                for (const ChunkPos at : {ChunkPos{pos.x - 1, pos.y},
                                          {pos.x + 1, pos.y},
                                          {pos.x, pos.y - 1},
                                          {pos.x, pos.y + 1}}) {
                    if (store_->chunks().contains(at) || queue_->contains(at)) queue_->add(at);
                }
            }
            queue_->add(pos);
        }
        if (random(4, 3) == 0) advance();
    }
    finish();
    EXPECT_GT(store_->chunks().size(), 3u);
    for (const auto& [pos, meshSections] : store_->chunks()) expectStored(pos);
}

TEST_F(MeshQueueTest, CallsOutOfOrderAreRefused) {
    EXPECT_THROW(queue_->takeCounted(), std::invalid_argument);
    EXPECT_THROW(queue_->write({}, store_->buffers()), std::invalid_argument);
    queue_->add({1, 1});
    ASSERT_EQ(queue_->takeWaiting().size(), 1u);
    EXPECT_THROW(queue_->count({}), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::mesh_gpu
