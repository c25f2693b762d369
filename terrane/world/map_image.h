// A map of an area seen from above: each column's topmost block, shaded as relief, water by its depth. Of any
// level: a column is 2^level blocks wide. Any thread.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "terrane/base/image.h"
#include "terrane/base/job_system.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/chunk.h"
#include "terrane/world/coords.h"
#include "terrane/world/texture_source.h"
#include "terrane/world/tint.h"

namespace terrane::world {

// What is drawn: the area, and its chunks, asked for a row after the other.
struct MapSource {
    ChunkArea area;  // of chunks of the level
    std::uint8_t level = 0;
    std::function<base::Result<std::vector<Chunk>>(std::span<const ChunkPos>)> chunks;
    // The tint of a chunk's columns, from any thread; null where the generator has none.
    std::function<TintTile(ChunkPos)> tint = {};
};

// One pixel a column; y points up. `onRow` is called with the number of chunk rows done.
base::Result<base::Image> drawMap(const MapSource& source, const BlockRegistry& blocks,
                                  const TextureSource& textures, base::JobSystem& jobs,
                                  const std::function<void(std::size_t)>& onRow);

}  // namespace terrane::world
