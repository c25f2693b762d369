// A set of blocks: a bit for each block, 8 KB for each chunk that has some. A hash set of a hundred thousand
// blocks would not fit the caches. Plain value.
#pragma once

#include <unordered_map>
#include <vector>

#include "terrane/world/coords.h"

namespace terrane::world {

class BlockSet {
  public:
    // Whether the block is new in the set. `pos` is in the world's height.
    bool insert(BlockPos pos) {
        std::vector<bool>& blocks = chunks_[chunkOf(pos)];
        if (blocks.empty()) blocks.resize(kBlocksPerChunk);
        auto bit = blocks[blockIndex(pos)];
        const bool isNew = !bit;
        bit = true;
        return isNew;
    }
    bool contains(BlockPos pos) const {
        if (!isInHeight(pos.z)) return false;
        const auto found = chunks_.find(chunkOf(pos));
        return found != chunks_.end() && found->second[blockIndex(pos)];
    }

  private:
    std::unordered_map<ChunkPos, std::vector<bool>, ChunkPosHash> chunks_;
};

}  // namespace terrane::world
