// Worlds of other heights than 0…255 in files, and what files say that contradict their heights.
#include <gmock/gmock.h>

#include "terrane/store/overlay_store.h"
#include "terrane/store/saves/save_check.h"
#include "terrane/store/saves/world_copy.h"
#include "terrane/store/sqlite/schema.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

using testing::HasSubstr;
using world::Heights;

WorldIdentity identityOf(Heights heights) {
    WorldIdentity identity = kIdentity;
    identity.heights = heights;
    return identity;
}

// Blocks of the registry at both ends, with block state and block entity data.
world::ChunkPtr chunkOf(Heights heights, int number) {
    auto chunk = std::make_shared<world::Chunk>(heights);
    const int lowest = heights.bottom, highest = heights.top - 1;
    for (int n = heights.firstSection(); n < heights.endSection(); n += 3)
        chunk->setSection(n, world::Section(1));
    chunk->setBlock(world::blockIndex(number & 15, 3, lowest), 2);
    chunk->setBlock(world::blockIndex(4, number & 15, highest), 3);
    chunk->setBlockState(world::blockIndex(1, 1, lowest), static_cast<std::uint16_t>(number));
    chunk->setBlockEntityData(world::blockIndex(0, 0, lowest), {std::byte{1}, std::byte(number)});
    chunk->setBlockEntityData(world::blockIndex(15, 15, highest), {std::byte{2}});
    return chunk;
}

class TallWorldTest : public testing::TestWithParam<Heights> {
  protected:
    Heights heights() const { return GetParam(); }
    std::unique_ptr<SqliteStore> open() {
        return SqliteStore::open(path_, registry_, {.create = identityOf(heights()), .decide = {}}, kNever)
            .value();
    }
    void expectSaved(ReadableStore& store) {
        EXPECT_EQ(store.identity(), identityOf(heights()));
        for (int k = 0; k < 20; ++k) {
            const LoadedChunk loaded = store.load({k, -k});
            ASSERT_EQ(loaded.state, LoadedChunk::State::Present) << loaded.problem;
            EXPECT_EQ(*loaded.chunk, *chunkOf(heights(), k));
        }
    }
    void saveAll(ChunkStore& store) {
        for (int k = 0; k < 20; ++k) store.save({k, -k}, chunkOf(heights(), k), Provenance::Edited);
        store.save({0, 0, 3}, chunkOf(heights(), 7), Provenance::Edited);
        ASSERT_TRUE(store.flush());
    }
    std::string errorOfOpening() {
        const auto read = openToRead(path_, registry_);
        const auto written = openToWrite(path_, registry_, {.create = {}, .decide = {}});
        EXPECT_FALSE(read);
        EXPECT_FALSE(written);
        if (read || written) return {};
        EXPECT_EQ(read.error().message, written.error().message);
        EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
        return read.error().message;
    }

    base::TempFolder folder_;
    const std::filesystem::path path_ = folder_ / "a.sqlite";
    const world::BlockRegistry registry_ = testRegistry();
};

INSTANTIATE_TEST_SUITE_P(Tall, TallWorldTest, testing::ValuesIn(kTallHeights), [](const auto& kind) {
    std::string name = fmt::format("{}_{}", kind.param.bottom, kind.param.top);
    std::ranges::replace(name, '-', 'm');
    return name;
});

TEST_P(TallWorldTest, ChunksComeBack) {
    saveAll(*open());
    expectSaved(*open());
    expectSaved(*SqliteReader::open(path_, registry_).value());
    EXPECT_EQ(queryFile(path_, "PRAGMA user_version"), 4);
    EXPECT_EQ(queryFile(path_, "SELECT value FROM settings WHERE name = 'bottom'"), heights().bottom);
    EXPECT_EQ(queryFile(path_, "SELECT value FROM settings WHERE name = 'top'"), heights().top);
}

TEST_P(TallWorldTest, InMemoryAndAsOverlay) {
    MemoryStore memory(identityOf(heights()), kNever);
    saveAll(memory);
    expectSaved(memory);
    saveAll(*open());
    OverlayStore overlay(SqliteReader::open(path_, registry_).value(), kNever);
    expectSaved(overlay);
}

TEST_P(TallWorldTest, IsCheckedAndCopied) {
    saveAll(*open());
    const auto report = checkSave(path_, registry_);
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->isDamaged());
    EXPECT_EQ(report->format, kTallFormatVersion);
    EXPECT_EQ(report->editedChunks, 20u);
    EXPECT_EQ(report->tiles, 1u);
    const auto to = folder_ / "copy.sqlite";
    {
        auto from = openSqliteToRead(path_, registry_).value();
        auto rows = openSqliteRows(to, registry_, accessOfCopy(*from)).value();
        const auto copied = copyWorld(*from, *rows, beginCopy(*from, *rows).value());
        ASSERT_TRUE(copied) << copied.error().message;
        EXPECT_EQ(copied->rows, 21u);
        EXPECT_EQ(copied->damaged, 0u);
    }
    expectSaved(*SqliteReader::open(to, registry_).value());
    EXPECT_EQ(queryFile(to, "PRAGMA user_version"), 4);
}

