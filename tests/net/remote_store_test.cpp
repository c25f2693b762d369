#include "terrane/net/client/remote_session.h"

#include <gtest/gtest.h>

#include "terrane/game/session.h"
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
    RemoteStore store_{{1, "overworld", gen::versionOf(gen::builtInGenerators(), "overworld")}, overworld()};
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

// In a client's session, chunks include the server's edits, and own edits are lost with the chunk.
TEST_F(RemoteStoreTest, ASessionPlaysOnIt) {
    auto store = std::make_unique<RemoteStore>(store_.identity(), overworld());
    const world::BlockPos pos{3, 4, 200};
    const ChangedBlock glass{world::blockIndex(pos), {contentBlock("glass"), 0, {}}};
    store->setDifference({0, 0}, {glass});
    game::Session session(
        {std::make_unique<const world::BlockRegistry>(contentBlocks()), overworld(), std::move(store), 1});
    const auto chunk = session.pipeline().chunkAt({0, 0});
    EXPECT_EQ(chunk->block(world::blockIndex(pos)), contentBlock("glass"));
    EXPECT_EQ(session.edit({game::kNoPlayer, {3, 4, 201}, world::SetBlock{contentBlock("glass")}, {}}),
              game::EditResult::Applied);
    ASSERT_TRUE(session.save());
    const store::LoadedChunk known = session.store().load({0, 0});
    EXPECT_EQ(known.chunk->block(world::blockIndex(3, 4, 200)), contentBlock("glass"));
    EXPECT_EQ(known.chunk->block(world::blockIndex(3, 4, 201)), world::kAir);
}

TEST_F(RemoteStoreTest, NothingIsSaved) {
    store_.save({0, 0}, std::make_shared<const world::Chunk>(), store::Provenance::Edited);
    EXPECT_FALSE(store_.contains({0, 0}));
    EXPECT_FALSE(store_.isPersistent());
    EXPECT_TRUE(store_.flush());
}

}  // namespace
}  // namespace terrane::net
