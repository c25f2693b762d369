// Generates batches of chunks on the back end that was asked for: worker threads or the GPU. The blocks are
// the same.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "apps/terrane/backend.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/chunk.h"

namespace terrane::app {

class BatchGenerator {
  public:
    virtual ~BatchGenerator() = default;
    // Fills chunks[k] with the chunk at positions[k].
    virtual base::Result<void> generate(std::span<const world::ChunkPos> positions,
                                        std::span<world::Chunk> chunks) = 0;
    virtual std::string backend() const = 0;  // "cpu" or "gpu"
};

base::Result<std::unique_ptr<BatchGenerator>> makeBatchGenerator(const WorldOptions& options, Backend backend,
                                                                 const world::BlockRegistry& blocks);

}  // namespace terrane::app
