// Rivers and lakes near the tiles of a dispatch as storage buffers (shared/drainage.h): made on the CPU from
// the maps that it uses itself. On the context's thread.
#pragma once

#include <span>
#include <vector>

#include "terrane/gen/drainage_maps.h"
#include "terrane/gpu/buffer.h"
#include "terrane/world/coords.h"

namespace terrane::gen_gpu {

// Whether a pass reads drainage maps.
bool readsDrainage(const gen::GeneratorGraph& generator, const gen::PassGraph& pass);

struct DrainageBuffers {
    gpu::Buffer lists, data;
};

// For tile jobs in the order of `chunks`: 48 bytes a segment near each, 16 a lake.
DrainageBuffers uploadDrainage(gen::DrainageMaps& maps, std::size_t mapCount,
                               std::span<const world::ChunkPos> chunks);

}  // namespace terrane::gen_gpu
