#include "terrane/store/sqlite/sqlite_store.h"

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

base::Result<std::unique_ptr<SqliteStore>> SqliteStore::open(const std::filesystem::path& path,
                                                             const world::BlockRegistry& registry,
                                                             const SaveAccess& access, SaveLimits limits) {
    auto rows = TERRANE_TRY(openSqliteRows(path, registry, access));
    return std::unique_ptr<SqliteStore>(new SqliteStore(std::move(rows), limits));
}

}  // namespace terrane::store
