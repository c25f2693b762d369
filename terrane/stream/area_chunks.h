// Chunks of an area for commands: loaded from the store, else generated.
#pragma once

#include <span>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/gen/generator.h"
#include "terrane/store/chunk_store.h"

namespace terrane::stream {

// In the order of `positions`; empty chunks outside the world. `save` may be null.
base::Result<std::vector<world::Chunk>> chunksAt(std::span<const world::ChunkPos> positions,
                                                 store::ReadableStore* save, const gen::Generator& generator,
                                                 base::JobSystem& jobs);

}  // namespace terrane::stream
