#include "terrane/world/world.h"

#include <algorithm>
#include <memory>
#include <tuple>
#include <utility>

#include "terrane/base/result.h"

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
    base::require(chunk->heights() == heights_, "World::insert: the chunk has other heights than the world");
    chunks_.insert_or_assign(pos, std::move(chunk));
}

void World::makeDeeper(ChunkPos pos, const Chunk& deeper) {
    const auto found = chunks_.find(pos);
    base::require(found != chunks_.end(), "World::makeDeeper: the chunk is not loaded");
    writable(found->second).makeDeeper(deeper);
}

bool World::isMade(BlockPos pos) const {
    const Chunk* chunk = findChunk(pos);
    return chunk && chunk->isMade(sectionOf(blockIndex(pos)));
}

const Chunk* World::findChunk(BlockPos pos) const {
    if (!heights_.contains(pos.z)) return nullptr;
    const auto found = chunks_.find(chunkOf(pos));
    return found == chunks_.end() ? nullptr : found->second.get();
}

Chunk* World::findWritable(BlockPos pos) {
    if (!heights_.contains(pos.z)) return nullptr;
    const auto found = chunks_.find(chunkOf(pos));
    const bool isMade = found != chunks_.end() && found->second->isMade(sectionOf(blockIndex(pos)));
    return isMade ? &writable(found->second) : nullptr;
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

bool operator==(const BlockValue& a, const BlockValue& b) {
    if (a.id != b.id || a.state != b.state || !a.data != !b.data) return false;
    return a.data == b.data || *a.data == *b.data;
}

BlockValue blockValue(const World& world, BlockPos pos) {
    const Chunk* chunk = world.findChunk(pos);
    if (!chunk) return {};
    const BlockIndex at = blockIndex(pos);
    return {chunk->block(at), chunk->blockState(at), chunk->sharedBlockEntityData(at)};
}

std::vector<PlacedBlock> BlockRecorder::take() {
    const auto place = [](const PlacedBlock& note) {
        const ChunkPos chunk = chunkOf(note.pos);
        return std::tuple(chunk.y, chunk.x, blockIndex(note.pos));
    };
    const auto isBefore = [&](const PlacedBlock& a, const PlacedBlock& b) { return place(a) < place(b); };
    if (!std::is_sorted(notes_.begin(), notes_.end(), isBefore))
        std::stable_sort(notes_.begin(), notes_.end(), isBefore);
    const auto isSame = [](const PlacedBlock& a, const PlacedBlock& b) { return a.pos == b.pos; };
    notes_.erase(std::unique(notes_.begin(), notes_.end(), isSame), notes_.end());
    return std::exchange(notes_, {});
}

}  // namespace terrane::world
