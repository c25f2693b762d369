#include "terrane/view/gpu_back_ends.h"

#include "terrane/gen_gpu/gpu_generator.h"
#include "terrane/light_gpu/gpu_batch_lighter.h"

namespace terrane::view {

base::Result<std::unique_ptr<GpuBackEnds>> makeGpuBackEnds(const gpu::ShaderLoader& shaders,
                                                           const gen::GeneratorGraph& graph,
                                                           std::uint64_t seed,
                                                           const world::BlockRegistry& blocks) {
    auto made = std::make_unique<GpuBackEnds>(GpuBackEnds{light::LightTable(blocks), nullptr, nullptr});
    auto generator = TERRANE_TRY(gen_gpu::GpuGenerator::create(shaders, graph, seed));
    made->generator = std::make_unique<gen_gpu::GpuGenerator>(std::move(generator));
    auto lighter = TERRANE_TRY(light_gpu::GpuBatchLighter::create(shaders, made->lights));
    made->lighter = std::make_unique<light_gpu::GpuBatchLighter>(std::move(lighter));
    return made;
}

void useBackEnds(game::SessionParts& parts, const GpuBackEnds& backEnds) {
    parts.batchGenerator = backEnds.generator.get();
    parts.batchLighter = backEnds.lighter.get();
    parts.meshing = stream::MeshPolicy::Caller;
}

}  // namespace terrane::view
