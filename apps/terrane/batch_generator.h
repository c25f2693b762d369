// Chunks of a world on the back end that was asked for. The blocks are the same.
#pragma once

#include "apps/terrane/backend.h"
#include "terrane/gen/batch_generator.h"
#include "terrane/world/block_registry.h"

namespace terrane::app {

base::Result<OnBackend<gen::BatchGenerator>> makeBatchGenerator(const WorldOptions& options, Backend backend,
                                                                const world::BlockRegistry& blocks);

}  // namespace terrane::app
