// Generation and light on the GPU for a session: back ends that its pipeline uses instead of workers. Used on
// the context's thread.
#pragma once

#include <memory>

#include "terrane/base/result.h"
#include "terrane/game/session.h"
#include "terrane/gen/batch_generator.h"
#include "terrane/gen/generator_graph.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/light/batch_lighter.h"

namespace terrane::view {

// Outlives the session that uses it; destroyed before its context.
struct GpuBackEnds {
    light::LightTable lights;
    std::unique_ptr<gen::BatchGenerator> generator;
    std::unique_ptr<light::BatchLighter> lighter;
};

// Makes the back ends for the world that `graph` and `seed` generate. The session's chunks are meshed on the
// GPU too: give its WorldView a mesher. GPU memory: see gen_gpu/gpu_generator.h and
// light_gpu/gpu_batch_lighter.h.
base::Result<std::unique_ptr<GpuBackEnds>> makeGpuBackEnds(const gpu::ShaderLoader& shaders,
                                                           const gen::GeneratorGraph& graph,
                                                           std::uint64_t seed,
                                                           const world::BlockRegistry& blocks);

// Makes the session created from `parts` generate, light and mesh on the GPU.
void useBackEnds(game::SessionParts& parts, const GpuBackEnds& backEnds);

}  // namespace terrane::view
