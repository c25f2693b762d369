#include "terrane/store/saves/save_check.h"

#include <gmock/gmock.h>
#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#endif

#include <csignal>

#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/sqlite/schema.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store/faulty_disk.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

using testing::HasSubstr;

class SaveCheckTest : public testing::Test {
  protected:
    void SetUp() override {
        const auto store = SqliteStore::open(path_, registry_, {.create = kIdentity, .decide = {}});
        ASSERT_TRUE(store);
        for (int x = 0; x < 30; ++x)
            (*store)->save({x, -x}, numberedChunk(x),
                           x % 3 == 0 ? Provenance::Edited : Provenance::Generated);
    }
    CheckReport check() {
        auto report = checkSave(path_, registry_);
        if (!report) throw std::runtime_error(report.error().message);
        return *report;
    }

    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite";
    world::BlockRegistry registry_ = testRegistry();
};

TEST_F(SaveCheckTest, GoodSave) {
    const std::string before = readAll(path_);
    const CheckReport report = check();
    EXPECT_FALSE(report.isDamaged());
    EXPECT_EQ(report.chunks, 30u);
    EXPECT_EQ(report.editedChunks, 10u);
    EXPECT_EQ(report.identity, kIdentity);
    EXPECT_EQ(report.format, kFormatVersion);
    EXPECT_EQ(report.fileBytes, before.size());
    EXPECT_GT(report.chunkBytes, 30u * 40);
    EXPECT_TRUE(report.unknownBlocks.empty());
    EXPECT_TRUE(readAll(path_) == before);
    EXPECT_EQ(folder_.fileCount(), 1);
}

#ifndef _WIN32  // no fork(): tools/kill_test.py does the same with programs

// Saves edits and settings as fast as it can until it is killed.
[[noreturn]] void saveForEver(const std::filesystem::path& path, const world::BlockRegistry& registry,
                              int started) {
    const SaveLimits limits{.delay = std::chrono::milliseconds(1), .chunks = 20};
    const auto store = SqliteStore::open(path, registry, {}, limits);
    for (int number = 0; store; ++number) {
        (*store)->save({number % 50, 3}, numberedChunk(number), Provenance::Edited);
        (*store)->setMetadata("player_time", std::to_string(number));
        if (number % 100 == 99 && !(*store)->flush()) break;
        if (number == 199 && ::write(started, "x", 1) != 1) break;
    }
    ::_exit(1);
}

TEST_F(SaveCheckTest, WhileAnotherProgramSaves) {
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe(pipe.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) saveForEver(path_, registry_, pipe[1]);
    char started = 0;
    ASSERT_EQ(::read(pipe[0], &started, 1), 1);
    std::size_t edited = 0;
    for (int k = 0; k < 60; ++k) {
        const CheckReport report = check();
        EXPECT_FALSE(report.isDamaged()) << testing::PrintToString(report.fileProblems);
        EXPECT_EQ(report.inUse, fmt::format("open in another program (process {})", child));
        EXPECT_GE(report.editedChunks, edited);
        edited = report.editedChunks;
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    for (const int descriptor : pipe) ::close(descriptor);
    const CheckReport after = check();
    EXPECT_FALSE(after.isDamaged());
    EXPECT_EQ(after.inUse, "");
    EXPECT_EQ(after.chunks, 80u);
}

#endif

// A save left by a killed program: the log has one transaction per chunk.
class LogCheckTest : public SaveCheckTest {
  protected:
    static constexpr int kInLog = 20;

    void SetUp() override {
        SaveCheckTest::SetUp();
        const auto store = SqliteStore::open(path_, registry_, {}, kNever);
        ASSERT_TRUE(store);
        for (int x = 0; x < kInLog; ++x) {
            (*store)->save({100 + x, 0}, numberedChunk(x), Provenance::Edited);
            ASSERT_TRUE((*store)->flush());
        }
        save_ = readAll(path_);
        log_ = readAll(logPath());
        lock_ = readAll(path_.string() + "-lock");
    }
    std::filesystem::path logPath() const { return path_.string() + "-wal"; }
    CheckReport checkWith(const std::string& log) {
        std::filesystem::remove(path_.string() + "-shm");
        writeAll(path_, save_);
        writeAll(logPath(), log);
        return check();
    }

    std::string save_, log_, lock_;
};

TEST_F(LogCheckTest, AWholeLogIsGood) {
    EXPECT_FALSE(checkWith(log_).isDamaged());
    EXPECT_EQ(checkWith(log_).chunks, 30u + kInLog);
    EXPECT_EQ(checkWith(log_).fileBytes, save_.size() + log_.size());
    // An unfinished write was never reported as saved.
    EXPECT_FALSE(checkWith(log_ + std::string(5000, 'x')).isDamaged());
    EXPECT_FALSE(checkWith(log_.substr(0, log_.size() - 100)).isDamaged());
}

// If the check finds no error, no data is missing.
TEST_F(LogCheckTest, OneFlippedBitIsNoticed) {
    std::mt19937 random(5);
    int damaged = 0;
    for (int n = 0; n < 200; ++n) {
        std::string log = log_;
        const std::size_t at = n < 60 ? static_cast<std::size_t>(n) : random() % log.size();
        log[at] = static_cast<char>(log[at] ^ 1 << random() % 8);
        const CheckReport report = checkWith(log);
        damaged += report.isDamaged();
        if (!report.isDamaged()) {
            EXPECT_EQ(report.chunks, 30u + kInLog) << "bit in byte " << at;
        }
    }
    EXPECT_GT(damaged, 150);
}

TEST_F(LogCheckTest, AMissingLogIsNoticed) {
    ASSERT_EQ(lock_, fmt::format("{} log", ::getpid()));
    writeAll(path_.string() + "-lock", lock_);
    EXPECT_FALSE(checkWith(log_).isDamaged());
    EXPECT_FALSE(check().isDamaged());
    std::filesystem::remove(logPath());
    // A reader keeps the note for the next one.
    for (int time = 0; time < 2; ++time) {
        const CheckReport report = check();
        ASSERT_EQ(report.fileProblems.size(), 1u) << time;
        EXPECT_THAT(report.fileProblems.front(), HasSubstr("a.sqlite-wal: missing"));
    }
    std::filesystem::create_symlink(path_, folder_ / "link.sqlite");
    EXPECT_TRUE(checkSave(folder_ / "link.sqlite", registry_)->isDamaged()) << "by another name";
    // A program that writes says so, since afterwards nobody can know.
    testing::internal::CaptureStderr();
    EXPECT_TRUE(SqliteStore::open(path_, registry_, {}, kNever));
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("a.sqlite-wal: missing"));
    EXPECT_FALSE(check().isDamaged());
}

