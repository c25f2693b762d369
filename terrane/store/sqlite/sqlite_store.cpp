#include "terrane/store/sqlite/sqlite_store.h"

#include <optional>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/store/sqlite/sqlite_writer.h"

namespace terrane::store {

base::Result<std::unique_ptr<ReadableRows>> openSqliteToRead(const std::filesystem::path& path,
                                                             const world::BlockRegistry& registry) {
    auto file = TERRANE_TRY(openToRead(path, registry));
    TERRANE_TRY(file.database.execute("COMMIT"));
    if (!file.inUse.empty())
        base::logInfo("{}: {}; its saved state is read, nothing is changed", file.database.path(),
                      file.inUse);
    return std::make_unique<SqliteReadRows<ReadableRows>>(std::move(file));
}

base::Result<std::unique_ptr<SqliteReader>> SqliteReader::open(const std::filesystem::path& path,
                                                               const world::BlockRegistry& registry,
                                                               const SaveLimits& limits) {
    auto rows = TERRANE_TRY(openSqliteToRead(path, registry));
    return std::unique_ptr<SqliteReader>(new SqliteReader(std::move(rows), limits));
}

namespace {

class SqliteRows : public SqliteReadRows<ChunkRows> {
  public:
    static base::Result<std::unique_ptr<SqliteRows>> make(SaveFile file) {
        auto rows = std::make_unique<SqliteRows>(std::move(file));
        auto writer = TERRANE_TRY(SqliteWriter::make(rows->file_));
        rows->writer_ = std::move(writer);
        return rows;
    }
    using SqliteReadRows::SqliteReadRows;
    // Runs after the last write. Closing the file removes its log.
    ~SqliteRows() override {
        if (file_.lock) file_.lock->setHasLog(false);
    }

    // Rows are derived before the transaction begins, from reads of the file through other connections.
    base::Result<bool> write(const SaveBatch& batch, const ChunkPosSet& unread,
                             const DeriveBatch& derive) override {
        const auto derived = TERRANE_TRY(
            derive(editedOf(batch.chunks), [this](world::ChunkPos pos) { return reader_.read(pos); }));
        return writer_->write(batch, unread, derived);
    }
    base::Result<void> deriveAll(const DerivedRows& rows, std::string_view rules,
                                 EntityBudget& budget) override {
        return writer_->deriveAll(rows, rules, budget);
    }
    base::Result<void> change(const RowChanges& changes) override { return writer_->change(changes); }

  private:
    std::unique_ptr<SqliteWriter> writer_;
};

}  // namespace

base::Result<std::unique_ptr<ChunkRows>> openSqliteRows(const std::filesystem::path& path,
                                                        const world::BlockRegistry& registry,
                                                        const SaveAccess& access) {
    auto file = TERRANE_TRY(openToWrite(path, registry, access));
    auto rows = TERRANE_TRY(SqliteRows::make(std::move(file)));
    return rows;
}

// The saves that are not in the file yet are written into the copy. Those of a running attempt may be in
// both.
base::Result<WriteCopy> SqliteStore::copyFromNow(const world::BlockRegistry& registry) {
    std::optional<base::Result<SaveFile>> opened;
    auto missing = std::make_shared<SaveBatch>(unsaved([&] { opened = openToRead(path(), registry); }));
    if (!*opened) return tl::unexpected(opened->error());
    const auto file = std::make_shared<std::optional<SaveFile>>(std::move(**opened));
    return [file, missing, derive = deriver(), &registry](
               const std::filesystem::path& target, const CopyProgress& progress) -> base::Result<void> {
        auto copied = (*file)->database.backUpTo(target, progress);
        file->reset();  // lets the log shrink again
        if (!copied || missing->isEmpty()) return copied;
        const auto copy = TERRANE_TRY(openSqliteRows(target, registry, {}));
        return copy->write(*missing, {}, derive).map([](bool) {});
    };
}

base::Result<WriteCopy> copyFromNow(ChunkStore& store, const world::BlockRegistry& registry) {
    if (auto* file = dynamic_cast<SqliteStore*>(&store)) return file->copyFromNow(registry);
    return base::fail(base::ErrorCode::Unsupported, "this world is not in a file");
}

std::filesystem::path fileOfStore(const ChunkStore& store) {
    const auto* file = dynamic_cast<const SqliteStore*>(&store);
    return file ? std::filesystem::path(file->path()) : std::filesystem::path();
}

base::Result<std::unique_ptr<SqliteStore>> SqliteStore::open(const std::filesystem::path& path,
                                                             const world::BlockRegistry& registry,
                                                             const SaveAccess& access, SaveLimits limits) {
    auto rows = TERRANE_TRY(openSqliteRows(path, registry, access));
    return std::unique_ptr<SqliteStore>(new SqliteStore(std::move(rows), limits));
}

}  // namespace terrane::store
