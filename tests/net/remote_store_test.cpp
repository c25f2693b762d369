#include "terrane/net/remote_store.h"

#include <gtest/gtest.h>

#include "terrane/gen/generators/catalogue.h"
#include "tests/world/content_blocks.h"

namespace terrane::net {
namespace {

gen::LevelGenerators overworld() {
    return gen::makeLevelGenerators("overworld", contentBlocks(), 1).value();
}

class RemoteStoreTest : public testing::Test {
  protected:
    gen::LevelGenerators generators_ = overworld();
    RemoteStore store_{{1, "overworld", gen::generatorVersion("overworld")}, overworld()};
};

TEST_F(RemoteStoreTest, WhatTheServerDoesNotTellIsGenerated) {
    EXPECT_EQ(store_.load({3, 4}).state, store::LoadedChunk::State::Absent);
    EXPECT_FALSE(store_.contains({3, 4}));
}

TEST_F(RemoteStoreTest, EditedChunksAreGeneratedWithTheirDifference) {
    for (const world::ChunkPos pos : {world::ChunkPos{3, 4}, world::ChunkPos{-1, 2, 3}}) {
        const world::Chunk generated = generators_.generate(pos);
        world::Chunk edited = generated;
        edited.setBlock(12345, contentBlock("glass"));
        edited.setBlock(40000, contentBlock("glass"));
        store_.setDifference(pos, chunkDifference(generated, edited));
        const store::LoadedChunk loaded = store_.load(pos);
        ASSERT_EQ(loaded.state, store::LoadedChunk::State::Present);
        EXPECT_EQ(loaded.provenance, store::Provenance::Edited);
        EXPECT_EQ(*loaded.chunk, edited);
    }
    EXPECT_EQ(*store_.editedChunks(), (std::vector<world::ChunkPos>{{3, 4}}));
    EXPECT_EQ(store_.blockCount(), 4u);
}

TEST_F(RemoteStoreTest, LaterChangesAreAdded) {
    const ChangedBlock stone{5, {contentBlock("stone"), 0, {}}}, dirt{5, {contentBlock("dirt"), 0, {}}};
    store_.addDifference({0, 0}, std::vector{stone});
    store_.addDifference({0, 0}, std::vector{dirt});
    EXPECT_EQ(store_.difference({0, 0}), (ChunkDifference{dirt}));
    store_.setDifference({0, 0}, {});
    EXPECT_FALSE(store_.contains({0, 0}));
}

TEST_F(RemoteStoreTest, NothingIsSaved) {
    store_.save({0, 0}, std::make_shared<const world::Chunk>(), store::Provenance::Edited);
    EXPECT_FALSE(store_.contains({0, 0}));
    EXPECT_FALSE(store_.isPersistent());
    EXPECT_TRUE(store_.flush());
}

}  // namespace
}  // namespace terrane::net
