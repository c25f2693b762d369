// Changes in memory over a store that stays as it is: for saves that cannot be written, and for commands that
// must not change a world.
#pragma once

#include <memory>

#include "terrane/store/memory_store.h"

namespace terrane::store {

class OverlayStore : public ChunkStore {
  public:
    explicit OverlayStore(std::unique_ptr<ReadableStore> below);

    // What is not saved here comes from below.
    LoadedChunk load(world::ChunkPos pos) override;
    std::vector<LoadedChunk> loadMany(std::span<const world::ChunkPos> positions) override;
    bool contains(world::ChunkPos pos) override;
    std::optional<std::string> metadata(std::string_view name) override;

    SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) override;
    SaveNumber setMetadata(std::string_view name, std::string value) override;
    [[nodiscard]] base::Result<void> flush() override { return {}; }
    SaveStatus status() override { return above_.status(); }
    const WorldIdentity& identity() const override { return above_.identity(); }
    bool isPersistent() const override { return false; }

  private:
    std::unique_ptr<ReadableStore> below_;
    MemoryStore above_;
};

}  // namespace terrane::store
