#include "terrane/store/sqlite/sqlite_writer.h"

#include <utility>

#include "terrane/base/profile.h"
#include "terrane/store/chunks/chunk_codec.h"
#include "terrane/store/chunks/chunk_key.h"

namespace terrane::store {

base::Result<std::unique_ptr<SqliteWriter>> SqliteWriter::make(SaveFile& file) {
    constexpr const char* kStatements[] = {
        "SELECT data, origin FROM chunks WHERE key = ?1",
        "INSERT INTO chunks (key, origin, data) VALUES (?1, ?2, ?3) ON CONFLICT (key) DO UPDATE "
        "SET origin = excluded.origin, data = excluded.data WHERE excluded.origin <> 0 OR origin = 0",
        "DELETE FROM chunks WHERE key = ?1",
        // In an untrusted file data may be a text or NULL.
        "INSERT INTO quarantine (key, reason, data) SELECT key, ?2, coalesce(data, x'') FROM chunks WHERE "
        "key = ?1",
        "INSERT INTO quarantine (key, reason, data) VALUES (?1, ?2, x'')"};
    static_assert(std::size(kStatements) == sizeof(Statements) / sizeof(Statement));
    std::vector<Statement> made;
    for (const char* sql : kStatements) {
        auto statement = TERRANE_TRY(file.database.prepare(sql));
        made.push_back(std::move(statement));
    }
    auto metadata = TERRANE_TRY(MetadataTable::make(file.database));
    auto next = made.begin();
    const auto take = [&] { return std::move(*next++); };
    // Braces evaluate in order, which is that of kStatements.
    return std::unique_ptr<SqliteWriter>(
        new SqliteWriter(file, Statements{take(), take(), take(), take(), take()}, std::move(metadata)));
}

// The log may still have frames of a failed transaction. After a smaller transaction they would look like
// damage, so the log is emptied first. If that fails, saving has priority.
base::Result<Transaction> SqliteWriter::begin() {
    if (hasFailed_) (void)file_.database.execute("PRAGMA wal_checkpoint(TRUNCATE)");
    hasFailed_ = true;  // until the commit, also if an exception is thrown
    messages_.forget();
    return Transaction::begin(file_.database);
}

base::Result<bool> SqliteWriter::write(const SaveBatch& batch, const ChunkPosSet& unread,
                                       const DerivedBatch& derived) {
    TERRANE_ZONE("save batch");
    auto transaction = TERRANE_TRY(begin());
    isComplete_ = derived.isComplete;
    TERRANE_TRY(writeBatch(batch, unread));
    TERRANE_TRY(writeDerived(derived.rows));
    if (!isComplete_) TERRANE_TRY(metadata_.remove(kDerivedRowsMark));
    TERRANE_TRY(commit(transaction));
    return isComplete_;
}

base::Result<void> SqliteWriter::deriveAll(const DerivedRows& rows, std::string_view rules,
                                           EntityBudget& budget) {
    TERRANE_ZONE("derive all rows");
    auto transaction = TERRANE_TRY(begin());
    const std::string deletion = fmt::format("DELETE FROM chunks WHERE key >= {}", kFirstTileKey);
    TERRANE_TRY(file_.database.execute(deletion));
    auto edited = TERRANE_TRY(readEditedChunks(file_.database));
    // Reads through the writing connection, which sees the transaction's changes.
    SavedRows saved([this](world::ChunkPos pos) { return readRow(use_.selectChunk, pos, file_.format); },
                    file_.ids, file_.identity.heights, budget);
    TERRANE_TRY(deriveInGroups(rows, std::move(edited), saved.reader(), [&](std::span<const ChunkRow> group) {
        return saved.result() ? writeDerived(group) : saved.result();
    }));
    if (!saved.result()) return saved.result();
    TERRANE_TRY(metadata_.put(kDerivedRowsMark, rules));
    return commit(transaction);
}

base::Result<void> SqliteWriter::change(const RowChanges& changes) {
    auto transaction = TERRANE_TRY(begin());
    auto replace = TERRANE_TRY(
        file_.database.prepare("INSERT OR REPLACE INTO chunks (key, origin, data) VALUES (?1, ?2, ?3)"));
    for (const KeyedRow& row : changes.rows) {
        replace.bind(1, row.key);
        replace.bind(2, std::int64_t{row.row.provenance == Provenance::Edited});
        replace.bind(3, ByteView(row.row.data));
        TERRANE_TRY(replace.run());
    }
    for (const std::int64_t key : changes.deleted) {
        use_.deleteChunk.bind(1, key);
        TERRANE_TRY(use_.deleteChunk.run());
    }
    for (const auto& [name, value] : changes.metadata) TERRANE_TRY(metadata_.put(name, value));
    return commit(transaction);
}

// Notes that the log has transactions, so that its loss is detected.
base::Result<void> SqliteWriter::commit(Transaction& transaction) {
    TERRANE_TRY(files_.check());
    TERRANE_TRY(transaction.commit());
    hasFailed_ = false;
    messages_.tell();
    if (file_.lock) file_.lock->setHasLog(true);
    return {};
}

base::Result<void> SqliteWriter::writeBatch(const SaveBatch& batch, const ChunkPosSet& unread) {
    for (const DamagedRow& row : batch.damaged) TERRANE_TRY(quarantine(row));
    for (const auto& [name, value] : batch.metadata) TERRANE_TRY(metadata_.put(name, value));
    for (const world::ChunkPos pos : unread)
        TERRANE_TRY(quarantineRow(pos, "could not be read when it was replaced"));
    for (const auto& [pos, chunk] : batch.chunks) TERRANE_TRY(writeChunk(pos, chunk));
    return {};
}

base::Result<void> SqliteWriter::writeChunk(world::ChunkPos pos, const QueuedChunk& chunk) {
    TERRANE_TRY(quarantineIfDamaged(pos));
    const bool isEdited = chunk.provenance == Provenance::Edited;
    const auto bytes = encodeChunk(*chunk.chunk, file_.ids, checksumSeed(pos, isEdited));
    if (!bytes) {
        messages_.error(fmt::format("{}: {}: {}; it is not saved", file_.database.path(), nameOf(pos),
                                    bytes.error().message));
        isComplete_ = false;
        return {};
    }
    use_.putChunk.bind(1, keyOf(pos));
    use_.putChunk.bind(2, std::int64_t{isEdited});
    use_.putChunk.bind(3, ByteView(*bytes));
    return use_.putChunk.run();
}

base::Result<void> SqliteWriter::writeDerived(std::span<const ChunkRow> rows) {
    for (const auto& [pos, chunk] : rows) {
        if (pos.level == 0 || !world::isInWorld(pos))
            return base::fail(base::ErrorCode::BadInput, "chunk {},{} of level {} follows from no others",
                              pos.x, pos.y, int{pos.level});
        base::Result<void> done;
        if (chunk) {
            done = writeChunk(pos, {chunk, Provenance::Edited});
        } else {
            done = deleteRow(pos);
        }
        if (!done) return done;
    }
    return {};
}

base::Result<void> SqliteWriter::quarantineRow(world::ChunkPos pos, std::string_view reason) {
    use_.quarantineAll.bind(1, keyOf(pos));
    use_.quarantineAll.bind(2, reason);
    auto done = use_.quarantineAll.run();
    if (done || done.error().code != base::ErrorCode::Damaged) return done;
    // Too long to be read by any program: only record that it existed.
    use_.noteQuarantine.bind(1, keyOf(pos));
    use_.noteQuarantine.bind(2, std::string_view(done.error().message));
    TERRANE_TRY(use_.noteQuarantine.run());
    return deleteRow(pos);
}

// The row of a chunk if it is damaged.
base::Result<std::optional<DamagedRow>> SqliteWriter::readDamaged(world::ChunkPos pos) {
    Statement& select = use_.selectChunk;
    const ResetGuard reset(select);
    select.bind(1, keyOf(pos));
    const auto row = TERRANE_TRY(select.step());
    if (!row) return std::optional<DamagedRow>();
    std::string problem = rowProblem(select, 0, 1);
    const ByteView data = select.blob(0);
    const std::uint64_t seed = seedOf(pos, select.number(1), file_.format);
    if (auto good = verifyChunk(data, file_.identity.heights, seed); problem.empty() && !good)
        problem = good.error().message;
    return problem.empty() ? std::nullopt
                           : std::optional(DamagedRow{pos, hashOfRow(data), std::move(problem)});
}

// Checks a row before it is overwritten: a damaged one is quarantined even if nobody tried to load it.
base::Result<void> SqliteWriter::quarantineIfDamaged(world::ChunkPos pos) {
    const auto damaged = readDamaged(pos);
    if (!damaged && damaged.error().code == base::ErrorCode::Damaged)
        return quarantineRow(pos, damaged.error().message);
    if (!damaged) return tl::unexpected(damaged.error());
    if (!*damaged) return {};
    messages_.warn(fmt::format("{}: {}: {}; its old data is kept in the table quarantine",
                               file_.database.path(), nameOf(pos), (*damaged)->reason));
    return quarantine(**damaged);
}

base::Result<bool> SqliteWriter::isSaved(const DamagedRow& row) {
    const ResetGuard reset(use_.selectChunk);
    use_.selectChunk.bind(1, keyOf(row.pos));
    const auto isThere = TERRANE_TRY(use_.selectChunk.step());
    return isThere && hashOfRow(use_.selectChunk.blob(0)) == row.hash;
}

base::Result<void> SqliteWriter::quarantine(const DamagedRow& row) {
    isComplete_ = false;
    const auto isThere = TERRANE_TRY(isSaved(row));
    if (!isThere) return {};
    TERRANE_TRY(quarantineRow(row.pos, row.reason));
    return deleteRow(row.pos);
}

base::Result<void> SqliteWriter::deleteRow(world::ChunkPos pos) {
    use_.deleteChunk.bind(1, keyOf(pos));
    return use_.deleteChunk.run();
}

}  // namespace terrane::store
