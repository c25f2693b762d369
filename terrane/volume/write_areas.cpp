#include "terrane/volume/write_areas.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>

#include "terrane/volume/chunk_arrays.h"
#include "terrane/volume/read_chunks.h"

namespace terrane::volume {

base::Result<std::int64_t> writeArea(OpenedWorld& world, const BlockArea& area,
                                     std::span<const world::BlockId> blocks, const GoesOn& goesOn) {
    const std::size_t types = world.blocks().types().size();
    const auto unknown = std::ranges::find_if(blocks, [&](world::BlockId id) { return id >= types; });
    if (unknown != blocks.end())
        return base::fail(base::ErrorCode::BadInput, "block id {}: this world has 0 to {}", *unknown,
                          types - 1);
    const std::lock_guard lock(world.editMutex());
    const world::ChunkArea chunks = chunksOver(area);
    std::atomic<std::int64_t> changed{0};
    TERRANE_TRY(readChunks(world, chunksOf(chunks), goesOn, [&](std::int64_t number, world::Chunk&& chunk) {
        const world::ChunkPos pos = chunkIn(chunks, number);
        const std::int64_t count = writeBlocks(blocks, area, pos, chunk);
        if (count == 0) return;
        changed += count;
        world.store().save(pos, std::make_shared<const world::Chunk>(std::move(chunk)),
                           store::Provenance::Edited);
        world.noteEdited(std::span(&pos, 1));
    }));
    return changed.load();
}

}  // namespace terrane::volume
