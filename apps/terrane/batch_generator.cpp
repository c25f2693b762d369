#include "apps/terrane/batch_generator.h"

#include "apps/terrane/content.h"
#include "apps/terrane/world_session.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen_gpu/gpu_generator.h"

namespace terrane::app {

base::Result<OnBackend<gen::BatchGenerator>> makeBatchGenerator(const WorldOptions& options, Backend backend,
                                                                const world::BlockRegistry& blocks) {
    const auto makeCpu = [&]() -> base::Result<std::unique_ptr<gen::BatchGenerator>> {
        auto generator = makeGenerator(options, blocks);
        if (!generator) return tl::unexpected(generator.error());
        return gen::makeCpuGenerator(std::move(*generator), threadCount(options));
    };
    const auto makeGpu = [&]() -> base::Result<gen_gpu::GpuGenerator> {
        auto graph = gen::makeGenerator(options.effectiveGenerator(), blocks);
        if (!graph) return tl::unexpected(graph.error());
        return gen_gpu::GpuGenerator::create(makeShaderLoader(""), *graph, options.effectiveSeed());
    };
    return makeOnBackend<gen::BatchGenerator>(backend, makeCpu, makeGpu);
}

}  // namespace terrane::app
