// Saves of formats 1 and 2, made by the SQL of docs/file-format-1.md and docs/file-format-2.md: opening for
// writing migrates them, opening for reading works without migration.
#include <gmock/gmock.h>

#include "terrane/store/chunks/chunk_codec.h"
#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/saves/save_check.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

constexpr const char* kFormerTables = R"(
CREATE TABLE settings   (name TEXT PRIMARY KEY NOT NULL, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE blocks     (id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE);
CREATE TABLE chunks     (key INTEGER PRIMARY KEY, origin INTEGER NOT NULL, data BLOB NOT NULL);
CREATE TABLE quarantine (number INTEGER PRIMARY KEY, key INTEGER NOT NULL, reason TEXT NOT NULL, data BLOB NOT NULL);
PRAGMA application_id = 1413829198;
INSERT INTO settings VALUES ('seed', '7'), ('generator', 'flat'), ('generator_version', '3'), ('player', '1,2,3');
INSERT INTO quarantine (key, reason, data) VALUES (5, 'broken', x'01');
)";

const std::vector<world::ChunkPos>& positions() {
    static const std::vector<world::ChunkPos> all = {{0, 0},
                                                     {-1, 5},
                                                     {1000, -2000},
                                                     {world::kMinChunk, world::kMaxChunk},
                                                     {world::kMaxChunk, world::kMinChunk},
                                                     {world::kMinChunk, world::kMinChunk}};
    return all;
}

class FormerFormatTest : public testing::TestWithParam<int> {
  protected:
    void SetUp() override {
        runSql(path_, kFormerTables + fmt::format("PRAGMA user_version = {}", GetParam()));
        const auto ids = BlockIdMap::make(registry_, {});
        ASSERT_TRUE(ids);
        auto database = Database::open(path_, OpenMode::ReadWrite);
        ASSERT_TRUE(database);
        auto addBlock = database->prepare("INSERT INTO blocks VALUES (?1, ?2)");
        auto addChunk = database->prepare("INSERT INTO chunks VALUES (?1, ?2, ?3)");
        ASSERT_TRUE(addBlock && addChunk);
        for (const SavedName& block : ids->added()) {
            addBlock->bind(1, std::int64_t{block.id});
            addBlock->bind(2, std::string_view(block.name));
            ASSERT_TRUE(addBlock->run());
        }
        for (std::size_t k = 0; k < positions().size(); ++k) {
            const world::ChunkPos pos = positions()[k];
            const std::int64_t half = 1 << 27;
            addChunk->bind(1, (pos.x + half) * (1 << 28) + (pos.y + half));
            addChunk->bind(2, static_cast<std::int64_t>(k % 2));
            addChunk->bind(3, ByteView(*encodeChunk(*numberedChunk(static_cast<int>(k)), *ids)));
            ASSERT_TRUE(addChunk->run());
        }
    }

    void expectAllIn(ReadableStore& store) {
        EXPECT_EQ(store.identity(), kIdentity);
        EXPECT_EQ(store.metadata("player"), "1,2,3");
        const auto many = store.loadMany(positions());
        for (std::size_t k = 0; k < many.size(); ++k) {
            ASSERT_EQ(many[k].state, LoadedChunk::State::Present) << k;
            EXPECT_EQ(*many[k].chunk, *numberedChunk(static_cast<int>(k)));
            EXPECT_EQ(many[k].provenance, k % 2 ? Provenance::Edited : Provenance::Generated);
        }
        EXPECT_EQ(store.load({0, 0, 1}).state, LoadedChunk::State::Absent);
    }

    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite", copy_ = folder_ / "a.before-migration-1.sqlite";
    world::BlockRegistry registry_ = testRegistry();
};

TEST_P(FormerFormatTest, OpeningToWriteMigrates) {
    {
        auto store = SqliteStore::open(path_, registry_, {}, kNever);
        ASSERT_TRUE(store) << store.error().message;
        expectAllIn(**store);
        (*store)->save({0, 0, 1}, numberedChunk(50), Provenance::Generated);
    }
    EXPECT_EQ(queryFile(path_, "PRAGMA user_version"), kFormatVersion);
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM chunks"), 7);
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM quarantine"), 1);
    EXPECT_EQ(queryFile(copy_, "PRAGMA user_version"), GetParam());
    EXPECT_EQ(queryFile(copy_, "SELECT count(*) FROM chunks"), 6);
    auto store = SqliteStore::open(path_, registry_, {}, kNever);
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_EQ(*(*store)->load({0, 0, 1}).chunk, *numberedChunk(50));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.before-migration-2.sqlite")) << "migrated once";
}

TEST_P(FormerFormatTest, ReadingLeavesItAsItIs) {
    const std::string before = readAll(path_);
    {
        auto store = SqliteReader::open(path_, registry_);
        ASSERT_TRUE(store) << store.error().message;
        expectAllIn(**store);
    }
    const auto report = checkSave(path_, registry_);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_FALSE(report->isDamaged());
    EXPECT_EQ(report->format, GetParam());
    EXPECT_EQ(report->chunks, 6u);
    EXPECT_TRUE(readAll(path_) == before);
    EXPECT_EQ(folder_.fileCount(), 1);
}

// Damaged rows stay damaged, and none of them is lost.
TEST_P(FormerFormatTest, DamagedRowsStayDamaged) {
    runSql(path_, fmt::format("UPDATE chunks SET data = zeroblob(100) WHERE key = {}; "
                              "UPDATE chunks SET origin = 'abc' WHERE key = {}",
                              keyOf({0, 0}), keyOf({-1, 5})));
    EXPECT_EQ(checkSave(path_, registry_)->damaged.size(), 2u);
    {
        auto store = SqliteStore::open(path_, registry_, {}, kNever);
        ASSERT_TRUE(store) << store.error().message;
        EXPECT_EQ((*store)->load({1000, -2000}).state, LoadedChunk::State::Present);
        EXPECT_EQ((*store)->load({0, 0}).state, LoadedChunk::State::Damaged);
    }
    EXPECT_EQ(checkSave(path_, registry_)->damaged.size(), 1u);
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM quarantine WHERE data = zeroblob(100)"), 1);
}

// The migration to format 3 is one transaction.
TEST_P(FormerFormatTest, AMigrationThatFailsChangesNothing) {
    const std::string name(kMaxNameBytes + 1, 'n');
    runSql(path_, fmt::format("INSERT INTO blocks VALUES (900, '{}')", name));
    const auto store = SqliteStore::open(path_, registry_, {}, kNever);
    ASSERT_FALSE(store);
    EXPECT_EQ(queryFile(path_, "PRAGMA user_version"), GetParam());
    EXPECT_FALSE(std::filesystem::exists(copy_));
    runSql(path_, "DELETE FROM blocks WHERE id = 900");
    const auto report = checkSave(path_, registry_);
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->isDamaged());
}

INSTANTIATE_TEST_SUITE_P(Formats, FormerFormatTest, testing::Values(1, 2));

}  // namespace
}  // namespace terrane::store
