#include "terrane/world/world.h"

#include <cassert>
#include <memory>
#include <utility>

namespace terrane::world {
namespace {

// The chunk to write to: itself where nobody else holds it, else a copy that takes its place.
Chunk& writable(ChunkPtr& chunk) {
    if (chunk.use_count() != 1) {
        auto copy = std::make_shared<Chunk>(*chunk);
        Chunk& result = *copy;
        chunk = std::move(copy);
        return result;
    }
    // use_count() orders nothing: what a worker read before it let go of the chunk could still overlap the
    // write that follows. Taking and dropping a reference is an acquire-release operation on the count, after
    // the worker's.
    ChunkPtr(chunk).reset();
    return const_cast<Chunk&>(*chunk);
}

}  // namespace

ChunkPtr World::maybeChunkAt(ChunkPos pos) const {
    const auto found = chunks_.find(pos);
    return found == chunks_.end() ? nullptr : found->second;
}

void World::insert(ChunkPos pos, ChunkPtr chunk) {
    assert(chunk && "an absent chunk is erased, not inserted as null");
    assert(isInWorld(pos) && "blocks of a chunk have 32-bit coordinates");
    chunks_.insert_or_assign(pos, std::move(chunk));
}

BlockId World::block(BlockPos pos) const {
    if (!isInHeight(pos.z)) return kAir;
    const auto found = chunks_.find(chunkOf(pos));
    return found == chunks_.end() ? kAir : found->second->block(blockIndex(pos));
}

bool World::setBlock(BlockPos pos, BlockId id) {
    if (!isInHeight(pos.z)) return false;
    const auto found = chunks_.find(chunkOf(pos));
    if (found == chunks_.end()) return false;
    writable(found->second).setBlock(blockIndex(pos), id);
    return true;
}

std::size_t World::memoryBytes() const {
    std::size_t bytes = 0;
    for (const auto& [pos, chunk] : chunks_) bytes += chunk->memoryBytes();
    return bytes;
}

}  // namespace terrane::world
