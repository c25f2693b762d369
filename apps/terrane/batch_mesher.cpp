#include "apps/terrane/batch_mesher.h"

#include "apps/terrane/content.h"
#include "terrane/mesh_gpu/gpu_batch_mesher.h"

namespace terrane::app {
namespace {

class MesherWithContext : public mesh::BatchMesher {
  public:
    MesherWithContext(gpu::HeadlessContext context, mesh_gpu::GpuMesher mesher)
        : context_(std::move(context)), mesher_(std::move(mesher)) {}

    std::vector<mesh::ChunkMesh> mesh(std::span<const mesh::MeshInput> chunks) override {
        return mesher_.mesh(chunks);
    }
    std::string_view backend() const override { return mesher_.backend(); }

  private:
    gpu::HeadlessContext context_;  // outlives what lives in it
    mesh_gpu::GpuBatchMesher mesher_;
};

}  // namespace

base::Result<std::unique_ptr<mesh::BatchMesher>> makeBatchMesher(Backend backend,
                                                                 const world::BlockRegistry& blocks) {
    auto context = openBackend(backend);
    if (!context) return tl::unexpected(context.error());
    if (!*context) return mesh::makeCpuMesher();
    auto mesher = mesh_gpu::GpuMesher::create(makeShaderLoader(""), blocks);
    if (!mesher) return tl::unexpected(mesher.error());
    return std::make_unique<MesherWithContext>(std::move(**context), std::move(*mesher));
}

}  // namespace terrane::app
