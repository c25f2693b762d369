#include "terrane/store/chunk_store.h"

namespace terrane::store {

std::string nameOf(world::ChunkPos pos) {
    std::string name = fmt::format("chunk {},{}", pos.x, pos.y);
    if (pos.level > 0) name += fmt::format(" of level {}", pos.level);
    return name;
}

std::vector<LoadedChunk> ReadableStore::loadMany(std::span<const world::ChunkPos> positions) {
    std::vector<LoadedChunk> loaded;
    loaded.reserve(positions.size());
    for (const world::ChunkPos pos : positions) loaded.push_back(load(pos));
    return loaded;
}

}  // namespace terrane::store
