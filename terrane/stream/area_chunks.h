// Provides the chunks of an area for commands, from the store or the generator.
#pragma once

#include <span>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/gen/generator.h"
#include "terrane/store/chunk_store.h"

namespace terrane::stream {

// Returns the chunks in the order of `positions`; chunks outside the world are empty. `save` may be null.
base::Result<std::vector<world::Chunk>> chunksAt(std::span<const world::ChunkPos> positions,
                                                 store::ReadableStore* save, const gen::Generator& generator,
                                                 base::JobSystem& jobs);

}  // namespace terrane::stream
