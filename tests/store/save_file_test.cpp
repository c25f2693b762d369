// Invalid files: each is refused with one line that names it, and is not changed.
#include "terrane/store/saves/save_file.h"

#include <gmock/gmock.h>
#ifndef _WIN32
#include <sys/wait.h>
#endif

#include <fstream>
#include <optional>

#include "terrane/store/saves/file_lock.h"
#include "terrane/store/saves/open_world.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const SaveAccess kCreate{.create = kIdentity, .decide = {}};
const SaveAccess kMustBeThere{};

auto recreateBy(int version, Regenerate chunks = Regenerate::All) {
    return [=](const WorldIdentity&) { return base::Result<Regeneration>({chunks, version}); };
}

class SaveFileTest : public testing::Test {
  protected:
    void makeSave() {
        const auto store = SqliteStore::open(path_, registry_, kCreate);
        ASSERT_TRUE(store) << store.error().message;
        for (int x = 0; x < 20; ++x) (*store)->save({x, 0}, numberedChunk(x), Provenance::Edited);
    }

    std::int64_t pageCount() const { return queryFile(path_, "PRAGMA page_count"); }

    std::string errorOfWriting(const SaveAccess& access = kCreate) {
        const auto file = openToWrite(path_, registry_, access);
        return file ? "" : file.error().message;
    }
    std::string errorOfReading() {
        const auto file = openToRead(path_, registry_);
        return file ? "" : file.error().message;
    }
    // Refused for reading and writing, with the file unchanged.
    void expectRefused(const std::string& reason) {
        const std::string before = readAll(path_);
        for (const std::string& message :
             {errorOfWriting(), errorOfWriting(kMustBeThere), errorOfReading()}) {
            EXPECT_THAT(message, HasSubstr(path_.string() + ": "));
            EXPECT_THAT(message, HasSubstr(reason));
            EXPECT_EQ(message.find('\n'), std::string::npos);
        }
        EXPECT_TRUE(readAll(path_) == before);
    }

    base::TempFolder folder_;
    fs::path path_ = folder_ / "a.sqlite";
    world::BlockRegistry registry_ = testRegistry();
};

// Files beside a save are untrusted: other files are not touched.
TEST_F(SaveFileTest, LinksBesideItAreNotFollowed) {
    makeSave();
    const fs::path precious = folder_ / "precious.txt";
    writeAll(precious, "precious");
    for (const std::string ending : {"-lock", "-wal", "-shm", "-journal"}) {
        const fs::path beside = path_.string() + ending;
        for (const bool isSymbolic : {true, false}) {
            if (isSymbolic) {
                fs::create_symlink(precious, beside);
            } else {
                fs::create_hard_link(precious, beside);
            }
            for (const std::string& message : {errorOfWriting(), errorOfReading()}) {
                EXPECT_THAT(message, HasSubstr(beside.string() + ": ")) << ending;
                EXPECT_THAT(message, HasSubstr("link")) << ending;
            }
            EXPECT_EQ(readAll(precious), "precious") << ending;
            fs::remove(beside);
        }
    }
    EXPECT_EQ(errorOfReading(), "");
}

TEST_F(SaveFileTest, ALockThatIsALinkIsNotWritten) {
    const fs::path precious = folder_ / "precious.txt";
    writeAll(precious, "precious");
    fs::create_symlink(precious, path_.string() + "-lock");
    EXPECT_FALSE(FileLock::acquire(path_, FileLock::Kind::Exclusive));
    fs::remove(path_.string() + "-lock");
    fs::create_hard_link(precious, path_.string() + "-lock");
    EXPECT_FALSE(FileLock::acquire(path_, FileLock::Kind::Shared));
    EXPECT_EQ(readAll(precious), "precious");
}

