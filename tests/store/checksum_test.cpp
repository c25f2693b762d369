// Coverage of the checksums of format 3: any flipped bit in a save is detected by the check, or changes
// nothing that is read.
#include <gmock/gmock.h>

#include <cstdlib>

#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/saves/save_check.h"
#include "terrane/store/sqlite/metadata_table.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store/store_fixture.h"
#include "tests/support/depth.h"

namespace terrane::store {
namespace {

using testing::HasSubstr;

class ChecksumTest : public testing::Test {
  protected:
    static constexpr int kChunks = 12;

    static world::ChunkPos posOfChunk(int k) { return {k % 4 - 2, k / 4, static_cast<std::uint8_t>(k % 3)}; }
    static Provenance provenanceOf(int k) { return k % 2 ? Provenance::Edited : Provenance::Generated; }

    void SetUp() override {
        const auto store = SqliteStore::open(path_, registry_, {.create = kIdentity, .decide = {}});
        ASSERT_TRUE(store);
        for (int k = 0; k < kChunks; ++k) (*store)->save(posOfChunk(k), numberedChunk(k), provenanceOf(k));
        (*store)->setMetadata("player", "1,2,3");
        (*store)->setMetadata("time", "0.5");
    }
    bool isRefused(const std::string& reason) {
        const auto reader = SqliteReader::open(path_, registry_);
        return !reader && reader.error().code == base::ErrorCode::Damaged &&
               reader.error().message.find(reason) != std::string::npos;
    }
    // Whether everything that a game reads is as saved.
    bool isWhole() {
        const auto reader = SqliteReader::open(path_, registry_);
        if (!reader || (*reader)->identity() != kIdentity) return false;
        if ((*reader)->metadata("player") != "1,2,3" || (*reader)->metadata("time") != "0.5") return false;
        for (int k = 0; k < kChunks; ++k) {
            const LoadedChunk loaded = (*reader)->load(posOfChunk(k));
            if (!loaded.chunk || !(*loaded.chunk == *numberedChunk(k)) ||
                loaded.provenance != provenanceOf(k))
                return false;
        }
        const auto report = checkSave(path_, registry_);
        return report && report->chunks == kChunks;
    }

    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite";
    world::BlockRegistry registry_ = testRegistry();
};

TEST_F(ChecksumTest, KeysAndOriginsOfChunks) {
    const world::ChunkPos moved = posOfChunk(1), other = posOfChunk(2);
    runSql(path_, fmt::format("UPDATE chunks SET key = {} WHERE key = {}; "
                              "UPDATE chunks SET origin = 1 - origin WHERE key = {}",
                              keyOf({50, 50}), keyOf(moved), keyOf(other)));
    const auto report = checkSave(path_, registry_);
    ASSERT_TRUE(report);
    ASSERT_EQ(report->damaged.size(), 2u);
    for (const DamagedChunk& chunk : report->damaged) EXPECT_EQ(chunk.problem, "the checksum is wrong");
    const auto store = SqliteStore::open(path_, registry_, {});
    ASSERT_TRUE(store);
    EXPECT_EQ((*store)->load({50, 50}).state, LoadedChunk::State::Damaged);
    EXPECT_EQ((*store)->load(other).state, LoadedChunk::State::Damaged);
    EXPECT_EQ((*store)->load(posOfChunk(0)).state, LoadedChunk::State::Present);
}

TEST_F(ChecksumTest, SettingsAndNamesOfBlocks) {
    const char* changes[] = {"UPDATE settings SET value = '8' WHERE name = 'seed'",
                             "UPDATE settings SET value = '1,2,4' WHERE name = 'player'",
                             "UPDATE settings SET name = 'plaxer' WHERE name = 'player'",
                             "DELETE FROM settings WHERE name = 'time'",
                             "INSERT INTO settings VALUES ('more', '')",
                             "UPDATE blocks SET name = 'stane' WHERE id = 1",
                             "UPDATE blocks SET id = 99 WHERE id = 1",
                             "DELETE FROM blocks WHERE id = 1",
                             "INSERT INTO blocks VALUES (77, 'new')",
                             "UPDATE settings SET value = value || '0' WHERE name = 'checksum'"};
    const std::string whole = readAll(path_);
    for (const char* change : changes) {
        runSql(path_, change);
        EXPECT_TRUE(isRefused("the checksum of its settings and block names is wrong")) << change;
        writeAll(path_, whole);
    }
    runSql(path_, "DELETE FROM settings WHERE name = 'checksum'");
    EXPECT_TRUE(isRefused("the setting checksum is missing"));
}

TEST_F(ChecksumTest, AnotherProgramLeavesTheChecksumToThisOne) {
    runSql(path_,
           "INSERT INTO settings VALUES ('more', 'a'); UPDATE settings SET value = '' WHERE name = "
           "'checksum'");
    EXPECT_TRUE(isWhole());
    { ASSERT_TRUE(SqliteStore::open(path_, registry_, {})); }
    EXPECT_EQ(queryFile(path_, "SELECT value = '' FROM settings WHERE name = 'checksum'"), 0);
    EXPECT_TRUE(isWhole());
    runSql(path_, "UPDATE settings SET value = 'b' WHERE name = 'more'");
    EXPECT_FALSE(isWhole());
}

TEST_F(ChecksumTest, TheStoreAloneWritesTheChecksum) {
    {
        const auto store = SqliteStore::open(path_, registry_, {});
        ASSERT_TRUE(store);
        EXPECT_EQ((*store)->metadata(kChecksum), std::nullopt);
        (*store)->setMetadata(kChecksum, "1");
    }
    EXPECT_TRUE(isWhole());
}

// Writing does not hide damage elsewhere.
TEST_F(ChecksumTest, WritingDoesNotHideDamage) {
    auto database = Database::open(path_, OpenMode::ReadWrite);
    ASSERT_TRUE(database && database->execute("UPDATE settings SET value = '8' WHERE name = 'seed'"));
    auto table = MetadataTable::make(*database);
    ASSERT_TRUE(table && table->put("player", "4,5,6") && table->put("new", "1") && table->remove("time"));
    ASSERT_TRUE(table->add({500, "new"}));
    EXPECT_TRUE(isRefused("the checksum of its settings"));
    ASSERT_TRUE(database->execute("UPDATE settings SET value = '7' WHERE name = 'seed'"));
    EXPECT_TRUE(SqliteReader::open(path_, registry_));
}

// All bits at full depth (minutes); at the gate's, steps that cover all bit positions.
TEST_F(ChecksumTest, OneFlippedBitIsNoticedOrHarmless) {
    ASSERT_TRUE(isWhole());
    const std::string whole = readAll(path_);
    const std::size_t step = atDepth(1009, 1);
    int flips = 0, noticed = 0, silent = 0;
    for (std::size_t bit = 0; bit < whole.size() * 8; bit += step) {
        std::string bytes = whole;
        bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ 1 << bit % 8);
        writeAll(path_, bytes);
        ++flips;
        const auto report = checkSave(path_, registry_);
        if (!report || report->isDamaged()) {
            ++noticed;
        } else if (!isWhole()) {
            ++silent;
            ADD_FAILURE() << "bit " << bit % 8 << " of byte " << bit / 8 << " changes what is read";
        }
    }
    std::printf("%d flips: %d noticed, %d harmless, %d silent\n", flips, noticed, flips - noticed - silent,
                silent);
    EXPECT_GT(noticed, flips / 20);
}

}  // namespace
}  // namespace terrane::store
