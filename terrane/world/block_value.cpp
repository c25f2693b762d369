#include "terrane/world/block_value.h"

#include <algorithm>
#include <tuple>

#include "terrane/world/world.h"

namespace terrane::world {

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