// A rollback journal without pages for a file of `pages` pages, of a transaction over several files that are
// listed in `other`.
std::string journalNaming(const std::string& other, std::int64_t pages) {
    const std::string magic = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
    const auto number = [](std::uint32_t value) {
        std::string bytes;
        for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
        return bytes;
    };
    std::uint32_t sum = 0;
    for (const char c : other) sum += static_cast<std::uint32_t>(c);
    std::string header = magic + number(0) + number(1) + number(static_cast<std::uint32_t>(pages)) +
                         number(512) + number(4096);
    header.resize(512, '\0');
    return header + number((1u << 30) / 4096 + 1) + other + number(static_cast<std::uint32_t>(other.size())) +
           number(sum) + magic;
}

TEST_F(SaveFileTest, AJournalDeletesNoOtherFile) {
    makeSave();
    const fs::path precious = folder_ / "precious.txt";
    writeAll(precious, "precious");
    writeAll(path_.string() + "-journal", journalNaming(precious.string(), pageCount()));
    EXPECT_THAT(errorOfReading(), HasSubstr("a.sqlite-journal: names another file"));
    EXPECT_THAT(errorOfWriting(), HasSubstr("a.sqlite-journal: names another file"));
    EXPECT_EQ(readAll(precious), "precious");
}

TEST_F(SaveFileTest, ReadingUndoesNothing) {
    makeSave();
    std::string journal = journalNaming("", pageCount());
    journal.resize(512);
    writeAll(path_.string() + "-journal", journal);
    const std::string before = readAll(path_);
    EXPECT_THAT(errorOfReading(), HasSubstr("interrupted"));
    EXPECT_EQ(readAll(path_), before);
    EXPECT_EQ(readAll(path_.string() + "-journal"), journal);
    EXPECT_EQ(errorOfWriting(kMustBeThere), "");
    EXPECT_EQ(errorOfReading(), "");
}

// SQLite neither plays it back nor removes it: otherwise reading would be refused forever.
TEST_F(SaveFileTest, AJournalThatUndoesNothingIsPassedOver) {
    makeSave();
    writeAll(path_.string() + "-journal", std::string(600, '\0'));
    EXPECT_EQ(errorOfReading(), "");
    EXPECT_EQ(errorOfWriting(kMustBeThere), "");
    EXPECT_EQ(errorOfReading(), "");
}

TEST_F(SaveFileTest, ADoubledSlashIsOne) {
    makeSave();
    EXPECT_TRUE(openToWrite("/" + path_.string(), registry_, kMustBeThere));
    EXPECT_TRUE(openToRead("/" + path_.string(), registry_));
    EXPECT_TRUE(Database::open("/" + path_.string(), OpenMode::ReadOnly));
}

// Different paths lead to the same save.
TEST_F(SaveFileTest, ALinkLeadsToTheSameLockAndLog) {
    const fs::path link = folder_ / "link.sqlite";
    fs::create_symlink(path_, link);
    auto store = SqliteStore::open(path_, registry_, kCreate, kNever);
    ASSERT_TRUE(store);
    (*store)->save({0, 0}, numberedChunk(1), Provenance::Edited);
    ASSERT_TRUE((*store)->flush());
    EXPECT_THAT(openToWrite(link, registry_, kMustBeThere).error().message,
                HasSubstr("open in another program"));
    EXPECT_THAT(openToRead(link, registry_)->inUse, HasSubstr("open in another program"));
    (*store).reset();
    EXPECT_TRUE(openToRead(link, registry_));
    fs::create_hard_link(path_, folder_ / "other.sqlite");
    expectRefused("has 2 names (hard links)");
}

TEST_F(SaveFileTest, NotThere) {
    EXPECT_THAT(errorOfReading(), HasSubstr("there is no such file"));
    EXPECT_THAT(errorOfWriting(kMustBeThere), HasSubstr("there is no such file"));
    EXPECT_EQ(folder_.fileCount(), 0) << "asking makes nothing";
    EXPECT_EQ(errorOfWriting(), "");
    EXPECT_EQ(errorOfReading(), "");
}

