// A world in one SQLite file, used by one program at a time. docs/file-format.md describes the file.
#pragma once

#include <filesystem>
#include <memory>
#include <utility>

#include "terrane/store/queued_store.h"
#include "terrane/store/saves/save_file.h"

namespace terrane::store {

// The rows of an open save, shared by readers and writers of its file. It is included by sqlite_*.cpp. `Base`
// is ReadableRows or ChunkRows.
template <class Base>
class SqliteReadRows : public Base {
  public:
    explicit SqliteReadRows(SaveFile file)
        : file_(std::move(file)), reader_(file_.database.path(), file_.readers, file_.format) {}

    const std::string& name() const override { return file_.database.path(); }
    const WorldIdentity& identity() const override { return file_.identity; }
    const Metadata& metadata() const override { return file_.metadata; }
    const BlockIdMap& ids() const override { return file_.ids; }
    StoredRow read(world::ChunkPos pos) override { return reader_.read(pos); }
    void readMany(std::span<const world::ChunkPos> positions, const ReadableRows::TakeRow& take) override {
        reader_.readMany(positions, take);
    }
    base::Result<bool> contains(world::ChunkPos pos) override { return reader_.contains(pos); }
    base::Result<std::vector<world::ChunkPos>> editedChunks() override { return reader_.editedChunks(); }
    base::Result<std::vector<KeyedRow>> rowsAfter(std::int64_t key, std::size_t count) override {
        return reader_.rowsAfter(key, count);
    }
    base::Result<std::uint64_t> rowCount() override { return reader_.rowCount(); }

  protected:
    SaveFile file_;
    ChunkReader reader_;
};

// A read-only store of a world in a SQLite file, which need not be writable. While another program plays the
// world, its last saved state is read.
class SqliteReader : public RowsReader {
  public:
    // See openToRead().
    [[nodiscard]] static base::Result<std::unique_ptr<SqliteReader>> open(
        const std::filesystem::path& path, const world::BlockRegistry& registry,
        const SaveLimits& limits = {});

  private:
    using RowsReader::RowsReader;
};

// Opens only the rows, for a copy.
[[nodiscard]] base::Result<std::unique_ptr<ReadableRows>> openSqliteToRead(
    const std::filesystem::path& path, const world::BlockRegistry& registry);

class SqliteStore : public QueuedStore {
  public:
    [[nodiscard]] static base::Result<std::unique_ptr<SqliteStore>> open(const std::filesystem::path& path,
                                                                         const world::BlockRegistry& registry,
                                                                         const SaveAccess& access,
                                                                         SaveLimits limits = {});

    const std::string& path() const { return rows().name(); }
    // See copyFromNow().
    [[nodiscard]] base::Result<WriteCopy> copyFromNow(const world::BlockRegistry& registry);

  private:
    using QueuedStore::QueuedStore;
};

// Begins a copy of a world as of now, with all queued saves and none of the later ones. It takes milliseconds
// and waits for no write. Returns Unsupported if the world is not in a file.
[[nodiscard]] base::Result<WriteCopy> copyFromNow(ChunkStore& store, const world::BlockRegistry& registry);
// The file of a world; empty if it is not in a file.
std::filesystem::path fileOfStore(const ChunkStore& store);

// Opens only the rows, for a copy.
[[nodiscard]] base::Result<std::unique_ptr<ChunkRows>> openSqliteRows(const std::filesystem::path& path,
                                                                      const world::BlockRegistry& registry,
                                                                      const SaveAccess& access);

}  // namespace terrane::store
