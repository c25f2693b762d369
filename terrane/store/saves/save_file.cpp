#include "terrane/store/saves/save_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <system_error>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/store/chunk_store.h"
#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/derived_rows.h"
#include "terrane/store/saves/file_lock.h"
#include "terrane/store/sqlite/metadata_table.h"
#include "terrane/store/sqlite/schema.h"

namespace terrane::store {

namespace {

using base::ErrorCode;
namespace fs = std::filesystem;

bool hasContent(const fs::path& path) {
    std::error_code ignored;  // an inaccessible file counts as missing
    const auto size = fs::file_size(path, ignored);
    return !ignored && size > 0;
}

base::Result<void> checkOrdinary(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(path, error);
    if (!fs::exists(status)) return {};
    if (fs::is_regular_file(status) && fs::hard_link_count(path, error) == 1) return {};
    return base::fail(ErrorCode::Incompatible, "{}: a link, or not a regular file; it is not opened",
                      path.string());
}

// A journal of several files ends with the name of a file that lists all (SQLite's file format, section 3:
// "The Super-Journal File"), a checksum, and these bytes. A save is a single file.
bool namesAnother(const fs::path& journal) {
    constexpr std::array<unsigned char, 8> kMagic = {0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7};
    std::ifstream file(journal, std::ios::binary);
    std::array<char, kMagic.size()> end{};
    file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
    return file.read(end.data(), end.size()) && std::memcmp(end.data(), kMagic.data(), end.size()) == 0;
}

}  // namespace

bool isPresent(const fs::path& path) {
    std::error_code ignored;  // an inaccessible file counts as missing
    return fs::exists(fs::symlink_status(path, ignored));
}

fs::path companionPath(const fs::path& save, const char* ending) {
    fs::path path = save;
    path += ending;
    return path;
}

base::Result<fs::path> resolvedPath(const fs::path& path) {
    std::error_code error;
    const fs::path own = fs::weakly_canonical(path, error);
    if (error) return base::fail(ErrorCode::Io, "{}: cannot be found: {}", path.string(), error.message());
    const auto names = fs::hard_link_count(own, error);
    if (!error && fs::is_regular_file(own, error) && names > 1)
        return base::fail(ErrorCode::Incompatible,
                          "{}: has {} names (hard links), and each would have a lock and a log of its own",
                          path.string(), names);
    return own;
}

bool hasLog(const fs::path& path) {
    return hasContent(companionPath(path, "-wal"));
}

bool hasJournal(const fs::path& path) {
    // SQLite ignores a journal that begins with 0 and leaves it there.
    return std::ifstream(companionPath(path, "-journal"), std::ios::binary).get() > 0;
}

std::string lostLog(const fs::path& path) {
    std::error_code ignored;
    if (fs::exists(companionPath(path, "-wal"), ignored)) return {};
    std::ifstream lock(companionPath(path, "-lock"));
    std::string number, word;
    lock >> std::setw(16) >> number >> std::setw(16) >> word;
    if (!lock || word != kLogWord) return {};
    return fmt::format(
        "{}-wal: missing, although a program that wrote to it was killed: the last saved changes "
        "are lost",
        path.string());
}

base::Result<void> checkCompanions(const fs::path& path) {
    for (const char* ending : {"-wal", "-shm", "-journal", "-lock"})
        TERRANE_TRY(checkOrdinary(companionPath(path, ending)));
    const fs::path journal = companionPath(path, "-journal");
    if (!namesAnother(journal)) return {};
    return base::fail(ErrorCode::Damaged, "{}: names another file, which would be deleted", journal.string());
}

namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagic = "SQLite format 3\0"sv;  // the first bytes of a SQLite file

bool targetExists(const fs::path& path) {
    std::error_code ignored;  // an inaccessible file counts as missing
    return fs::exists(path, ignored);
}

std::uint32_t bigEndian(const unsigned char* bytes, int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) value = value << 8 | bytes[i];
    return value;
}