TEST_F(SaveFileTest, FoldersAreMade) {
    path_ = folder_ / "x/y/a.sqlite";
    EXPECT_EQ(errorOfWriting(), "");
    EXPECT_TRUE(fs::exists(path_));
}

TEST_F(SaveFileTest, OddNames) {
    for (const char* name : {"a?b=c.sqlite", "100%25.sqlite", "a#b.sqlite", "ž š.sqlite"}) {
        path_ = folder_ / name;
        EXPECT_EQ(errorOfWriting(), "");
        EXPECT_TRUE(fs::exists(path_)) << name;
        EXPECT_EQ(errorOfReading(), "");
    }
}

TEST_F(SaveFileTest, AFolder) {
    fs::create_directory(path_);
    EXPECT_THAT(errorOfReading(), HasSubstr("not a file"));
    EXPECT_THAT(errorOfWriting(), HasSubstr("not a file"));
}

// Power failure while the file was created: its first page is missing, its journal exists.
TEST_F(SaveFileTest, AMakingThatWasCutShortIsUndone) {
    std::string journal = journalNaming("", 0);
    journal.resize(512);
    writeAll(path_.string() + "-journal", journal);
    writeAll(path_, std::string(8192, '\0'));
    EXPECT_THAT(errorOfReading(), HasSubstr("interrupted"));
    EXPECT_EQ(errorOfWriting(), "");
    EXPECT_EQ(errorOfReading(), "");
}

// Left by a program that is killed while it creates the file.
TEST_F(SaveFileTest, EmptyFilesAreNewOnes) {
    writeAll(path_, "");
    EXPECT_THAT(errorOfReading(), HasSubstr("empty"));
    EXPECT_THAT(errorOfWriting(kMustBeThere), HasSubstr("empty"));
    EXPECT_EQ(errorOfWriting(), "");
    EXPECT_EQ(errorOfReading(), "");
    fs::remove(path_);
    runSql(path_, "PRAGMA user_version = 0; VACUUM");
    EXPECT_THAT(errorOfReading(), HasSubstr("empty"));
    EXPECT_EQ(errorOfWriting(), "");
}

TEST_F(SaveFileTest, NoSqliteFile) {
    writeAll(path_, "a text, and long enough to be more than the sixteen bytes that are looked at first");
    expectRefused("not a SQLite file");
    writeAll(path_, "short");
    expectRefused("not a SQLite file");
}

TEST_F(SaveFileTest, SqliteFileOfAnotherProgram) {
    runSql(path_, "CREATE TABLE other (a); INSERT INTO other VALUES (1)");
    expectRefused("SQLite file of another program");
}

TEST_F(SaveFileTest, NewerFormat) {
    makeSave();
    runSql(path_, "PRAGMA user_version = 99");
    expectRefused("in format 99, this program reads up to format 4");
}

TEST_F(SaveFileTest, CutOff) {
    makeSave();
    const std::string whole = readAll(path_);
    for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{5000}}) {
        writeAll(path_, std::string_view(whole).substr(0, size));
        expectRefused("damaged: cut off");
    }
    writeAll(path_, std::string_view(whole).substr(0, 60));
    EXPECT_NE(errorOfReading(), "");
    EXPECT_NE(errorOfWriting(), "");
}

TEST_F(SaveFileTest, BrokenTables) {
    makeSave();
    const std::string whole = readAll(path_);
    const auto with = [&](const std::string& sql) {
        writeAll(path_, whole);
        runSql(path_, sql);
    };
    with("DELETE FROM settings WHERE name = 'seed'");
    expectRefused("the setting seed is missing");
    with("UPDATE settings SET value = 'x' WHERE name = 'seed'");
    expectRefused("the setting seed is \"x\"");
    with("DELETE FROM settings WHERE name = 'generator'");
    expectRefused("the setting generator is missing");
    with("INSERT INTO blocks VALUES (70000, 'far')");
    expectRefused("the block far has the id 70000");
    with("DROP TABLE blocks");
    expectRefused("blocks");
}

