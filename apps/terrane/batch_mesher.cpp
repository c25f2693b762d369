#include "apps/terrane/batch_mesher.h"

#include "apps/terrane/content.h"
#include "terrane/mesh_gpu/gpu_batch_mesher.h"

namespace terrane::app {

base::Result<OnBackend<mesh::BatchMesher>> makeBatchMesher(Backend backend,
                                                           const world::BlockRegistry& blocks) {
    const auto makeCpu = []() -> base::Result<std::unique_ptr<mesh::BatchMesher>> {
        return mesh::makeCpuMesher();
    };
    const auto makeGpu = [&]() -> base::Result<mesh_gpu::GpuBatchMesher> {
        auto mesher = mesh_gpu::GpuMesher::create(makeShaderLoader(""), blocks);
        if (!mesher) return tl::unexpected(mesher.error());
        return mesh_gpu::GpuBatchMesher(std::move(*mesher));
    };
    return makeOnBackend<mesh::BatchMesher>(backend, makeCpu, makeGpu);
}

}  // namespace terrane::app