TEST_P(TallWorldTest, ChunksOfOtherHeightsAreDamaged) {
    saveAll(*open());
    const Heights other = heights() == Heights{-64, 320} ? Heights{0, 384} : Heights{-64, 320};
    const auto ids = BlockIdMap::make(registry_, {}).value();
    const auto wrong = encodeChunk(*chunkOf(other, 1), ids, checksumSeed({0, 0}, true)).value();
    const auto low = encodeChunk(*numberedChunk(1), ids, checksumSeed({1, -1}, true)).value();
    {
        auto database = Database::open(path_, OpenMode::ReadWrite).value();
        auto put = database.prepare("UPDATE chunks SET data = ?2 WHERE key = ?1").value();
        for (const auto& [pos, data] : {std::pair(world::ChunkPos{0, 0}, wrong), {{1, -1}, low}}) {
            put.bind(1, keyOf(pos));
            put.bind(2, ByteView(data));
            ASSERT_TRUE(put.run());
        }
    }
    const auto report = checkSave(path_, registry_);
    ASSERT_TRUE(report);
    ASSERT_EQ(report->damaged.size(), 2u);
    EXPECT_THAT(report->damaged[0].problem, HasSubstr(fmt::format("the chunk has bottom {}", other.bottom)));
    EXPECT_EQ(report->damaged[1].problem, "chunk version 1, expected 2");
    const auto store = open();
    EXPECT_EQ(store->load({0, 0}).state, LoadedChunk::State::Damaged);
    // Replaced without having been loaded: the old row is kept.
    store->save({1, -1}, chunkOf(heights(), 1), Provenance::Edited);
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM quarantine"), 2);
}

TEST_P(TallWorldTest, FormatAndHeightsBelongTogether) {
    saveAll(*open());
    runSql(path_, "UPDATE settings SET value = '' WHERE name = 'checksum'; PRAGMA user_version = 3");
    EXPECT_EQ(errorOfOpening(),
              fmt::format("{}: damaged: in format 3, but worlds of the layers {} have format 4",
                          path_.string(), describe(heights())));
    runSql(path_, "PRAGMA user_version = 4; DELETE FROM settings WHERE name = 'bottom'");
    EXPECT_THAT(errorOfOpening(), HasSubstr("damaged: the setting bottom is missing"));
    runSql(path_, "DELETE FROM settings WHERE name = 'top'");
    EXPECT_THAT(errorOfOpening(), HasSubstr("in format 4, but worlds of the layers 0 to 255 have format 3"));
    runSql(path_, "INSERT INTO settings VALUES ('bottom', '-64'), ('top', '99')");
    EXPECT_THAT(errorOfOpening(), HasSubstr("damaged: a world's bottom and top are multiples of 16"));
    runSql(path_, "PRAGMA user_version = 5");
    EXPECT_THAT(errorOfOpening(), HasSubstr("in format 5, this program reads up to format 4"));
}

TEST_P(TallWorldTest, IsAnotherWorldThanThatOf256Layers) {
    saveAll(*open());
    const auto refused =
        openToWrite(path_, registry_,
                    {.create = {}, .decide = [&](const WorldIdentity& saved) -> base::Result<Regeneration> {
                         TERRANE_TRY(requireSame(saved, kIdentity, "a"));
                         return Regeneration();
                     }});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message,
              fmt::format("a: has the layers {}, not 0 to 255", describe(heights())));
}

// Programs that know only 0…255 read their worlds, and refuse the others by the number of the format.
TEST(LowWorld, KeepsItsFormat) {
    const base::TempFolder folder;
    const auto path = folder / "a.sqlite";
    const world::BlockRegistry registry = testRegistry();
    ASSERT_TRUE(SqliteStore::open(path, registry, {.create = kIdentity, .decide = {}}, kNever));
    EXPECT_EQ(queryFile(path, "PRAGMA user_version"), 3);
    EXPECT_EQ(queryFile(path, "SELECT count(*) FROM settings WHERE name IN ('bottom', 'top')"), 0);
    auto database = Database::open(path, OpenMode::ReadWrite).value();
    EXPECT_EQ(classify(database, {3, 3}).value(), SaveKind::Current);
    ASSERT_TRUE(database.execute("PRAGMA user_version = 4"));
    EXPECT_THAT(classify(database, {3, 3}).error().message, HasSubstr("use a newer version"));
}

}  // namespace
}  // namespace terrane::store