// Random bytes in the pages: any result is fine, but no crash.
TEST_F(SaveFileTest, BrokenPages) {
    makeSave();
    const std::string whole = readAll(path_);
    std::mt19937 random(1);
    for (int round = 0; round < 60; ++round) {
        std::string broken = whole;
        for (int i = 0; i < 30; ++i)
            broken[100 + random() % (broken.size() - 100)] = static_cast<char>(random());
        writeAll(path_, broken);
        (void)errorOfReading();
        auto store = SqliteStore::open(path_, registry_, kMustBeThere);
        for (int x = 0; store && x < 20; ++x) (void)(*store)->load({x, 0});
    }
}

TEST_F(SaveFileTest, OneProgramAtATime) {
    makeSave();
    const auto first = openToWrite(path_, registry_, kCreate);
    ASSERT_TRUE(first);
    EXPECT_THAT(errorOfWriting(), HasSubstr(fmt::format("open in another program (process {})", ::getpid())));
}

TEST_F(SaveFileTest, ReadingWhatAnotherProgramWrites) {
    makeSave();
    EXPECT_EQ(openToRead(path_, registry_)->inUse, "");
    auto writer = SqliteStore::open(path_, registry_, kMustBeThere, kNever);
    ASSERT_TRUE(writer);
    const auto beforeFirst = SqliteReader::open(path_, registry_);
    ASSERT_TRUE(beforeFirst) << beforeFirst.error().message;
    const auto save = [&](int number) {
        (*writer)->save({3, 0}, numberedChunk(number), Provenance::Edited);
        ASSERT_TRUE((*writer)->flush());
    };
    save(100);
    const auto file = openToRead(path_, registry_);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->inUse, fmt::format("open in another program (process {})", ::getpid()));
    const std::string saved = readAll(path_), log = readAll(path_.string() + "-wal");
    EXPECT_EQ(*(*beforeFirst)->load({3, 0}).chunk, *numberedChunk(100));
    EXPECT_EQ(*(*SqliteReader::open(path_, registry_))->load({3, 0}).chunk, *numberedChunk(100))
        << "what is in the log alone";
    EXPECT_TRUE(readAll(path_) == saved && readAll(path_.string() + "-wal") == log);
    save(101);
    EXPECT_EQ(*(*beforeFirst)->load({3, 0}).chunk, *numberedChunk(101));
    (*writer).reset();  // the log stays while a reader is open
    EXPECT_EQ(*(*beforeFirst)->load({3, 0}).chunk, *numberedChunk(101));
    EXPECT_EQ(errorOfWriting(kMustBeThere), "");
    EXPECT_EQ(*(*beforeFirst)->load({3, 0}).chunk, *numberedChunk(101));
}

// Before the file is in WAL mode, only waiting helps.
TEST_F(SaveFileTest, ASaveThatIsBeingMadeIsBusy) {
    makeSave();
    const auto writer = FileLock::acquire(path_, FileLock::Kind::Exclusive);
    ASSERT_TRUE(writer);
    std::string journal = journalNaming("", pageCount());
    journal.resize(512);
    writeAll(path_.string() + "-journal", journal);
    const auto file = openToRead(path_, registry_);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code, base::ErrorCode::Busy);
    EXPECT_THAT(file.error().message, HasSubstr("open in another program"));
}

TEST_F(SaveFileTest, ReadersShare) {
    makeSave();
    const auto first = openToRead(path_, registry_);
    ASSERT_TRUE(first);
    EXPECT_EQ(errorOfReading(), "");
    EXPECT_THAT(errorOfWriting(), HasSubstr("open in another program"));
}

#ifndef _WIN32  // no fork(): store.kill_test does the same with programs

