// Generation and light on the GPU for a session: back ends that its pipeline uses instead of workers. It is
// used on the context's thread.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "terrane/base/result.h"
#include "terrane/game/session.h"
#include "terrane/gen/batch_generator.h"
#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/light/batch_lighter.h"

namespace terrane::view {

// Returns the GPU memory budget: `mebibytes` if given, else half of the free memory that the driver reports,
// at least 256 MiB, or 2 GiB if it reports none. The other half is for other programs, and for generation and
// light on the GPU.
std::size_t gpuMemoryBudget(const gpu::DeviceInfo& device, std::optional<int> mebibytes);

// The memory of the chunks on screen, and its limit.
struct MemoryNeed {
    std::size_t chunks = 0;
    std::size_t bytes = 0, limitBytes = 0;
};

constexpr int kMinViewDistance = 1;

// Returns the view distance to use after memory ran out: the largest smaller one whose chunks take at most
// 15/16 of the limit, if each takes the mean of those on screen. A sixteenth remains for denser terrain. The
// chunks include one ring around the view, which stays while the camera moves. At least kMinViewDistance;
// `distance` itself if that is no larger.
int fittingViewDistance(const MemoryNeed& need, int distance);

std::string shortViewNotice(int requested, int reached, std::size_t budgetBytes);

// The back ends. They outlive the session that uses them and are destroyed before the context.
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

// Both for the world of `parts`. `generators` include the world's. The OpenGL context is current. Always uses
// the built-in shaders.
base::Result<std::unique_ptr<GpuBackEnds>> useGpuBackEnds(game::SessionParts& parts,
                                                          const gen::GeneratorCatalogue& generators);

// Makes the session created from `parts` generate, light and mesh on the GPU.
void useBackEnds(game::SessionParts& parts, const GpuBackEnds& backEnds);

}  // namespace terrane::view
