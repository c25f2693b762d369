#include "terrane/store/sqlite_store.h"

#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"
#include "terrane/store/chunk_codec.h"
#include "terrane/store/chunk_key.h"

namespace terrane::store {

// The statements that write a batch.
struct SqliteStore::Writer {
    Statement selectChunk, putChunk, putMetadata, quarantineIfSame, deleteIfSame;

    static base::Result<std::unique_ptr<Writer>> make(Database& database);

    base::Result<void> write(SaveFile& file, const SaveBatch& batch);
    base::Result<void> writeChunk(SaveFile& file, world::ChunkPos pos, const WaitingChunk& chunk);
    base::Result<void> quarantine(const DamagedRow& row);
};

namespace {

std::string describe(const std::string& path, world::ChunkPos pos, const std::string& problem) {
    return fmt::format("{}: {}: {}", path, nameOf(pos), problem);
}

}  // namespace

base::Result<std::unique_ptr<SqliteStore::Writer>> SqliteStore::Writer::make(Database& database) {
    auto selectChunk = database.prepare("SELECT data FROM chunks WHERE key = ?1");
    if (!selectChunk) return tl::unexpected(selectChunk.error());
    auto putChunk = database.prepare(
        "INSERT INTO chunks (key, origin, data) VALUES (?1, ?2, ?3) ON CONFLICT (key) DO UPDATE "
        "SET origin = excluded.origin, data = excluded.data WHERE excluded.origin >= origin");
    if (!putChunk) return tl::unexpected(putChunk.error());
    auto putMetadata = database.prepare("INSERT OR REPLACE INTO settings (name, value) VALUES (?1, ?2)");
    if (!putMetadata) return tl::unexpected(putMetadata.error());
    auto quarantine = database.prepare(
        "INSERT INTO quarantine (key, reason, data) SELECT key, ?2, data FROM chunks WHERE key = ?1 AND "
        "CAST(data AS BLOB) = ?3");
    if (!quarantine) return tl::unexpected(quarantine.error());
    auto remove = database.prepare("DELETE FROM chunks WHERE key = ?1 AND CAST(data AS BLOB) = ?2");
    if (!remove) return tl::unexpected(remove.error());
    return std::make_unique<Writer>(Writer{std::move(*selectChunk), std::move(*putChunk),
                                           std::move(*putMetadata), std::move(*quarantine),
                                           std::move(*remove)});
}

base::Result<void> SqliteStore::Writer::write(SaveFile& file, const SaveBatch& batch) {
    TERRANE_ZONE("save batch");
    auto transaction = Transaction::begin(file.database);
    if (!transaction) return tl::unexpected(transaction.error());
    for (const DamagedRow& row : batch.damaged)
        if (auto done = quarantine(row); !done) return done;
    for (const auto& [name, value] : batch.metadata) {
        putMetadata.bind(1, std::string_view(name));
        putMetadata.bind(2, std::string_view(value));
        if (auto done = putMetadata.run(); !done) return done;
    }
    for (const auto& [pos, chunk] : batch.chunks)
        if (auto done = writeChunk(file, pos, chunk); !done) return done;
    return transaction->commit();
}

// What is there is looked at before it is overwritten: a row that was damaged is kept, also where nobody
// has tried to load it.
base::Result<void> SqliteStore::Writer::writeChunk(SaveFile& file, world::ChunkPos pos,
                                                   const WaitingChunk& chunk) {
    selectChunk.bind(1, keyOf(pos));
    const auto row = selectChunk.step();
    std::optional<DamagedRow> damaged;
    if (row && *row) {
        const ByteView data = selectChunk.blob(0);
        if (auto good = verifyChunk(data); !good)
            damaged = DamagedRow{pos, Bytes(data.begin(), data.end()), good.error().message};
    }
    selectChunk.reset();
    if (!row) return tl::unexpected(row.error());
    if (damaged) {
        base::logWarning("{}; what it had is kept in the table quarantine",
                         describe(file.database.path(), pos, damaged->reason));
        if (auto done = quarantine(*damaged); !done) return done;
    }

    const auto bytes = encodeChunk(*chunk.chunk, file.ids);
    if (!bytes) {
        base::logError("{}; it is not saved", describe(file.database.path(), pos, bytes.error().message));
        return {};
    }
    putChunk.bind(1, keyOf(pos));
    putChunk.bind(2, std::int64_t{chunk.provenance == Provenance::Edited});
    putChunk.bind(3, ByteView(*bytes));
    return putChunk.run();
}

base::Result<void> SqliteStore::Writer::quarantine(const DamagedRow& row) {
    quarantineIfSame.bind(1, keyOf(row.pos));
    quarantineIfSame.bind(2, std::string_view(row.reason));
    quarantineIfSame.bind(3, ByteView(row.data));
    if (auto done = quarantineIfSame.run(); !done) return done;
    deleteIfSame.bind(1, keyOf(row.pos));
    deleteIfSame.bind(2, ByteView(row.data));
    return deleteIfSame.run();
}

base::Result<std::unique_ptr<SqliteStore>> SqliteStore::open(const std::filesystem::path& path,
                                                             const world::BlockRegistry& registry,
                                                             const SaveAccess& access, SaveLimits limits) {
    auto file = openToWrite(path, registry, access);
    if (!file) return tl::unexpected(file.error());
    auto writer = Writer::make(file->database);
    if (!writer) return tl::unexpected(writer.error());
    return std::unique_ptr<SqliteStore>(new SqliteStore(std::move(*file), std::move(*writer), limits));
}

SqliteStore::SqliteStore(SaveFile file, std::unique_ptr<Writer> writer, SaveLimits limits)
    : file_(std::move(file)),
      reader_(file_.database.path(), file_.readers),
      metadata_(file_.metadata),
      writer_(std::move(writer)),
      queue_(std::make_unique<SaveQueue>(
          [this](const SaveBatch& batch) { return writer_->write(file_, batch); }, limits)) {}

SqliteStore::~SqliteStore() = default;

namespace {

LoadedChunk copyOf(const WaitingChunk& waiting) {
    return {
        LoadedChunk::State::Present, std::make_shared<world::Chunk>(*waiting.chunk), waiting.provenance, {}};
}

}  // namespace

LoadedChunk SqliteStore::loadStored(StoredRow row, world::ChunkPos pos) {
    LoadedChunk loaded = decodeRow(row, file_.ids);
    if (loaded.state != LoadedChunk::State::Damaged) return loaded;
    const std::string reason =
        std::exchange(loaded.problem, describe(file_.database.path(), pos, loaded.problem));
    if (row) {
        base::logWarning("{}; what it had is kept in the table quarantine", loaded.problem);
        queue_->add(DamagedRow{pos, std::move((*row)->data), reason});
    } else {
        // The file itself is damaged here. Writing fails too, so nothing is overwritten.
        base::logWarning("{}", loaded.problem);
    }
    return loaded;
}

LoadedChunk SqliteStore::load(world::ChunkPos pos) {
    TERRANE_ZONE("load chunk");
    if (const auto waiting = queue_->find(pos)) return copyOf(*waiting);
    return loadStored(reader_.read(pos), pos);
}

// The queue first: what is no longer in it is in the file, and in the transaction that reads it.
std::vector<LoadedChunk> SqliteStore::loadMany(std::span<const world::ChunkPos> positions) {
    TERRANE_ZONE("load chunks");
    const auto waiting = queue_->findMany(positions);
    std::vector<world::ChunkPos> stored;
    for (std::size_t k = 0; k < positions.size(); ++k)
        if (!waiting[k]) stored.push_back(positions[k]);
    std::vector<StoredRow> rows = reader_.readMany(stored);
    auto next = rows.begin();
    std::vector<LoadedChunk> loaded;
    loaded.reserve(positions.size());
    for (std::size_t k = 0; k < positions.size(); ++k)
        loaded.push_back(waiting[k] ? copyOf(*waiting[k]) : loadStored(std::move(*next++), positions[k]));
    return loaded;
}

bool SqliteStore::contains(world::ChunkPos pos) {
    if (queue_->find(pos)) return true;
    const auto found = reader_.contains(pos);
    return found && *found;
}

SaveNumber SqliteStore::save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) {
    return queue_->add(pos, {std::move(chunk), provenance});
}

std::optional<std::string> SqliteStore::metadata(std::string_view name) {
    const std::lock_guard lock(metadataMutex_);
    const auto found = metadata_.find(name);
    if (found == metadata_.end()) return std::nullopt;
    return found->second;
}

SaveNumber SqliteStore::setMetadata(std::string_view name, std::string value) {
    if (isPartOfIdentity(name)) {
        base::logError("{}: {} belongs to the world's identity and stays as it is", file_.database.path(),
                       name);
        return queue_->status().queued;
    }
    const std::lock_guard lock(metadataMutex_);
    metadata_.insert_or_assign(std::string(name), value);
    return queue_->add(std::string(name), std::move(value));
}

}  // namespace terrane::store
