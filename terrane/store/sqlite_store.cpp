#include "terrane/store/sqlite_store.h"

#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"
#include "terrane/store/chunk_codec.h"

namespace terrane::store {

// The statements that write a batch.
struct SqliteStore::Writer {
    Statement selectChunk, putChunk, putSetting, quarantineIfSame, deleteIfSame;

    static base::Result<std::unique_ptr<Writer>> make(Database& database);

    base::Result<void> write(SaveFile& file, const SaveBatch& batch);
    base::Result<void> writeChunk(SaveFile& file, world::ChunkPos pos, const WaitingChunk& chunk);
    base::Result<void> quarantine(const DamagedRow& row);
};

namespace {

std::string describe(const std::string& path, world::ChunkPos pos, const std::string& problem) {
    return fmt::format("{}: chunk {},{}: {}", path, pos.x, pos.y, problem);
}

}  // namespace

base::Result<std::unique_ptr<SqliteStore::Writer>> SqliteStore::Writer::make(Database& database) {
    auto selectChunk = database.prepare("SELECT data FROM chunks WHERE key = ?1");
    if (!selectChunk) return tl::unexpected(selectChunk.error());
    auto putChunk = database.prepare(
        "INSERT INTO chunks (key, origin, data) VALUES (?1, ?2, ?3) ON CONFLICT (key) DO UPDATE "
        "SET origin = excluded.origin, data = excluded.data WHERE excluded.origin >= origin");
    if (!putChunk) return tl::unexpected(putChunk.error());
    auto putSetting = database.prepare("INSERT OR REPLACE INTO settings (name, value) VALUES (?1, ?2)");
    if (!putSetting) return tl::unexpected(putSetting.error());
    auto quarantine = database.prepare(
        "INSERT INTO quarantine (key, reason, data) SELECT key, ?2, data FROM chunks WHERE key = ?1 AND "
        "CAST(data AS BLOB) = ?3");
    if (!quarantine) return tl::unexpected(quarantine.error());
    auto remove = database.prepare("DELETE FROM chunks WHERE key = ?1 AND CAST(data AS BLOB) = ?2");
    if (!remove) return tl::unexpected(remove.error());
    return std::make_unique<Writer>(Writer{std::move(*selectChunk), std::move(*putChunk),
                                           std::move(*putSetting), std::move(*quarantine),
                                           std::move(*remove)});
}

base::Result<void> SqliteStore::Writer::write(SaveFile& file, const SaveBatch& batch) {
    TERRANE_ZONE("save batch");
    auto transaction = Transaction::begin(file.database);
    if (!transaction) return tl::unexpected(transaction.error());
    for (const DamagedRow& row : batch.damaged)
        if (auto done = quarantine(row); !done) return done;
    for (const auto& [name, value] : batch.settings) {
        putSetting.bind(1, std::string_view(name));
        putSetting.bind(2, std::string_view(value));
        if (auto done = putSetting.run(); !done) return done;
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
    putChunk.bind(2, std::int64_t{chunk.origin == Origin::Edited});
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
      settings_(file_.settings.begin(), file_.settings.end()),
      writer_(std::move(writer)),
      queue_(std::make_unique<SaveQueue>(
          [this](const SaveBatch& batch) { return writer_->write(file_, batch); }, limits)) {}

SqliteStore::~SqliteStore() = default;

LoadedChunk SqliteStore::load(world::ChunkPos pos) {
    TERRANE_ZONE("load chunk");
    if (const auto waiting = queue_->find(pos))
        return {LoadedChunk::State::Present, waiting->chunk, waiting->origin, {}};
    auto stored = reader_.read(pos);
    if (stored && !*stored) return {};

    LoadedChunk result;
    if (stored) {
        auto chunk = decodeChunk((*stored)->data, file_.ids);
        if (chunk) {
            return {LoadedChunk::State::Present,
                    std::make_shared<world::Chunk>(std::move(*chunk)),
                    (*stored)->origin,
                    {}};
        }
        result.problem = describe(file_.database.path(), pos, chunk.error().message);
        base::logWarning("{}; what it had is kept in the table quarantine", result.problem);
        queue_->add(DamagedRow{pos, std::move((*stored)->data), chunk.error().message});
    } else {
        // The file itself is damaged here. Writing fails too, so nothing is overwritten.
        result.problem = describe(file_.database.path(), pos, stored.error().message);
        base::logWarning("{}", result.problem);
    }
    result.state = LoadedChunk::State::Damaged;
    return result;
}

bool SqliteStore::contains(world::ChunkPos pos) {
    if (queue_->find(pos)) return true;
    const auto found = reader_.contains(pos);
    return found && *found;
}

SaveNumber SqliteStore::save(world::ChunkPos pos, world::ChunkPtr chunk, Origin origin) {
    return queue_->add(pos, {std::move(chunk), origin});
}

std::optional<std::string> SqliteStore::setting(std::string_view name) {
    const std::lock_guard lock(settingsMutex_);
    const auto found = settings_.find(name);
    if (found == settings_.end()) return std::nullopt;
    return found->second;
}

SaveNumber SqliteStore::setSetting(std::string_view name, std::string value) {
    if (isIdentitySetting(name)) {
        base::logError("{}: the setting {} belongs to the world's identity and stays as it is",
                       file_.database.path(), name);
        return queue_->status().queued;
    }
    const std::lock_guard lock(settingsMutex_);
    settings_.insert_or_assign(std::string(name), value);
    return queue_->add(std::string(name), std::move(value));
}

}  // namespace terrane::store
