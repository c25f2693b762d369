// Worlds of other heights than 0…255 in PostgreSQL: the rows of a file, and a greater format.
#include "terrane/store/saves/world_copy.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "terrane/store_postgres/any_world.h"
#include "terrane/store_postgres/schema.h"
#include "terrane/store_postgres/world_database.h"
#include "tests/store_postgres/world_fixture.h"

namespace terrane::store_postgres {
namespace {

using store::LoadedChunk;
using store::Provenance;
using world::Heights;

class TallPostgresWorld : public PostgresWorldTest, public testing::WithParamInterface<Heights> {
  protected:
    Heights heights() const { return GetParam(); }
    store::SaveAccess create() const {
        store::SaveAccess access = kCreateWorld;
        access.create->heights = heights();
        return access;
    }
    world::ChunkPtr chunkOf(int number) const {
        auto chunk = std::make_shared<world::Chunk>(heights());
        chunk->setSection(heights().firstSection(), world::Section(1));
        chunk->setBlock(world::blockIndex(number & 15, 3, heights().bottom), 2);
        chunk->setBlockState(world::blockIndex(1, 1, heights().top - 1), static_cast<std::uint16_t>(number));
        chunk->setBlockEntityData(world::blockIndex(0, 0, heights().bottom), {std::byte(number)});
        return chunk;
    }
    void saveAll(store::ChunkStore& store) {
        for (int k = 0; k < 9; ++k) store.save({k, -k}, chunkOf(k), Provenance::Edited);
        ASSERT_TRUE(store.flush());
    }
    void expectSaved(store::ReadableStore& store) {
        EXPECT_EQ(store.identity(), *create().create);
        for (int k = 0; k < 9; ++k) {
            const LoadedChunk loaded = store.load({k, -k});
            ASSERT_EQ(loaded.state, LoadedChunk::State::Present) << loaded.problem;
            EXPECT_EQ(*loaded.chunk, *chunkOf(k));
        }
    }
};

INSTANTIATE_TEST_SUITE_P(Tall, TallPostgresWorld,
                         testing::Values(Heights{-64, 320}, Heights{-2048, 2048}, Heights{512, 1024}),
                         [](const auto& kind) { return fmt::format("{}", kind.param.top); });

TEST_P(TallPostgresWorld, ChunksComeBack) {
    saveAll(**tryOpen(create()));
    expectSaved(**tryOpen(kWorldMustBeThere));
    expectSaved(*openReader(address_, registry_, store::kNever).value());
    EXPECT_EQ(query("SELECT format FROM terrane_format"), std::to_string(newestFormat() + 1));
    EXPECT_EQ(query("SELECT value FROM settings WHERE name = 'bottom'"), std::to_string(heights().bottom));
    const auto report = checkDatabase(address_, registry_);
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->isDamaged());
    EXPECT_EQ(report->format, newestFormat() + 1);
    EXPECT_EQ(report->identity.heights, heights());
}

TEST_P(TallPostgresWorld, IsCopiedFromAFileAndBack) {
    const base::TempFolder folder;
    const auto file = folder / "a.sqlite", back = folder / "back.sqlite";
    saveAll(*store::SqliteStore::open(file, registry_, create(), store::kNever).value());
    const auto copy = [&](store::ReadableRows& from, store::ChunkRows& to) {
        return store::copyWorld(from, to, store::beginCopy(from, to).value()).value().digest;
    };
    std::string there, here;
    {
        const auto from = store::openSqliteToRead(file, registry_).value();
        const auto to =
            openRows(address_, registry_, store::accessOfCopy(*from), store::WorldSharing::Alone).value();
        there = copy(*from, *to);
    }
    {
        const auto from = openRowsToRead(address_, registry_).value();
        const auto to = store::openSqliteRows(back, registry_, store::accessOfCopy(*from)).value();
        here = copy(*from, *to);
    }
    EXPECT_EQ(here, there);
    expectSaved(**tryOpen(kWorldMustBeThere));
    expectSaved(*store::SqliteReader::open(back, registry_).value());
}

TEST_P(TallPostgresWorld, FormatAndHeightsBelongTogether) {
    saveAll(**tryOpen(create()));
    const auto expectBoth = [&](const std::string& reason) {
        expectError(errorOf(tryOpen(kWorldMustBeThere)), base::ErrorCode::Damaged, address_.shown, reason);
        expectError(errorOf(openReader(address_, registry_, store::kNever)), base::ErrorCode::Damaged,
                    address_.shown, reason);
    };
    sql(fmt::format("UPDATE terrane_format SET format = {}", newestFormat()));
    expectBoth(
        fmt::format("worlds of the layers {} have format {}", describe(heights()), newestFormat() + 1));
    sql(fmt::format(
        "UPDATE terrane_format SET format = {}; UPDATE settings SET value = '7' WHERE name = 'top'",
        newestFormat() + 1));
    expectBoth("a world's bottom and top are multiples of 16");
    sql("DELETE FROM settings WHERE name = 'top'");
    expectBoth("the setting top is missing");
    sql("DELETE FROM settings WHERE name = 'bottom'");
    expectBoth("worlds of the layers 0 to 255 have format");
}

TEST_P(TallPostgresWorld, IsRegeneratedWithItsHeights) {
    saveAll(**tryOpen(create()));
    ASSERT_TRUE(tryOpen(regenerateBy(5, store::Regenerate::AllButEdited)));
    const auto store = tryOpen(kWorldMustBeThere).value();
    EXPECT_EQ(store->identity().heights, heights());
    EXPECT_EQ(store->identity().generatorVersion, 5);
    EXPECT_EQ(store->load({2, -2}).provenance, Provenance::Edited);
    EXPECT_EQ(query("SELECT format FROM \"" + schema_ + "_backup_1\".terrane_format"),
              std::to_string(newestFormat() + 1));
}

TEST_F(PostgresWorldTest, LowWorldsKeepTheirFormat) {
    makeWorld();
    EXPECT_EQ(query("SELECT format FROM terrane_format"), std::to_string(newestFormat()));
    EXPECT_EQ(query("SELECT count(*) FROM settings WHERE name IN ('bottom', 'top')"), "0");
}

}  // namespace
}  // namespace terrane::store_postgres
