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

bool World::setBlock(BlockPos pos, BlockId id) {
    Chunk* chunk = findWritable(pos);
    if (chunk) chunk->setBlock(blockIndex(pos), id);
    return chunk != nullptr;
}

std::uint16_t World::smallData(BlockPos pos) const {
    const Chunk* chunk = findChunk(pos);
    return chunk ? chunk->smallData(blockIndex(pos)) : std::uint16_t{0};
}

bool World::setSmallData(BlockPos pos, std::uint16_t value) {
    Chunk* chunk = findWritable(pos);
    if (chunk) chunk->setSmallData(blockIndex(pos), value);
    return chunk != nullptr;
}

const LargeData* World::largeData(BlockPos pos) const {
    const Chunk* chunk = findChunk(pos);
    return chunk ? chunk->largeData(blockIndex(pos)) : nullptr;
}

bool World::setLargeData(BlockPos pos, LargeData data) {
    Chunk* chunk = findWritable(pos);
    if (chunk) chunk->setLargeData(blockIndex(pos), std::move(data));
    return chunk != nullptr;
}

bool World::clearLargeData(BlockPos pos) {
    Chunk* chunk = findWritable(pos);
    if (chunk) chunk->clearLargeData(blockIndex(pos));
    return chunk != nullptr;
}

std::size_t World::memoryBytes() const {
    std::size_t bytes = 0;
    for (const auto& [pos, chunk] : chunks_) bytes += chunk->memoryBytes();
    return bytes;
}

}  // namespace terrane::world
