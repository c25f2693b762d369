// PostgreSQL and SQLite give equal results for the same random saves.
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store_postgres/world_fixture.h"
#include "tests/support/default_heights.h"

namespace terrane::store_postgres {
namespace {

using store::LoadedChunk;
using store::Provenance;
using world::ChunkPos;

constexpr int kSide = 6;

// A random chunk of blocks that the registry has.
world::ChunkPtr randomKnownChunk(std::mt19937& random, const world::BlockRegistry& registry) {
    auto chunk = std::make_shared<world::Chunk>(store::randomChunk(random));
    const auto types = static_cast<world::Section::Value>(registry.types().size());
    for (int n = 0; n < world::kSectionsPerChunk; ++n) {
        std::array<world::Section::Value, world::kBlocksPerSection> values;
        const auto distinct = 1 + random() % types;
        for (auto& value : values) value = static_cast<world::Section::Value>(random() % distinct);
        chunk->setSection(n, world::Section::fromValues(values));
    }
    return chunk;
}

ChunkPos randomPos(std::mt19937& random) {
    const auto coordinate = [&] { return static_cast<int>(random() % kSide) - kSide / 2; };
    const auto level = static_cast<std::uint8_t>(random() % 4 == 0 ? 1 + random() % 2 : 0);
    return {coordinate(), coordinate(), level};
}

std::vector<ChunkPos> allPositions() {
    std::vector<ChunkPos> positions;
    for (std::uint8_t level = 0; level < 3; ++level)
        for (int x = -kSide / 2; x < kSide / 2; ++x)
            for (int y = -kSide / 2; y < kSide / 2; ++y) positions.push_back({x, y, level});
    return positions;
}

class BothDatabasesTest : public PostgresWorldTest {
  protected:
    void openBoth() {
        postgres_.reset();
        sqlite_.reset();
        postgres_ = open();
        auto store = store::SqliteStore::open(path_, registry_, kCreateWorld, store::kNever);
        if (!store) throw std::runtime_error(store.error().message);
        sqlite_ = std::move(*store);
    }
    void saveInBoth(std::mt19937& random) {
        const auto provenance = random() % 2 ? Provenance::Edited : Provenance::Generated;
        const ChunkPos pos = randomPos(random);
        const auto chunk = randomKnownChunk(random, registry_);
        const std::string name = "name " + std::to_string(random() % 5), value = std::to_string(random());
        for (store::ChunkStore* store : {static_cast<store::ChunkStore*>(postgres_.get()),
                                         static_cast<store::ChunkStore*>(sqlite_.get())}) {
            store->save(pos, chunk, provenance);
            store->setMetadata(name, value);
        }
    }
    void expectSame() {
        const auto positions = allPositions();
        const auto many = postgres_->loadMany(positions), wanted = sqlite_->loadMany(positions);
        for (std::size_t k = 0; k < positions.size(); ++k) {
            expectSameChunk(many[k], wanted[k], positions[k]);
            EXPECT_EQ(postgres_->contains(positions[k]), sqlite_->contains(positions[k]));
        }
        EXPECT_EQ(postgres_->editedChunks().value(), sqlite_->editedChunks().value());
        for (int k = 0; k < 5; ++k) {
            const std::string name = "name " + std::to_string(k);
            EXPECT_EQ(postgres_->metadata(name), sqlite_->metadata(name));
        }
    }
    void expectSameChunk(const LoadedChunk& loaded, const LoadedChunk& wanted, ChunkPos pos) {
        ASSERT_EQ(loaded.state, wanted.state) << store::nameOf(pos);
        const LoadedChunk one = postgres_->load(pos);
        ASSERT_EQ(one.state, wanted.state) << store::nameOf(pos);
        if (!wanted.chunk) return;
        ++compared_;
        EXPECT_TRUE(*loaded.chunk == *wanted.chunk && *one.chunk == *wanted.chunk) << store::nameOf(pos);
        EXPECT_EQ(loaded.provenance, wanted.provenance) << store::nameOf(pos);
    }

    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite";
    std::unique_ptr<PostgresStore> postgres_;
    std::unique_ptr<store::SqliteStore> sqlite_;
    int compared_ = 0;
};

TEST_F(BothDatabasesTest, RandomSavesGiveTheSame) {
    for (const std::uint32_t seed : {1u, 2u}) {
        std::mt19937 random(seed);
        openBoth();
        for (int round = 0; round < 4; ++round) {
            for (int k = 0; k < 25; ++k) saveInBoth(random);
            if (random() % 2) expectSame();  // with queued saves
            ASSERT_TRUE(postgres_->flush() && sqlite_->flush());
            expectSame();
        }
        openBoth();
        expectSame();
    }
    EXPECT_GT(compared_, 400);
}

}  // namespace
}  // namespace terrane::store_postgres
