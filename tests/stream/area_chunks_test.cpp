// Chunks of an area from a world that is partly saved and partly generated.
#include "terrane/stream/area_chunks.h"

#include <gtest/gtest.h>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/store/overlay_store.h"
#include "tests/world/content_blocks.h"

namespace terrane::stream {
namespace {

using world::ChunkPos;

constexpr ChunkPos kUnread{3, 1};

// A store with a chunk that it cannot read; it must be asked only for chunks of the world.
class PickyStore : public store::MemoryStore {
  public:
    using MemoryStore::MemoryStore;
    std::vector<store::LoadedChunk> loadMany(std::span<const ChunkPos> positions) override {
        auto loaded = MemoryStore::loadMany(positions);
        for (std::size_t k = 0; k < positions.size(); ++k) {
            EXPECT_TRUE(world::isInWorld(positions[k]));
            if (positions[k] != kUnread) continue;
            loaded[k].state = store::LoadedChunk::State::Damaged;
            loaded[k].problem = "the disk is gone";
            loaded[k].isUnreadable = true;
            loaded[k].isOverBudget = isOverBudget;
        }
        return loaded;
    }
    bool isOverBudget = false;
};

class AreaChunks : public testing::Test {
  protected:
    base::Result<std::vector<world::Chunk>> chunks(const std::vector<ChunkPos>& positions) {
        return chunksAt(positions, &store_, generator_, jobs_);
    }

    gen::Generator generator_{gen::makeGenerator("flat", contentBlocks()).value(), 1};
    PickyStore store_{{.seed = 1, .generator = "flat", .generatorVersion = 1}};
    base::JobSystem jobs_{2};
};

TEST_F(AreaChunks, AreWhatIsSavedElseGenerated) {
    const auto edited = std::make_shared<world::Chunk>();
    edited->setBlock(5, contentBlock("glass"));
    store_.save({2, 1}, edited, store::Provenance::Edited);
    const auto found = chunks({{1, 1}, {2, 1}});
    ASSERT_TRUE(found);
    EXPECT_EQ((*found)[0], generator_.generate({1, 1}));
    EXPECT_EQ((*found)[1], *edited);
}

TEST_F(AreaChunks, OneThatCannotBeReadIsAnError) {
    const auto found = chunks({{1, 1}, kUnread, {5, 5}});
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, base::ErrorCode::Io);
    EXPECT_EQ(found.error().message, "the disk is gone");
    store_.isOverBudget = true;
    EXPECT_EQ(chunks({kUnread}).value()[0], generator_.generate(kUnread)) << "as one that is damaged";
}

TEST_F(AreaChunks, BeyondTheWorldThereIsAir) {
    const ChunkPos edge{world::kMaxChunk, world::kMaxChunk}, beyond{world::kMaxChunk, world::kMaxChunk + 1};
    const auto found = chunks({edge, beyond});
    ASSERT_TRUE(found);
    EXPECT_EQ((*found)[0], generator_.generate(edge));
    EXPECT_EQ((*found)[1], world::Chunk());
}

}  // namespace
}  // namespace terrane::stream
