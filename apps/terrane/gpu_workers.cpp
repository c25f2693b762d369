#include "apps/terrane/gpu_workers.h"

#include "apps/terrane/content.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen_gpu/gpu_generator.h"
#include "terrane/light_gpu/gpu_batch_lighter.h"

namespace terrane::app {

base::Result<GpuWorkers> makeGpuWorkers(Backend backend, const WorldOptions& options,
                                        const world::BlockRegistry& blocks, const light::LightTable& lights) {
    if (!usesGpu(backend)) return GpuWorkers{};
    const gpu::ShaderLoader shaders = makeShaderLoader("");
    auto graph = gen::makeGenerator(options.generator, blocks);
    if (!graph) return tl::unexpected(graph.error());
    auto generator = gen_gpu::GpuGenerator::create(shaders, *graph, options.seed);
    if (!generator) return tl::unexpected(generator.error());
    auto lighter = light_gpu::GpuBatchLighter::create(shaders, lights);
    if (!lighter) return tl::unexpected(lighter.error());
    return GpuWorkers{std::make_unique<gen_gpu::GpuGenerator>(std::move(*generator)),
                      std::make_unique<light_gpu::GpuBatchLighter>(std::move(*lighter))};
}

}  // namespace terrane::app
