#include "terrane/world/world.h"

#include <memory>
#include <utility>

#include "terrane/base/require.h"

namespace terrane::world {
namespace {

// The chunk to write to: itself if nobody else holds it, else a copy that replaces it.
Chunk& writable(std::shared_ptr<Chunk>& chunk) {
    if (chunk.use_count() != 1) {
        chunk = std::make_shared<Chunk>(*chunk);
        return *chunk;
    }
    // use_count() does not order memory accesses: a worker's last reads of the chunk could overlap the
    // following write. Taking and dropping a reference is an acquire-release operation on the count, after
    // the worker's.
    ChunkPtr(chunk).reset();
    return *chunk;
}

}  // namespace

ChunkPtr World::maybeChunkAt(ChunkPos pos) const {
    const auto found = chunks_.find(pos);
    return found == chunks_.end() ? nullptr : found->second;
}

void World::insert(ChunkPos pos, std::shared_ptr<Chunk> chunk) {
    base::require(chunk != nullptr, "World::insert: null; erase() removes a chunk");
    base::require(isInWorld(pos), "World::insert: the chunk is outside the world");
    chunks_.insert_or_assign(pos, std::move(chunk));
}

const Chunk* World::findChunk(BlockPos pos) const {
    if (!isInHeight(pos.z)) return nullptr;
    const auto found = chunks_.find(chunkOf(pos));
    return found == chunks_.end() ? nullptr : found->second.get();
}

Chunk* World::findWritable(BlockPos pos) {
    if (!isInHeight(pos.z)) return nullptr;
    const auto found = chunks_.find(chunkOf(pos));
    return found == chunks_.end() ? nullptr : &writable(found->second);
}

BlockId World::block(BlockPos pos) const {
    const Chunk* chunk = findChunk(pos);
    return chunk ? chunk->block(blockIndex(pos)) : kAir;
}

std::uint16_t World::blockState(BlockPos pos) const {
    const Chunk* chunk = findChunk(pos);
    return chunk ? chunk->blockState(blockIndex(pos)) : std::uint16_t{0};
}

const BlockEntityData* World::blockEntityData(BlockPos pos) const {
    const Chunk* chunk = findChunk(pos);
    return chunk ? chunk->blockEntityData(blockIndex(pos)) : nullptr;
}

std::size_t World::memoryBytes() const {
    std::size_t bytes = 0;
    for (const auto& [pos, chunk] : chunks_) bytes += chunk->memoryBytes();
    return bytes;
}

}  // namespace terrane::world
