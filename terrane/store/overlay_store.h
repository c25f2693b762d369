// Stores changes in memory over a store that is not changed: for playing without saving, and for commands
// that must not change a world. MemoryStore is an overlay over an empty world.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "terrane/store/chunk_store.h"
#include "terrane/store/save_queue.h"

namespace terrane::store {

class OverlayStore : public ChunkStore {
  public:
    explicit OverlayStore(std::unique_ptr<ReadableStore> below, SaveLimits limits = {});
    ~OverlayStore() override;

    // Loads from the store below if nothing was saved in memory.
    LoadedChunk load(world::ChunkPos pos) override;
    std::vector<LoadedChunk> loadMany(std::span<const world::ChunkPos> positions) override;
    bool contains(world::ChunkPos pos) override;
    [[nodiscard]] base::Result<std::vector<world::ChunkPos>> editedChunks() override;
    std::optional<std::string> metadata(std::string_view name) override;

    SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) override;
    SaveNumber setMetadata(std::string_view name, std::string value) override;
    [[nodiscard]] base::Result<void> flush() override { return queue_->flush(); }
    SaveStatus status() override { return queue_->status(); }  // durable means: in memory
    void setDerivedRows(DerivedRows rows) override;
    [[nodiscard]] base::Result<void> deriveAll(std::string_view rules) override;
    const WorldIdentity& identity() const override { return below_->identity(); }
    bool isPersistent() const override { return false; }

  private:
    struct Row {
        world::ChunkPtr chunk;  // null: hides the row below
        Provenance provenance = Provenance::Generated;
    };
    std::optional<Row> find(world::ChunkPos pos);  // no value: the row below counts
    world::ChunkPtr editedChunk(world::ChunkPos pos);
    base::Result<void> write(const SaveBatch& batch);

    std::unique_ptr<ReadableStore> below_;
    std::mutex writeMutex_;  // held while a batch is derived and written
    DerivedRows derivedRows_;
    std::mutex mutex_;  // guards the members below, which change under both mutexes
    std::unordered_map<world::ChunkPos, Row, world::ChunkPosHash> rows_;
    bool hidesTiles_ = false;                                                  // all rows of levels above 0
    std::map<std::string, std::optional<std::string>, std::less<>> metadata_;  // no value: hidden
    std::unique_ptr<SaveQueue> queue_;                                         // destroyed first
};

// A store in memory, which lasts until the program ends.
class MemoryStore : public OverlayStore {
  public:
    explicit MemoryStore(WorldIdentity identity, SaveLimits limits = {});
};

}  // namespace terrane::store
