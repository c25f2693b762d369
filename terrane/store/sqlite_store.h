// A world in one SQLite file, held by one program at a time. docs/file-format.md describes the file.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>

#include "terrane/store/chunk_reader.h"
#include "terrane/store/chunk_store.h"
#include "terrane/store/save_file.h"
#include "terrane/store/save_queue.h"
#include "terrane/store/sqlite_writer.h"

namespace terrane::store {

class SqliteStore : public ChunkStore {
  public:
    [[nodiscard]] static base::Result<std::unique_ptr<SqliteStore>> open(const std::filesystem::path& path,
                                                                         const world::BlockRegistry& registry,
                                                                         const SaveAccess& access,
                                                                         SaveLimits limits = {});
    ~SqliteStore() override;

    LoadedChunk load(world::ChunkPos pos) override;
    std::vector<LoadedChunk> loadMany(std::span<const world::ChunkPos> positions) override;
    bool contains(world::ChunkPos pos) override;
    [[nodiscard]] base::Result<std::vector<world::ChunkPos>> editedChunks() override {
        return reader_.editedChunks();
    }
    // A chunk with more block entity data than a save keeps (62 MiB) is reported and left out.
    SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) override;
    std::optional<std::string> metadata(std::string_view name) override;
    SaveNumber setMetadata(std::string_view name, std::string value) override;
    [[nodiscard]] base::Result<void> flush() override { return queue_->flush(); }
    SaveStatus status() override { return queue_->status(); }
    void setDerivedRows(DerivedRows rows) override;
    [[nodiscard]] base::Result<void> deriveAll(std::string_view rules) override;
    const WorldIdentity& identity() const override { return file_.identity; }
    bool isPersistent() const override { return true; }

  private:
    SqliteStore(SaveFile file, const SaveLimits& limits);
    LoadedChunk loadStored(const StoredRow& row, world::ChunkPos pos);
    void setUnread(world::ChunkPos pos, bool isUnread);
    bool isUnread(world::ChunkPos pos);
    ChunkPosSet unreadOf(const SaveBatch& batch);
    base::Result<void> write(const SaveBatch& batch);

    SaveFile file_;
    EntityBudget budget_;
    ChunkReader reader_;
    std::mutex metadataMutex_;
    Metadata metadata_;
    std::mutex unreadMutex_;
    ChunkPosSet unread_;     // reading these failed last: what is there is not known
    std::mutex writeMutex_;  // held while a batch is derived and written
    DerivedRows derivedRows_;
    std::unique_ptr<SqliteWriter> writer_;
    std::unique_ptr<SaveQueue> queue_;  // ends first
};

}  // namespace terrane::store
