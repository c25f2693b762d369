// GpuMesher behind the interface that both back ends have: the quads are read back. For files, tests and
// benchmarks; drawing uses quads that stay on the GPU. Used on the context's thread.
#pragma once

#include "terrane/mesh/batch_mesher.h"
#include "terrane/mesh_gpu/gpu_mesher.h"

namespace terrane::mesh_gpu {

class GpuBatchMesher : public mesh::BatchMesher {
  public:
    explicit GpuBatchMesher(GpuMesher mesher) : mesher_(std::move(mesher)) {}

    // Takes any number of chunks, in parts. Waits for the GPU.
    std::vector<mesh::ChunkMesh> mesh(std::span<const mesh::MeshInput> chunks) override;
    std::string_view backend() const override { return "gpu"; }

  private:
    void meshPart(std::span<const mesh::MeshInput> chunks, std::vector<mesh::ChunkMesh>& meshes);

    GpuMesher mesher_;
    gpu::Buffer quads_;  // grows to the largest part
};

}  // namespace terrane::mesh_gpu
