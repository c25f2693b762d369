// What takes work of a world's pipeline from its threads to the graphics card.
#pragma once

#include <memory>

#include "apps/terrane/backend.h"
#include "terrane/gen/batch_generator.h"
#include "terrane/light/batch_lighter.h"

namespace terrane::app {

// Null where the CPU does the work.
struct GpuWorkers {
    std::unique_ptr<gen::BatchGenerator> generator;
    std::unique_ptr<light::BatchLighter> lighter;
};

// In the current context, which outlives them, if `backend` chooses the GPU there. `lights` outlives them
// too.
base::Result<GpuWorkers> makeGpuWorkers(Backend backend, const WorldOptions& options,
                                        const world::BlockRegistry& blocks, const light::LightTable& lights);

}  // namespace terrane::app