// SQLite notices a truncated file only when it reads there. (File format, section 1.3: page size at offset
// 16, number of pages at 28.)
base::Result<void> checkLength(const fs::path& path, std::uintmax_t sizeBytes) {
    unsigned char header[100] = {};
    std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(header), sizeof header);
    const std::uint32_t pageBytes = bigEndian(header + 16, 2) == 1 ? 65536 : bigEndian(header + 16, 2);
    const std::uintmax_t expected = std::uintmax_t{pageBytes} * bigEndian(header + 28, 4);
    if (sizeBytes >= expected || hasLog(path)) return {};
    return base::fail(ErrorCode::Damaged, "{}: damaged: cut off after {} of {} bytes", path.string(),
                      sizeBytes, expected);
}

// True if there is a non-empty file that may be a save.
base::Result<bool> checkFile(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) return false;
    if (!fs::is_regular_file(status))
        return base::fail(ErrorCode::Incompatible, "{}: not a file", path.string());
    const std::uintmax_t size = fs::file_size(path, error);
    if (error) return base::fail(ErrorCode::Io, "{}: cannot be read: {}", path.string(), error.message());
    if (size == 0) return false;
    if (hasJournal(path)) return true;  // SQLite undoes the interrupted change first: skip the checks below
    std::ifstream file(path, std::ios::binary);
    if (!file)
        return base::fail(ErrorCode::Io, "{}: cannot be read: {}", path.string(), base::systemReason(errno));
    char magic[kMagic.size()] = {};
    file.read(magic, sizeof magic);
    if (std::string_view(magic, sizeof magic) != kMagic)
        return base::fail(ErrorCode::Incompatible, "{}: not a save: not a SQLite file", path.string());
    TERRANE_TRY(checkLength(path, size));
    return true;
}

tl::unexpected<base::Error> notASave(const fs::path& path) {
    if (targetExists(path))
        return base::fail(ErrorCode::Incompatible, "{}: empty, not a save", path.string());
    return base::fail(ErrorCode::NotFound, "{}: there is no such file", path.string());
}

// "a.sqlite" gives "a.backup-1.sqlite", or the next unused number.
fs::path backupPath(const fs::path& path, const std::string& word) {
    for (int number = 1;; ++number) {
        fs::path backup = path.parent_path() / fmt::format("{}.{}-{}{}", path.stem().string(), word, number,
                                                           path.extension().string());
        if (!targetExists(backup)) return backup;
    }
}

base::Result<void> addNames(Database& database, const std::vector<SavedName>& names) {
    if (names.empty()) return {};
    auto transaction = TERRANE_TRY(Transaction::begin(database));
    auto metadata = TERRANE_TRY(MetadataTable::make(database));
    for (const SavedName& name : names) TERRANE_TRY(metadata.add(name));
    return transaction.commit();
}

base::Result<void> makeCurrent(SaveFile& file, const fs::path& path, const SaveAccess& access) {
    auto kind = TERRANE_TRY(classify(file.database));
    if (kind == SaveKind::Empty) {
        if (!access.create) return notASave(path);
        file.isNew = true;
        TERRANE_TRY(createTables(file.database, *access.create));
        return addNames(file.database, access.blockNames);
    }
    TERRANE_TRY(checkSchema(file.database));
    if (kind == SaveKind::Old) {
        const fs::path backup = backupPath(path, "before-migration");
        TERRANE_TRY(migrate(file.database, migrations(), kFormatVersion, backup));
        base::logInfo("{}: migrated to format {}; the old file is {}", path.string(), kFormatVersion,
                      backup.string());
    }
    return {};
}

