// A world that is kept until the program ends.
#pragma once

#include <map>
#include <mutex>
#include <unordered_map>

#include "terrane/store/chunk_store.h"

namespace terrane::store {

class MemoryStore : public ChunkStore {
  public:
    explicit MemoryStore(WorldIdentity identity) : identity_(std::move(identity)) {}

    LoadedChunk load(world::ChunkPos pos) override;
    bool contains(world::ChunkPos pos) override;
    SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) override;
    std::optional<std::string> metadata(std::string_view name) override;
    SaveNumber setMetadata(std::string_view name, std::string value) override;
    [[nodiscard]] base::Result<void> flush() override { return {}; }
    SaveStatus status() override;  // "durable" as far as memory is
    const WorldIdentity& identity() const override { return identity_; }
    bool isPersistent() const override { return false; }

  private:
    struct Saved {
        world::ChunkPtr chunk;
        Provenance provenance = Provenance::Generated;
    };

    WorldIdentity identity_;
    std::mutex mutex_;
    std::unordered_map<world::ChunkPos, Saved, world::ChunkPosHash> chunks_;
    std::map<std::string, std::string, std::less<>> metadata_;
    SaveNumber saves_ = 0;
};

}  // namespace terrane::store
