// The store of a world on a server: chunks are what the generator makes, with the differences that the server
// told. It saves nothing, as the server does: what other stores promise of saving is not promised here. Any
// thread may call everything.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "terrane/gen/level_generators.h"
#include "terrane/net/chunk_difference.h"
#include "terrane/store/chunk_store.h"

namespace terrane::net {

class RemoteStore : public store::ChunkStore {
  public:
    // The generators are its own: a session's are made with the session, after its store.
    RemoteStore(store::WorldIdentity identity, gen::LevelGenerators generators);

    // What the server tells of a chunk or tile: in place of what was known, or besides.
    void setDifference(world::ChunkPos pos, ChunkDifference difference);
    void addDifference(world::ChunkPos pos, std::span<const ChangedBlock> newer);
    // Empty where nothing is known, or nothing differs.
    ChunkDifference difference(world::ChunkPos pos) const;
    std::size_t blockCount() const;  // of all differences

    store::LoadedChunk load(world::ChunkPos pos) override;
    bool contains(world::ChunkPos pos) override;
    [[nodiscard]] base::Result<std::vector<world::ChunkPos>> editedChunks() override;
    std::optional<std::string> metadata(std::string_view name) override;
    const store::WorldIdentity& identity() const override { return identity_; }

    store::SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, store::Provenance provenance) override;
    store::SaveNumber setMetadata(std::string_view name, std::string value) override;
    [[nodiscard]] base::Result<void> flush() override { return {}; }
    store::SaveStatus status() override { return {}; }
    // Tiles come from the server as well.
    void setDerivedRows(store::DerivedRows rows) override;
    [[nodiscard]] base::Result<void> deriveAll(std::string_view rules) override;
    bool isPersistent() const override { return false; }

  private:
    store::WorldIdentity identity_;
    gen::LevelGenerators generators_;
    mutable std::mutex mutex_;
    std::unordered_map<world::ChunkPos, ChunkDifference, world::ChunkPosHash> differences_;  // none is empty
    std::map<std::string, std::string, std::less<>> metadata_;
};

}  // namespace terrane::net
