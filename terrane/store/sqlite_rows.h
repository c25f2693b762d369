// The rows of an open save, shared by readers and writers of its file. Included by sqlite_*.cpp.
#pragma once

#include <utility>

#include "terrane/store/queued_store.h"
#include "terrane/store/save_file.h"

namespace terrane::store {

// `Base` is ReadableRows or ChunkRows.
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

}  // namespace terrane::store
