#include "terrane/store/memory_store.h"

#include <utility>

namespace terrane::store {
namespace {

class EmptyStore : public ReadableStore {
  public:
    explicit EmptyStore(WorldIdentity identity) : identity_(std::move(identity)) {}

    LoadedChunk load(world::ChunkPos) override { return {}; }
    bool contains(world::ChunkPos) override { return false; }
    base::Result<std::vector<world::ChunkPos>> editedChunks() override { return {}; }
    std::optional<std::string> metadata(std::string_view) override { return std::nullopt; }
    const WorldIdentity& identity() const override { return identity_; }

  private:
    WorldIdentity identity_;
};

}  // namespace

MemoryStore::MemoryStore(WorldIdentity identity, SaveLimits limits)
    : OverlayStore(std::make_unique<EmptyStore>(std::move(identity)), limits) {}

}  // namespace terrane::store