// A power failure can leave such a log, too.
TEST_F(LogCheckTest, ABrokenLastTransactionMayNeverHaveBeenSaved) {
    std::string log = log_;
    log[log.size() - 100] = static_cast<char>(log[log.size() - 100] ^ 1);
    const CheckReport report = checkWith(log);
    ASSERT_EQ(report.fileProblems.size(), 1u);
    EXPECT_THAT(report.fileProblems.front(),
                testing::ContainsRegex("a.sqlite-wal: broken behind frame [0-9]+: the last transaction is "
                                       "lost, unless it was never finished"));
}

// As does a power failure while the header is written.
TEST_F(LogCheckTest, ABrokenHeaderMayNeverHaveBeenSaved) {
    std::string log = log_;
    log[20] = static_cast<char>(log[20] ^ 1);
    const CheckReport report = checkWith(log);
    ASSERT_EQ(report.fileProblems.size(), 1u);
    EXPECT_THAT(report.fileProblems.front(),
                HasSubstr("a.sqlite-wal: its header is broken: all that it holds is "
                          "lost, unless it was never finished"));
}

// Writing fails at the end of a large transaction, then a smaller one overwrites it in the log.
TEST_F(LogCheckTest, WhatFailedToBeWrittenIsNotMissed) {
    FaultyDisk disk;
    std::mt19937 random(1);
    std::string log;
    {
        const auto store = SqliteStore::open(path_, registry_, {}, kNever);
        ASSERT_TRUE(store);
        (*store)->save({1, 0}, numberedChunk(1), Provenance::Edited);
        ASSERT_TRUE((*store)->flush());
        auto large = std::make_shared<world::Chunk>();
        large->setBlockEntityData(0, randomBytes(random, 200000));
        (*store)->save({0, 0}, large, Provenance::Edited);
        disk.fail(kDiskSync);
        ASSERT_FALSE((*store)->flush());
        disk.work();
        (*store)->save({0, 0}, numberedChunk(1), Provenance::Edited);
        ASSERT_TRUE((*store)->flush());
        save_ = readAll(path_);
        log = readAll(logPath());
    }
    EXPECT_FALSE(checkWith(log).isDamaged());
}

// A program that is killed before it writes, or after it closed the save, leaves its lock but no log.
TEST_F(LogCheckTest, ALogThatWasNotThereIsNotMissed) {
    std::string before;
    {
        const auto store = SqliteStore::open(path_, registry_, {}, kNever);
        ASSERT_TRUE(store);
        (*store)->setDerivedRows({[&](auto, const auto&) {
                                      before = readAll(path_.string() + "-lock");
                                      return std::vector<ChunkRow>();
                                  },
                                  {}});
        (*store)->save({0, 0}, numberedChunk(1), Provenance::Edited);
    }
    ASSERT_NE(before, "") << "a lock is held";
    writeAll(path_.string() + "-lock", before);
    EXPECT_FALSE(check().isDamaged());
}

