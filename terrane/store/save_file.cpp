#include "terrane/store/save_file.h"

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/store/chunk_key.h"
#include "terrane/store/chunk_store.h"
#include "terrane/store/companion_files.h"
#include "terrane/store/derived_rows.h"
#include "terrane/store/metadata_table.h"
#include "terrane/store/schema_check.h"

namespace terrane::store {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagic = "SQLite format 3\0"sv;  // the first bytes of a SQLite file

using base::ErrorCode;
namespace fs = std::filesystem;

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
    if (auto whole = checkLength(path, size); !whole) return tl::unexpected(whole.error());
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
    auto transaction = Transaction::begin(database);
    if (!transaction) return tl::unexpected(transaction.error());
    auto metadata = MetadataTable::make(database);
    if (!metadata) return tl::unexpected(metadata.error());
    for (const SavedName& name : names)
        if (auto done = metadata->add(name); !done) return done;
    return transaction->commit();
}

base::Result<void> makeCurrent(SaveFile& file, const fs::path& path, const SaveAccess& access) {
    auto kind = classify(file.database);
    if (!kind) return tl::unexpected(kind.error());
    if (*kind == SaveKind::Empty) {
        if (!access.create) return notASave(path);
        file.isNew = true;
        if (auto made = createTables(file.database, *access.create); !made) return made;
        return addNames(file.database, access.blockNames);
    }
    if (auto same = checkSchema(file.database); !same) return same;
    if (*kind == SaveKind::Old) {
        const fs::path backup = backupPath(path, "before-migration");
        auto migrated = migrate(file.database, migrations(), kFormatVersion, backup);
        if (!migrated) return migrated;
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
    if (auto done = database.execute(sql); !done) return done;
    auto metadata = MetadataTable::make(database);
    if (!metadata) return tl::unexpected(metadata.error());
    if (auto done = metadata->remove(kDerivedRowsMark); !done) return done;
    return metadata->put("generator_version", std::to_string(by.generatorVersion));
}

// Makes the backup copy, if requested, before deleting anything.
base::Result<void> regenerate(SaveFile& file, const fs::path& path, const Regeneration& by) {
    const fs::path backup = by.keepsCopy ? backupPath(path, "backup") : fs::path();
    if (by.keepsCopy)
        if (auto copied = file.database.backUpTo(backup); !copied) return copied;
    auto transaction = Transaction::begin(file.database);
    if (!transaction) return tl::unexpected(transaction.error());
    if (auto done = deleteRegenerated(file.database, by); !done) return done;
    if (auto done = transaction->commit(); !done) return done;
    base::logInfo("{}: regenerated{}{}{}", path.string(),
                  by.chunks == Regenerate::All ? "" : " except for chunks with edits",
                  by.keepsCopy ? "; the old world is " : "", backup.string());
    return {};
}

// Reads settings and block names, and verifies their checksum.
base::Result<std::vector<SavedName>> readNamed(SaveFile& file) {
    auto metadata = readMetadata(file.database);
    if (!metadata) return tl::unexpected(metadata.error());
    auto names = readBlockNames(file.database);
    if (!names) return names;
    auto identity = identityFrom(*metadata, file.database.path());
    if (!identity) return tl::unexpected(identity.error());
    if (file.format >= kFirstWithChecksums)
        if (auto same = verifyMetadata(*metadata, *names, file.database.path()); !same)
            return tl::unexpected(same.error());
    file.metadata = std::move(*metadata);
    file.identity = std::move(*identity);
    return names;
}

base::Result<void> regenerateIfAsked(SaveFile& file, const fs::path& path, const SaveAccess& access) {
    if (file.isNew || !access.decide) return {};
    const auto by = access.decide(file.identity);
    if (!by) return tl::unexpected(by.error());
    return by->chunks == Regenerate::None ? base::Result<void>() : regenerate(file, path, *by);
}

base::Result<void> readContents(SaveFile& file, const world::BlockRegistry& registry) {
    const auto names = readNamed(file);
    if (!names) return tl::unexpected(names.error());
    auto ids = BlockIdMap::make(registry, *names);
    if (!ids) return base::fail(ids.error().code, "{}: {}", file.database.path(), ids.error().message);
    file.ids = std::move(*ids);
    file.metadata.erase(std::string(kChecksum));
    return {};
}

// Fills in the checksum if another program cleared it.
base::Result<void> addMissingChecksum(SaveFile& file) {
    const auto names = readNamed(file);
    if (!names) return tl::unexpected(names.error());
    if (!file.metadata.at(std::string(kChecksum)).empty()) return {};
    return writeChecksum(file.database, metadataChecksum(file.metadata, *names));
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

// Reads the format of a save that is opened for reading.
base::Result<void> readFormat(SaveFile& file) {
    const auto version = file.database.queryNumber("PRAGMA user_version");
    if (!version) return tl::unexpected(version.error());
    file.format = version->value_or(0);
    if (file.format >= kOldestReadable) return {};
    return base::fail(ErrorCode::Incompatible, "{}: unknown format {}", file.database.path(), file.format);
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
    const auto own = ownPath(name);
    if (!own) return tl::unexpected(own.error());
    const fs::path& path = *own;
    auto isThere = checkFile(path);
    if (!isThere) return tl::unexpected(isThere.error());
    if (!*isThere) return notASave(path);
    if (auto checked = checkCompanions(path); !checked) return tl::unexpected(checked.error());
    auto lock = lockToRead(path);
    if (!lock) return tl::unexpected(lock.error());
    // Without a log no files have to be created beside the save, which may be impossible.
    const OpenMode mode = hasLog(path) || !lock->inUse.empty() ? OpenMode::ReadOnly : OpenMode::Immutable;
    auto database = Database::open(path, mode);
    if (!database) return tl::unexpected(database.error());
    SaveFile file{std::move(lock->lock), std::move(*database), mode, false, std::move(lock->inUse)};
    if (auto begun = file.database.execute("BEGIN"); !begun) return tl::unexpected(begun.error());
    auto kind = classify(file.database);
    if (!kind) return tl::unexpected(kind.error());
    if (*kind == SaveKind::Empty) return notASave(path);
    if (auto same = checkSchema(file.database); !same) return tl::unexpected(same.error());
    if (auto done = readFormat(file); !done) return tl::unexpected(done.error());
    return file;
}

}  // namespace

base::Result<SaveFile> openToWrite(const fs::path& name, const world::BlockRegistry& registry,
                                   const SaveAccess& access) {
    const auto own = ownPath(name);
    if (!own) return tl::unexpected(own.error());
    const fs::path& path = *own;
    auto isThere = checkFile(path);
    if (!isThere) return tl::unexpected(isThere.error());
    if (!*isThere && !access.create) {
        return notASave(path);
    }
    if (auto checked = checkCompanions(path); !checked) return tl::unexpected(checked.error());
    if (auto made = makeFolder(path); !made) return tl::unexpected(made.error());
    const std::string lost = lostLog(path);
    auto lock = FileLock::acquire(path, FileLock::Kind::Exclusive);
    if (!lock) return tl::unexpected(lock.error());
    if (!lost.empty()) base::logWarning("{}", lost);
    auto database = Database::open(path, access.create ? OpenMode::Create : OpenMode::ReadWrite);
    if (!database) return tl::unexpected(database.error());

    SaveFile file{std::move(*lock), std::move(*database)};
    if (auto done = makeCurrent(file, path, access); !done) return tl::unexpected(done.error());
    // After the tables, so that a new file is never seen without them. Each commit waits for the disk.
    const auto set = file.database.execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL");
    if (!set) return tl::unexpected(set.error());
    if (auto done = addMissingChecksum(file); !done) return tl::unexpected(done.error());
    if (auto done = regenerateIfAsked(file, path, access); !done) return tl::unexpected(done.error());
    if (auto done = readContents(file, registry); !done) return tl::unexpected(done.error());
    if (auto done = addNames(file.database, file.ids.added()); !done) return tl::unexpected(done.error());
    reportUnknown(file);
    return file;
}

base::Result<SaveFile> openToRead(const fs::path& name, const world::BlockRegistry& registry) {
    auto file = openReadable(name);
    if (!file) return file;
    if (auto done = readContents(*file, registry); !done) return tl::unexpected(done.error());
    reportUnknown(*file);
    return file;
}

base::Result<Metadata> readSavedMetadata(const fs::path& name) {
    auto file = openReadable(name);
    if (!file) return tl::unexpected(file.error());
    if (const auto names = readNamed(*file); !names) return tl::unexpected(names.error());
    return std::move(file->metadata);
}

}  // namespace terrane::store
