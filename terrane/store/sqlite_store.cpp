#include "terrane/store/sqlite_store.h"

#include <utility>

#include "terrane/store/sqlite_writer.h"

namespace terrane::store {
namespace {

class SqliteRows : public ChunkRows {
  public:
    static base::Result<std::unique_ptr<SqliteRows>> make(SaveFile file) {
        std::unique_ptr<SqliteRows> rows(new SqliteRows(std::move(file)));
        auto writer = SqliteWriter::make(rows->file_);
        if (!writer) return tl::unexpected(writer.error());
        rows->writer_ = std::move(*writer);
        return rows;
    }
    // When nothing is written any more. Closing the file takes its log.
    ~SqliteRows() override {
        if (file_.lock) file_.lock->setHasLog(false);
    }

    const std::string& name() const override { return file_.database.path(); }
    const WorldIdentity& identity() const override { return file_.identity; }
    const Metadata& metadata() const override { return file_.metadata; }
    const BlockIdMap& ids() const override { return file_.ids; }

    StoredRow read(world::ChunkPos pos) override { return reader_.read(pos); }
    void readMany(std::span<const world::ChunkPos> positions, const TakeRow& take) override {
        reader_.readMany(positions, take);
    }
    base::Result<bool> contains(world::ChunkPos pos) override { return reader_.contains(pos); }
    base::Result<std::vector<world::ChunkPos>> editedChunks() override { return reader_.editedChunks(); }

    // Rows are derived before the transaction begins, and read what is in the file by other connections.
    base::Result<bool> write(const SaveBatch& batch, const ChunkPosSet& unread,
                             const DeriveBatch& derive) override {
        const auto derived = derive([this](world::ChunkPos pos) { return reader_.read(pos); });
        if (!derived) return tl::unexpected(derived.error());
        return writer_->write(batch, unread, *derived);
    }
    base::Result<void> deriveAll(const DerivedRows& rows, std::string_view rules,
                                 EntityBudget& budget) override {
        return writer_->deriveAll(rows, rules, budget);
    }

  private:
    explicit SqliteRows(SaveFile file)
        : file_(std::move(file)), reader_(file_.database.path(), file_.readers, file_.format) {}

    SaveFile file_;
    ChunkReader reader_;
    std::unique_ptr<SqliteWriter> writer_;
};

}  // namespace

base::Result<std::unique_ptr<SqliteStore>> SqliteStore::open(const std::filesystem::path& path,
                                                             const world::BlockRegistry& registry,
                                                             const SaveAccess& access, SaveLimits limits) {
    auto file = openToWrite(path, registry, access);
    if (!file) return tl::unexpected(file.error());
    auto rows = SqliteRows::make(std::move(*file));
    if (!rows) return tl::unexpected(rows.error());
    return std::unique_ptr<SqliteStore>(new SqliteStore(std::move(*rows), limits));
}

}  // namespace terrane::store