TEST_F(LogCheckTest, TellsHowMuchIsLost) {
    // Frames of a header of 24 bytes and a page follow the log's header of 32; a commit has its size in
    // pages.
    const auto wordAt = [&](std::size_t at) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 4; ++k) word = word << 8 | static_cast<std::uint8_t>(log_[at + k]);
        return word;
    };
    const std::size_t frameBytes = 24 + wordAt(8), whole = (log_.size() - 32) / frameBytes / 2;
    int lost = 0;
    for (std::size_t at = 32 + whole * frameBytes; at < log_.size(); at += frameBytes)
        lost += wordAt(at + 4) != 0 ? 1 : 0;
    ASSERT_GT(whole, 5u);
    ASSERT_GT(lost, 5);
    std::string log = log_;
    log[32 + whole * frameBytes + 100] ^= 1;
    const CheckReport report = checkWith(log);
    ASSERT_EQ(report.fileProblems.size(), 1u);
    EXPECT_THAT(report.fileProblems.front(),
                testing::EndsWith(fmt::format(
                    "a.sqlite-wal: broken behind frame {}: {} transactions are lost", whole, lost)));
}

TEST_F(SaveCheckTest, NamesEveryDamagedChunk) {
    runSql(path_, fmt::format("UPDATE chunks SET data = x'00' WHERE key = {}", keyOf({4, -4})));
    runSql(path_, fmt::format("UPDATE chunks SET data = zeroblob(100) WHERE key = {}", keyOf({9, -9})));
    runSql(path_, "INSERT INTO chunks VALUES (-3, 0, x'00')");
    const CheckReport report = check();
    EXPECT_TRUE(report.isDamaged());
    ASSERT_EQ(report.damaged.size(), 3u);
    EXPECT_THAT(report.damaged[0].problem, HasSubstr("key -3"));
    EXPECT_EQ(report.damaged[1].pos, (world::ChunkPos{4, -4}));
    EXPECT_THAT(report.damaged[1].problem, HasSubstr("too few"));
    EXPECT_EQ(report.damaged[2].pos, (world::ChunkPos{9, -9}));
    EXPECT_THAT(report.damaged[2].problem, HasSubstr("checksum"));
    EXPECT_TRUE(report.fileProblems.empty());
}

TEST_F(SaveCheckTest, ListsAThousandDamagedChunksAndCountsTheRest) {
    runSql(path_,
           "WITH RECURSIVE numbers(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM numbers WHERE n < 1003) "
           "INSERT INTO chunks SELECT -n, 0, x'00' FROM numbers");
    const CheckReport report = check();
    EXPECT_EQ(report.damaged.size(), 1000u);
    EXPECT_EQ(report.unlisted, 3u);
}

TEST_F(SaveCheckTest, LooksAtAllLevels) {
    {
        const auto store = SqliteStore::open(path_, registry_, {});
        ASSERT_TRUE(store);
        (*store)->save({3, 4, 5}, numberedChunk(1), Provenance::Edited);
    }
    EXPECT_EQ(check().chunks, 31u);
    EXPECT_FALSE(check().isDamaged());
    runSql(path_, fmt::format("UPDATE chunks SET data = x'00' WHERE key = {}", keyOf({3, 4, 5})));
    ASSERT_EQ(check().damaged.size(), 1u);
    EXPECT_EQ(check().damaged[0].pos, (world::ChunkPos{3, 4, 5}));
}

TEST_F(SaveCheckTest, UnknownBlocksAreNoDamage) {
    const auto report = checkSave(path_, registryOf({"stone", "dirt"}));
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->isDamaged());
    EXPECT_EQ(report->unknownBlocks, (std::vector<std::string>{"grass", "sand", "water"}));
}

TEST_F(SaveCheckTest, BrokenPagesAndCutFiles) {
    std::string bytes = readAll(path_);
    const std::string whole = bytes;
    for (std::size_t i = bytes.size() - 4096; i < bytes.size() - 4000; ++i) bytes[i] = '\x55';
    writeAll(path_, bytes);
    EXPECT_FALSE(check().fileProblems.empty());
    writeAll(path_, std::string_view(whole).substr(0, whole.size() - 4096));
    ASSERT_EQ(check().fileProblems.size(), 1u);
    EXPECT_THAT(check().fileProblems[0], HasSubstr("cut off"));
}

TEST_F(SaveCheckTest, WhatIsNoSaveIsAnError) {
    EXPECT_FALSE(checkSave(folder_ / "nothing", registry_));
    writeAll(path_, "a text");
    EXPECT_FALSE(checkSave(path_, registry_));
}

}  // namespace
}  // namespace terrane::store
