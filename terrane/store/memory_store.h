// A world that is kept until the program ends: for tests, and for saves in places that cannot be written,
// which it reads but leaves as they are.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <unordered_map>

#include "terrane/store/chunk_reader.h"
#include "terrane/store/chunk_store.h"
#include "terrane/store/save_file.h"
#include "terrane/store/save_queue.h"

namespace terrane::store {

class MemoryStore : public ChunkStore {
  public:
    explicit MemoryStore(WorldIdentity identity) : identity_(std::move(identity)) {}
    // What is not saved here is read from `below`, opened by openToRead().
    explicit MemoryStore(SaveFile below);

    LoadedChunk load(world::ChunkPos pos) override;
    bool contains(world::ChunkPos pos) override;
    SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, Origin origin) override;
    std::optional<std::string> setting(std::string_view name) override;
    SaveNumber setSetting(std::string_view name, std::string value) override;
    [[nodiscard]] base::Result<void> flush() override { return {}; }
    SaveStatus status() override;  // "durable" as far as memory is
    const WorldIdentity& identity() const override { return identity_; }
    bool isPersistent() const override { return false; }

  private:
    LoadedChunk loadBelow(world::ChunkPos pos);

    WorldIdentity identity_;
    std::optional<SaveFile> below_;
    std::optional<ChunkReader> reader_;  // of `below_`
    std::mutex mutex_;
    std::unordered_map<world::ChunkPos, WaitingChunk, world::ChunkPosHash> chunks_;
    std::map<std::string, std::string, std::less<>> settings_;
    SaveNumber saves_ = 0;
};

}  // namespace terrane::store