// The lock ends with the process; its writes stay.
TEST_F(SaveFileTest, TheNextProgramAfterAKilledOne) {
    const pid_t child = ::fork();
    if (child == 0) {
        auto store = SqliteStore::open(path_, registry_, kCreate);
        if (store) (*store)->save({4, 4}, numberedChunk(77), Provenance::Edited);
        const bool good = store && (*store)->flush();
        ::_exit(good ? 0 : 1);  // as if killed: nothing is closed
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_EQ(status, 0);
    EXPECT_TRUE(fs::exists(path_.string() + "-lock"));
    EXPECT_EQ(errorOfReading(), "") << "with the log that the other left";
    auto store = SqliteStore::open(path_, registry_, kMustBeThere);
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_EQ(*(*store)->load({4, 4}).chunk, *numberedChunk(77));
}

#endif

TEST_F(SaveFileTest, RecreateKeepsACopy) {
    makeSave();
    {
        auto store = SqliteStore::open(path_, registry_, {.create = kIdentity, .decide = recreateBy(9)});
        ASSERT_TRUE(store) << store.error().message;
        EXPECT_EQ((*store)->load({3, 0}).state, LoadedChunk::State::Absent);
        EXPECT_EQ((*store)->identity().seed, kIdentity.seed);
        EXPECT_EQ((*store)->identity().generatorVersion, 9);
        (*store)->save({3, 0}, numberedChunk(1000), Provenance::Edited);
    }
    path_ = folder_ / "a.backup-1.sqlite";
    auto copy = SqliteStore::open(path_, registry_, kMustBeThere);
    ASSERT_TRUE(copy) << copy.error().message;
    EXPECT_EQ(*(*copy)->load({3, 0}).chunk, *numberedChunk(3));
    EXPECT_EQ((*copy)->identity(), kIdentity);
    ASSERT_TRUE(SqliteStore::open(folder_ / "a.sqlite", registry_, {.create = {}, .decide = recreateBy(9)}));
    EXPECT_TRUE(fs::exists(folder_ / "a.backup-2.sqlite")) << "a copy never replaces another";
}

TEST_F(SaveFileTest, ChunksWithEditsStayWhereTheOthersAreMadeAnew) {
    makeSave();
    {
        auto store = SqliteStore::open(path_, registry_, kMustBeThere);
        ASSERT_TRUE(store) << store.error().message;
        for (int x = 0; x < 20; x += 2) (*store)->save({x, 1}, numberedChunk(x), Provenance::Generated);
    }
    auto store = SqliteStore::open(path_, registry_,
                                   {.create = {}, .decide = recreateBy(9, Regenerate::AllButEdited)});
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_EQ((*store)->identity().generatorVersion, 9);
    for (int x = 0; x < 20; ++x) {
        EXPECT_EQ(*(*store)->load({x, 0}).chunk, *numberedChunk(x));
        EXPECT_EQ((*store)->load({x, 1}).state, LoadedChunk::State::Absent);
    }
    path_ = folder_ / "a.backup-1.sqlite";
    auto copy = SqliteStore::open(path_, registry_, kMustBeThere);
    ASSERT_TRUE(copy) << copy.error().message;
    EXPECT_EQ(*(*copy)->load({2, 1}).chunk, *numberedChunk(2)) << "the old world";
    EXPECT_EQ((*copy)->identity(), kIdentity);
}

TEST_F(SaveFileTest, ARefusedSaveIsLeftAsItIs) {
    makeSave();
    const std::string before = readAll(path_);
    SaveAccess access = kCreate;
    access.decide = [](const WorldIdentity& saved) -> base::Result<Regeneration> {
        EXPECT_EQ(saved, kIdentity);
        return base::fail("not this one");
    };
    EXPECT_EQ(errorOfWriting(access), "not this one");
    EXPECT_TRUE(readAll(path_) == before);
    EXPECT_FALSE(fs::exists(folder_ / "a.backup-1.sqlite"));
}

class ReadOnlyTest : public SaveFileTest {
  protected:
    void TearDown() override { fs::permissions(folder_.path(), fs::perms::owner_all); }
    void makeReadOnly() { fs::permissions(folder_.path(), fs::perms(0555)); }

    auto openInMemory(bool regenerate = false) {
        WorldRequest request;
        request.access = WorldAccess::ReadOnly;
        if (regenerate) request.world.regenerate = Regenerate::All;
        request.versionOf = [=](std::string_view) { return regenerate ? 4 : kIdentity.generatorVersion; };
        return openWorld({WorldLocation::Kind::File, path_}, registry_, request);
    }
};

// A read-only folder: changes stay in memory, and the file is unchanged.
TEST_F(ReadOnlyTest, SaveInAReadOnlyFolder) {
    makeSave();
    fs::permissions(path_, fs::perms(0444));
    makeReadOnly();
    const std::string before = readAll(path_);
    const Unprivileged user;
    EXPECT_THAT(errorOfWriting(), HasSubstr("cannot be written"));
    auto store = openInMemory();
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_FALSE((*store)->isPersistent());
    EXPECT_EQ((*store)->identity(), kIdentity);
    EXPECT_EQ(*(*store)->load({3, 0}).chunk, *numberedChunk(3));
    EXPECT_TRUE((*store)->contains({3, 0}));
    EXPECT_FALSE((*store)->contains({3, 1}));
    (*store)->save({3, 0}, numberedChunk(500), Provenance::Edited);
    EXPECT_EQ(*(*store)->load({3, 0}).chunk, *numberedChunk(500));
    ASSERT_TRUE((*store)->flush());
    EXPECT_TRUE(readAll(path_) == before);
    EXPECT_EQ(folder_.fileCount(), 1);
}

TEST_F(ReadOnlyTest, NewWorldInAReadOnlyFolder) {
    makeReadOnly();
    const Unprivileged user;
    EXPECT_THAT(errorOfWriting({.create = kIdentity, .decide = {}}), HasSubstr("cannot be written"));
    EXPECT_EQ(folder_.fileCount(), 0);
}

TEST_F(ReadOnlyTest, RecreateInAReadOnlyFolder) {
    makeSave();
    makeReadOnly();
    const Unprivileged user;
    auto store = openInMemory(true);
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_EQ((*store)->load({3, 0}).state, LoadedChunk::State::Absent);
    EXPECT_EQ((*store)->identity().seed, kIdentity.seed);
    EXPECT_EQ((*store)->identity().generatorVersion, 4);
}

// Without write permission, a save that is being written is not opened as immutable.
TEST_F(ReadOnlyTest, SeesWhoWrites) {
    const auto writer = openToWrite(path_, registry_, kCreate);
    ASSERT_TRUE(writer) << writer.error().message;
    makeReadOnly();
    const Unprivileged user;
    const auto reader = openToRead(path_, registry_);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_THAT(reader->inUse, HasSubstr("open in another program"));
    EXPECT_EQ(reader->readers, OpenMode::ReadOnly);
}

// A killed program left the lock file.
TEST_F(ReadOnlyTest, KeepsOutWhoWouldWrite) {
    makeSave();
    std::ofstream(path_.string() + "-lock") << "12";
    makeReadOnly();
    std::optional<SaveFile> reader;
    {
        const Unprivileged user;
        auto file = openToRead(path_, registry_);
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_EQ(file->inUse, "");
        reader = std::move(*file);
    }
    EXPECT_THAT(errorOfWriting(), HasSubstr("open in another program"));
    reader.reset();
    EXPECT_EQ(errorOfWriting(), "");
}

TEST_F(ReadOnlyTest, OneReadOnlyFile) {
    makeSave();
    fs::permissions(path_, fs::perms(0444));
    fs::permissions(folder_.path(), fs::perms::all);
    const Unprivileged user;
    auto store = openInMemory();
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_FALSE((*store)->isPersistent());
    EXPECT_EQ(*(*store)->load({3, 0}).chunk, *numberedChunk(3));
}

}  // namespace
}  // namespace terrane::store
