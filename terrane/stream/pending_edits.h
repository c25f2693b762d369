// Edits whose light is not found yet: each block once, as it was before the first of its edits.
#pragma once

#include <unordered_map>
#include <vector>

#include "terrane/world/block_edit.h"

namespace terrane::stream {

struct PendingEdits {
    std::vector<world::BlockEdit> edits;
    // A bit a block, 8 KB for each edited chunk: a table of blocks would leave the caches in large fills.
    std::unordered_map<world::ChunkPos, std::vector<bool>, world::ChunkPosHash> isKnown;

    void add(const world::BlockEdit& edit) {
        std::vector<bool>& known = isKnown[world::chunkOf(edit.pos)];
        if (known.empty()) known.resize(world::kBlocksPerChunk);
        auto isThere = known[world::blockIndex(edit.pos)];
        if (!isThere) edits.push_back(edit);
        isThere = true;
    }
};

}  // namespace terrane::stream
