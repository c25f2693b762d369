#include "apps/terrane/batch_mesher.h"

#include "apps/terrane/content.h"
#include "terrane/mesh_gpu/gpu_batch_mesher.h"

namespace terrane::app {

base::Result<OnBackend<mesh::BatchMesher>> makeBatchMesher(Backend backend,
                                                           const world::BlockRegistry& blocks) {
    using Made = OnBackend<mesh::BatchMesher>;
    auto context = openBackend(backend);
    if (!context) return tl::unexpected(context.error());
    if (!*context) return Made{std::nullopt, mesh::makeCpuMesher()};
    auto mesher = mesh_gpu::GpuMesher::create(makeShaderLoader(""), blocks);
    if (!mesher) return tl::unexpected(mesher.error());
    return Made{std::move(*context), std::make_unique<mesh_gpu::GpuBatchMesher>(std::move(*mesher))};
}

}  // namespace terrane::app
