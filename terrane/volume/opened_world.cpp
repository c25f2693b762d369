#include "terrane/volume/opened_world.h"

#include <algorithm>
#include <utility>

#include "terrane/stream/edited_tiles.h"

namespace terrane::volume {

// The calling thread works too.
OpenedWorld::OpenedWorld(WorldParts parts)
    : blocks_(std::move(parts.blocks)),
      lights_(*blocks_),
      kinds_(map::surfaceKinds(*blocks_)),
      generators_(std::move(parts.generators)),
      store_(std::move(parts.store)),
      surfaces_({generators_, kinds_, store_.get()}),
      jobs_(std::max(1u, parts.threads) - 1) {}

base::Result<std::unique_ptr<OpenedWorld>> OpenedWorld::create(WorldParts parts) {
    std::unique_ptr<OpenedWorld> world(new OpenedWorld(std::move(parts)));
    stream::maintainTileRows(*world->store_, world->generators_, *world->blocks_, {});
    TERRANE_TRY(stream::buildTileRows(*world->store_));
    return world;
}

void OpenedWorld::markEdited(std::span<const world::ChunkPos> chunks) {
    if (chunks.empty()) return;
    hasUnsettledTiles_ = true;
    {
        const std::lock_guard lock(listenerMutex_);
        if (listener_) listener_(chunks);
    }
    const std::lock_guard lock(editedMutex_);
    if (!edited_) return;
    for (const world::ChunkPos chunk : chunks) edited_->add(chunk);
}

void OpenedWorld::setEditListener(EditListener listener) {
    const std::lock_guard lock(listenerMutex_);
    listener_ = std::move(listener);
}

const gen::Biomes* OpenedWorld::biomes() {
    std::call_once(biomesFlag_, [&] {
        const store::WorldIdentity& identity = store_->identity();
        biomes_ = gen::Biomes::create(identity.generator, *blocks_, identity.seed);
    });
    return biomes_ ? &*biomes_ : nullptr;
}

base::Result<void> OpenedWorld::waitForTiles() {
    const std::lock_guard lock(settleMutex_);  // other callers wait as well
    if (!hasUnsettledTiles_.exchange(false)) return {};
    auto flushed = store_->flush();
    if (!flushed) hasUnsettledTiles_ = true;
    return flushed;
}

base::Result<std::vector<map::EditedChunk>> OpenedWorld::editedAmong(
    std::span<const world::ChunkPos> chunks) {
    const std::lock_guard lock(editedMutex_);
    if (!edited_) {
        // The list lacks chunks that wait to be saved.
        TERRANE_TRY(store_->flush());
        const auto all = TERRANE_TRY(store_->editedChunks());
        edited_.emplace();
        for (const world::ChunkPos chunk : all) edited_->add(chunk);
    }
    return edited_->among(chunks);
}

}  // namespace terrane::volume
