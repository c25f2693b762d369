#include "terrane/map/edited_positions.h"

#include "terrane/base/require.h"

namespace terrane::map {

using world::ChunkPos;

bool EditedPositions::add(ChunkPos chunk) {
    base::require(chunk.level == 0, "EditedPositions::add: tiles follow from their chunks");
    for (auto& level : positions_) {
        if (!level.insert(chunk).second) return chunk.level > 0;
        chunk = {chunk.x >> 1, chunk.y >> 1, static_cast<std::uint8_t>(chunk.level + 1)};
    }
    return true;
}

bool EditedPositions::contains(ChunkPos chunk) const {
    return chunk.level <= world::kMaxLevel && positions_[chunk.level].contains(chunk);
}

std::vector<EditedChunk> EditedPositions::among(std::span<const ChunkPos> chunks) const {
    std::vector<EditedChunk> edited;
    for (const ChunkPos chunk : chunks)
        if (contains(chunk)) edited.push_back({chunk, nullptr});
    return edited;
}

}  // namespace terrane::map
