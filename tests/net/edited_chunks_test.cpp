// Differences of edited chunks, computed by workers.
#include "terrane/net/server/edited_chunks.h"

#include <gtest/gtest.h>

#include <atomic>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/store/overlay_store.h"
#include "tests/world/content_blocks.h"

namespace terrane::net {
namespace {

// A store that cannot be read for a while, like a remote database.
class DistantStore : public store::MemoryStore {
  public:
    using MemoryStore::MemoryStore;
    store::LoadedChunk load(world::ChunkPos pos) override {
        store::LoadedChunk loaded = isAway ? store::LoadedChunk() : MemoryStore::load(pos);
        if (isAway) loaded.state = store::LoadedChunk::State::Damaged;
        loaded.isUnreadable = isAway;
        return loaded;
    }
    std::atomic<bool> isAway = true;
};

TEST(EditedChunks, WhatCannotBeReadIsAskedForAgain) {
    const auto generators = gen::makeLevelGenerators("flat", contentBlocks(), 1).value();
    DistantStore store{{.seed = 1, .generator = "flat", .generatorVersion = 1}};
    const auto chunk = std::make_shared<world::Chunk>(generators.generate({0, 0}));
    chunk->setBlock(world::blockIndex(3, 3, 100), contentBlock("glass"));
    store.save({0, 0}, chunk, store::Provenance::Edited);
    const world::World world;
    base::JobSystem jobs(1);
    EditedChunks edited({generators, store, world, jobs});
    edited.add({0, 0});
    const auto differenceAfter = [&](int updates) {
        const ChunkDifference* found = edited.maybeDifference({0, 0});
        for (int k = 0; k < updates && !found; ++k) {
            jobs.waitIdle();
            edited.update();
            found = edited.maybeDifference({0, 0});
        }
        return found;
    };
    EXPECT_FALSE(differenceAfter(200)) << "nobody knows yet";
    store.isAway = false;
    const ChunkDifference* found = differenceAfter(100);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->size(), 1u);
    EXPECT_EQ(found->front().value.id, contentBlock("glass"));
    jobs.waitIdle();
}

}  // namespace
}  // namespace terrane::net
