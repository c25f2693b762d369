#include "terrane/store/chunk_store.h"

namespace terrane::store {

LoadedChunk loadedCopy(const world::ChunkPtr& chunk, Provenance provenance) {
    if (!chunk) return {};
    return {LoadedChunk::State::Present, std::make_shared<world::Chunk>(*chunk), provenance, {}};
}

std::string nameOf(world::ChunkPos pos) {
    std::string name = fmt::format("chunk {},{}", pos.x, pos.y);
    if (pos.level > 0) name += fmt::format(" of level {}", pos.level);
    return name;
}

base::Result<std::vector<world::ChunkPos>> missingChunks(std::span<const world::ChunkPos> positions,
                                                         std::span<const LoadedChunk> stored) {
    std::vector<world::ChunkPos> missing;
    for (std::size_t k = 0; k < positions.size(); ++k) {
        if (stored[k].isUnreadable && !stored[k].isOverBudget)
            return base::fail(base::ErrorCode::Io, "{}", stored[k].problem);
        if (!stored[k].chunk) missing.push_back(positions[k]);
    }
    return missing;
}

std::vector<LoadedChunk> ReadableStore::loadMany(std::span<const world::ChunkPos> positions) {
    std::vector<LoadedChunk> loaded;
    loaded.reserve(positions.size());
    for (const world::ChunkPos pos : positions) loaded.push_back(load(pos));
    return loaded;
}

}  // namespace terrane::store
