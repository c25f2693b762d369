#include "terrane/store/memory_store.h"

#include <utility>

#include "terrane/base/log.h"
#include "terrane/store/metadata.h"

namespace terrane::store {

LoadedChunk MemoryStore::load(world::ChunkPos pos) {
    Saved saved;
    {
        const std::lock_guard lock(mutex_);
        const auto found = chunks_.find(pos);
        if (found == chunks_.end()) return {};
        saved = found->second;
    }
    return {LoadedChunk::State::Present, std::make_shared<world::Chunk>(*saved.chunk), saved.provenance, {}};
}

bool MemoryStore::contains(world::ChunkPos pos) {
    const std::lock_guard lock(mutex_);
    return chunks_.contains(pos);
}

SaveNumber MemoryStore::save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) {
    const std::lock_guard lock(mutex_);
    const auto [entry, isNew] = chunks_.try_emplace(pos, Saved{chunk, provenance});
    if (!isNew && provenance >= entry->second.provenance) entry->second = {std::move(chunk), provenance};
    return ++saves_;
}

std::optional<std::string> MemoryStore::metadata(std::string_view name) {
    const std::lock_guard lock(mutex_);
    const auto found = metadata_.find(name);
    if (found == metadata_.end()) return std::nullopt;
    return found->second;
}

SaveNumber MemoryStore::setMetadata(std::string_view name, std::string value) {
    const std::lock_guard lock(mutex_);
    if (isPartOfIdentity(name)) {
        base::logError("{} belongs to the world's identity and stays as it is", name);
        return saves_;
    }
    metadata_.insert_or_assign(std::string(name), std::move(value));
    return ++saves_;
}

SaveStatus MemoryStore::status() {
    const std::lock_guard lock(mutex_);
    return {saves_, saves_, 0, {}};
}

}  // namespace terrane::store
