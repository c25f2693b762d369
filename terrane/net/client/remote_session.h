// Checks whether a client can play in an offered world, and makes the parts of its session. Any thread.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "terrane/game/session.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/level_generators.h"
#include "terrane/net/wire/chunk_difference.h"
#include "terrane/net/wire/server_message.h"
#include "terrane/store/chunk_store.h"

namespace terrane::net {

// The client's store of a world on a server: generated chunks with the differences that the server sent. It
// saves nothing, since the server does: the guarantees of ChunkStore about saving do not hold. Any thread may
// call everything.
class RemoteStore : public store::ChunkStore {
  public:
    // Has its own generators: those of the session are made later.
    RemoteStore(store::WorldIdentity identity, gen::LevelGenerators generators);

    // Replaces or extends the difference of a chunk or tile, as the server sent it.
    void setDifference(world::ChunkPos pos, ChunkDifference difference);
    void addDifference(world::ChunkPos pos, std::span<const ChangedBlock> newer);
    // Empty if nothing is known or nothing differs.
    ChunkDifference difference(world::ChunkPos pos) const;
    std::size_t blockCount() const;                  // in all differences
    std::vector<world::ChunkPos> positions() const;  // of all differences, unordered

    store::LoadedChunk load(world::ChunkPos pos) override;
    bool contains(world::ChunkPos pos) override;
    [[nodiscard]] base::Result<std::vector<world::ChunkPos>> editedChunks() override;
    std::optional<std::string> metadata(std::string_view name) override;
    const store::WorldIdentity& identity() const override { return identity_; }

    store::SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, store::Provenance provenance) override;
    store::SaveNumber setMetadata(std::string_view name, std::string value) override;
    [[nodiscard]] base::Result<void> flush() override { return {}; }
    store::SaveStatus status() override { return {}; }
    // Tiles come from the server; nothing is derived here.
    void setDerivedRows(store::DerivedRows rows) override;
    [[nodiscard]] base::Result<void> deriveAll(std::string_view rules) override;
    bool isPersistent() const override { return false; }

  private:
    store::WorldIdentity identity_;
    gen::LevelGenerators generators_;
    mutable std::mutex mutex_;
    std::unordered_map<world::ChunkPos, ChunkDifference, world::ChunkPosHash> differences_;  // none empty
    std::map<std::string, std::string, std::less<>> metadata_;
};

// The generator of the offered world. If this program generates another world, the error says in one line how
// they differ. `generators`: the generators of this program.
[[nodiscard]] base::Result<gen::Generator> offeredGenerator(
    const WorldOffer& offer, const world::BlockRegistry& blocks,
    const gen::GeneratorCatalogue& generators = gen::builtInGenerators());

// `store` is owned by `parts`, then by the session; ClientWorld updates it.
struct RemoteSessionParts {
    game::SessionParts parts;
    RemoteStore* store = nullptr;
};
// Call after offeredGenerator() succeeded.
[[nodiscard]] base::Result<RemoteSessionParts> remoteSessionParts(
    const store::WorldIdentity& identity, std::shared_ptr<const world::BlockRegistry> blocks,
    unsigned threads, const gen::GeneratorCatalogue& generators = gen::builtInGenerators());

}  // namespace terrane::net