// Deletes the chunks to be regenerated and the mark of tiles.
base::Result<void> deleteRegenerated(Database& database, const Regeneration& by) {
    // Tiles also depend on generated chunks, even if marked as edited. WHERE deletes row by row: otherwise
    // SQLite frees whole trees recursively, however deep a damaged file makes them.
    const std::string sql = by.chunks == Regenerate::All
                                ? "DELETE FROM chunks WHERE true; DELETE FROM quarantine WHERE true;"
                                : fmt::format("DELETE FROM chunks WHERE origin = {} OR key >= {};",
                                              static_cast<int>(Provenance::Generated), kFirstTileKey);
    TERRANE_TRY(database.execute(sql));
    auto metadata = TERRANE_TRY(MetadataTable::make(database));
    TERRANE_TRY(metadata.remove(kDerivedRowsMark));
    return metadata.put("generator_version", std::to_string(by.generatorVersion));
}

// Makes the backup copy, if requested, before deleting anything.
base::Result<void> regenerate(SaveFile& file, const fs::path& path, const Regeneration& by) {
    const fs::path backup = by.keepsBackup ? backupPath(path, "backup") : fs::path();
    if (by.keepsBackup) TERRANE_TRY(file.database.backUpTo(backup));
    auto transaction = TERRANE_TRY(Transaction::begin(file.database));
    TERRANE_TRY(deleteRegenerated(file.database, by));
    TERRANE_TRY(transaction.commit());
    base::logInfo("{}: regenerated{}{}{}", path.string(),
                  by.chunks == Regenerate::All ? "" : " except for chunks with edits",
                  by.keepsBackup ? "; the old world is " : "", backup.string());
    return {};
}

// Reads format, settings and block names, and verifies their checksum.
base::Result<std::vector<SavedName>> readNamed(SaveFile& file) {
    const std::string& path = file.database.path();
    const auto version = TERRANE_TRY(file.database.queryNumber("PRAGMA user_version"));
    file.format = version.value_or(0);
    if (file.format < kOldestReadable)
        return base::fail(ErrorCode::Incompatible, "{}: unknown format {}", path, file.format);
    auto metadata = TERRANE_TRY(readMetadata(file.database));
    auto names = TERRANE_TRY(readBlockNames(file.database));
    auto identity = TERRANE_TRY(identityFrom(metadata, path));
    TERRANE_TRY(
        requireFormat(std::max(file.format, kFormatVersion), formatFor(identity.heights), identity, path));
    if (file.format >= kFirstWithChecksums) TERRANE_TRY(verifyMetadata(metadata, names, path));
    file.metadata = std::move(metadata);
    file.identity = std::move(identity);
    return names;
}

base::Result<void> regenerateIfAsked(SaveFile& file, const fs::path& path, const SaveAccess& access) {
    if (file.isNew || !access.decide) return {};
    const auto by = TERRANE_TRY(access.decide(file.identity));
    return by.chunks == Regenerate::None ? base::Result<void>() : regenerate(file, path, by);
}

base::Result<void> readContents(SaveFile& file, const world::BlockRegistry& registry) {
    const auto names = TERRANE_TRY(readNamed(file));
    auto ids = BlockIdMap::make(registry, names);
    if (!ids) return base::fail(ids.error().code, "{}: {}", file.database.path(), ids.error().message);
    file.ids = std::move(*ids);
    file.metadata.erase(std::string(kChecksum));
    return {};
}

// Fills in the checksum if another program cleared it.
base::Result<void> addMissingChecksum(SaveFile& file) {
    const auto names = TERRANE_TRY(readNamed(file));
    if (!file.metadata.at(std::string(kChecksum)).empty()) return {};
    return writeChecksum(file.database, metadataChecksum(file.metadata, names));
}

base::Result<void> makeFolder(const fs::path& path) {
    std::error_code error;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
    if (error)
        return base::fail(ErrorCode::Io, "{}: cannot be made: {}", path.parent_path().string(),
                          error.message());
    return {};
}

void reportUnknown(const SaveFile& file) {
    const std::vector<std::string>& names = file.ids.unknown();
    if (names.empty()) return;
    base::logWarning("{}: {} block types are unknown here and shown as missing, the first is {}",
                     file.database.path(), names.size(), names.front());
}

