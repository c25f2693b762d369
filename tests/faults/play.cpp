#include "tests/faults/play.h"

#include <sqlite3.h>

#include <cstring>

#include "terrane/store/saves/save_check.h"
#include "tests/base/failing_memory.h"
#include "tests/faults/expect_tiles.h"

namespace terrane::store {
namespace {

constexpr world::BlockIndex kMark = 12345;
constexpr const char* kSumRules = "sums";

// Connections opened during its lifetime checkpoint the log after a few pages instead of 1,000.
class FewLogPages {
  public:
    FewLogPages() {
        first_ = nullptr;
        sqlite3_auto_extension(kHook);
    }
    ~FewLogPages() { sqlite3_cancel_auto_extension(kHook); }
    FewLogPages(const FewLogPages&) = delete;
    FewLogPages& operator=(const FewLogPages&) = delete;
    // Applies to the writing connection, which is opened first.
    static void apply() {
        if (first_) sqlite3_wal_autocheckpoint(first_, 8);
    }

  private:
    static int remember(sqlite3* database, const char**, const sqlite3_api_routines*) {
        if (!first_) first_ = database;
        return SQLITE_OK;
    }
    inline static sqlite3* first_ = nullptr;
    inline static void (*const kHook)() = reinterpret_cast<void (*)()>(&FewLogPages::remember);
};

}  // namespace

world::ChunkPtr markedChunk(int content) {
    auto chunk = std::make_shared<world::Chunk>(*numberedChunk(content));
    if (content % 5 == 4) chunk->setBlock(0, world::kAir);  // has no tiles
    const auto bytes = std::as_bytes(std::span(&content, 1));
    chunk->setBlockEntityData(kMark, world::BlockEntityData(bytes.begin(), bytes.end()));
    return chunk;
}

int contentOf(const LoadedChunk& loaded) {
    if (!loaded.chunk) return 0;
    int content = 0;
    const world::BlockEntityData* mark = loaded.chunk->blockEntityData(kMark);
    if (mark && mark->size() == sizeof content) std::memcpy(&content, mark->data(), sizeof content);
    return *loaded.chunk == *markedChunk(content) ? content : -1;
}

Play::Play(const base::TempFolder& folder, const Start& start)
    : path_(folder / "a.sqlite"), ledger_(start.ledger), damaged_(start.damaged) {
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        std::filesystem::remove(entry.path());
    for (const auto& [name, content] : start.files) writeAll(folder / name.c_str(), content);
}

std::unique_ptr<SqliteStore> Play::open() {
    const FewLogPages few;
    auto store = SqliteStore::open(path_, registry_, {.create = kIdentity, .decide = {}}, kNever);
    if (!store) {
        reportsAll = false;
        return nullptr;
    }
    FewLogPages::apply();
    return std::move(*store);
}

void Play::save(SqliteStore& store, world::ChunkPos pos) {
    const int content = ++content_;
    const SaveNumber number = store.save(pos, markedChunk(content), Provenance::Edited);
    const base::EnoughMemory enough;
    ledger_.saved(pos, content, number);
}

// Twice: a temporary failure must succeed on retry.
void Play::flush(SqliteStore& store) {
    for (int attempt = 0; attempt < 2; ++attempt) {
        const bool isDone = store.flush().has_value();
        const base::EnoughMemory enough;
        const SaveStatus status = store.status();
        ledger_.durable(status.durable);
        EXPECT_EQ(isDone, status.durable == status.queued);
        EXPECT_EQ(isDone, status.problem.empty());
        if (isDone) return;
        EXPECT_LT(attempt, lasts_ ? 2 : 1) << status.problem;
        reportsAll = false;
    }
}

// A temporary read failure must succeed on retry.
void Play::expectLoads(SqliteStore& store) {
    const std::vector<world::ChunkPos> all = ledger_.positions();
    for (int attempt = 0; attempt < 2; ++attempt) {
        const std::vector<LoadedChunk> loaded = store.loadMany(all);
        const base::EnoughMemory enough;
        ASSERT_EQ(loaded.size(), all.size());
        int unread = 0;
        for (std::size_t k = 0; k < all.size(); ++k) {
            const bool isUnreadable = loaded[k].state == LoadedChunk::State::Damaged;
            unread += isUnreadable ? 1 : 0;
            EXPECT_TRUE(isUnreadable || ledger_.mayHold(all[k], contentOf(loaded[k])))
                << nameOf(all[k]) << " holds " << contentOf(loaded[k]);
        }
        if (unread <= damaged_) return;
        reportsAll = false;
        EXPECT_LT(attempt, lasts_ ? 2 : 1) << unread << " chunks still cannot be read, " << loaded[0].problem;
    }
}

void Play::session(SqliteStore& store) {
    store.setDerivedRows({deriveSums, {}});
    if (!ensureDerivedRows(store, kSumRules)) reportsAll = false;
    expectLoads(store);
    for (int x = 0; x < 3; ++x) save(store, {x, 0});
    store.save({9, 9}, markedChunk(1), Provenance::Generated);
    flush(store);
    store.setMetadata("time", std::to_string(content_));
    for (int x = 1; x < 4; ++x) save(store, {x, 0});
    flush(store);
    (void)store.load({1, 0});
    (void)store.contains({1, 0, 1});
    (void)store.editedChunks();
    expectLoads(store);
    save(store, {0, 0});  // written at the end
}

void Play::run(bool lasts) {
    lasts_ = lasts;
    for (int round = 0; round < 2; ++round) {
        auto store = open();
        if (store) session(*store);
        store.reset();
        const base::EnoughMemory enough;
        ledger_.closed();
    }
}

void Play::expectGoodCheck(bool mayBeUndone) const {
    const auto report = checkSave(path_, registry_);
    if (!report) {
        using base::ErrorCode;
        const bool isNone = report.error().code == ErrorCode::NotFound ||
                            report.error().message.find("empty, not a save") != std::string::npos;
        const bool isUndone = report.error().message.find("was interrupted") != std::string::npos;
        EXPECT_TRUE(mayBeUndone && (isNone || isUndone)) << report.error().message;
        return;
    }
    for (const std::string& problem : report->fileProblems)
        EXPECT_TRUE(mayBeUndone && problem.find("unless it was never finished") != std::string::npos)
            << problem;
    if (!mayBeUndone)
        for (const DamagedChunk& chunk : report->damaged)
            ADD_FAILURE() << nameOf(chunk.pos) << ": " << chunk.problem;
}

void Play::verify() {
    lasts_ = false;
    expectGoodCheck(true);
    auto store = open();
    ASSERT_TRUE(store) << "the save cannot be opened any more";
    expectLoads(*store);
    ASSERT_TRUE(store->flush()) << "damaged rows are quarantined";
    expectTiles(*store, kSumRules);
    for (const world::ChunkPos pos : ledger_.positions()) {
        const int content = contentOf(store->load(pos));
        ledger_.found(pos, content);
    }
    store->setDerivedRows({deriveSums, {}});
    ASSERT_TRUE(ensureDerivedRows(*store, kSumRules));
    for (int x = 0; x < 5; ++x) save(*store, {x, 0});
    ASSERT_TRUE(store->flush());
    ledger_.durable(store->status().durable);
    expectLoads(*store);
    expectTiles(*store, kSumRules);
    store.reset();
    ledger_.closed();
    damaged_ = 0;
    expectGoodCheck(false);
}

}  // namespace terrane::store