// A shared lock, or the program that writes.
struct ReadLock {
    std::optional<FileLock> lock;
    std::string inUse;
};

base::Result<ReadLock> lockToRead(const fs::path& path) {
    ReadLock reading;
    auto lock = FileLock::acquire(path, FileLock::Kind::Shared);
    if (lock) {
        reading.lock = std::move(*lock);
    } else if (lock.error().code == ErrorCode::Busy) {
        reading.inUse = lock.error().message.substr(path.string().size() + 2);  // after "path: "
    } else {
        return tl::unexpected(lock.error());
    }
    if (!hasJournal(path)) return reading;
    if (!reading.inUse.empty())
        return base::fail(ErrorCode::Busy, "{}: {}, which is making or migrating it", path.string(),
                          reading.inUse);
    return base::fail(ErrorCode::Incompatible,
                      "{}: its last change was interrupted and is undone when it is opened to play",
                      path.string());
}

// Opens a save of a supported format for reading.
base::Result<SaveFile> openReadable(const fs::path& name) {
    const auto own = TERRANE_TRY(resolvedPath(name));
    const fs::path& path = own;
    auto isThere = TERRANE_TRY(checkFile(path));
    if (!isThere) return notASave(path);
    TERRANE_TRY(checkCompanions(path));
    auto lock = TERRANE_TRY(lockToRead(path));
    // Without a log no files have to be created beside the save, which may be impossible.
    const OpenMode mode = hasLog(path) || !lock.inUse.empty() ? OpenMode::ReadOnly : OpenMode::Immutable;
    auto database = TERRANE_TRY(Database::open(path, mode));
    SaveFile file{std::move(lock.lock), std::move(database), mode, false, std::move(lock.inUse)};
    TERRANE_TRY(file.database.execute("BEGIN"));
    auto kind = TERRANE_TRY(classify(file.database));
    if (kind == SaveKind::Empty) return notASave(path);
    TERRANE_TRY(checkSchema(file.database));
    return file;
}

}  // namespace

base::Result<SaveFile> openToWrite(const fs::path& name, const world::BlockRegistry& registry,
                                   const SaveAccess& access) {
    const auto own = TERRANE_TRY(resolvedPath(name));
    const fs::path& path = own;
    auto isThere = TERRANE_TRY(checkFile(path));
    if (!isThere && !access.create) {
        return notASave(path);
    }
    TERRANE_TRY(checkCompanions(path));
    TERRANE_TRY(makeFolder(path));
    const std::string lost = lostLog(path);
    auto lock = TERRANE_TRY(FileLock::acquire(path, FileLock::Kind::Exclusive));
    if (!lost.empty()) base::logWarning("{}", lost);
    auto database = TERRANE_TRY(Database::open(path, access.create ? OpenMode::Create : OpenMode::ReadWrite));

    SaveFile file{std::move(lock), std::move(database)};
    TERRANE_TRY(makeCurrent(file, path, access));
    // After the tables, so that a new file is never seen without them. Each commit waits for the disk.
    TERRANE_TRY(file.database.execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL"));
    TERRANE_TRY(addMissingChecksum(file));
    TERRANE_TRY(regenerateIfAsked(file, path, access));
    TERRANE_TRY(readContents(file, registry));
    TERRANE_TRY(addNames(file.database, file.ids.added()));
    reportUnknown(file);
    return file;
}

base::Result<SaveFile> openToRead(const fs::path& name, const world::BlockRegistry& registry) {
    auto file = TERRANE_TRY(openReadable(name));
    TERRANE_TRY(readContents(file, registry));
    reportUnknown(file);
    return file;
}

base::Result<Metadata> readSavedMetadata(const fs::path& name) {
    auto file = TERRANE_TRY(openReadable(name));
    (void)TERRANE_TRY(readNamed(file));
    return std::move(file.metadata);
}

}  // namespace terrane::store
