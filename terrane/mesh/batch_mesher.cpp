#include "terrane/mesh/batch_mesher.h"

namespace terrane::mesh {
namespace {

class CpuMesher : public BatchMesher {
  public:
    std::vector<ChunkMesh> mesh(std::span<const MeshInput> chunks) override {
        std::vector<ChunkMesh> meshes;
        meshes.reserve(chunks.size());
        for (const MeshInput& chunk : chunks) meshes.push_back(meshChunk(chunk, scratch_));
        return meshes;
    }
    std::string_view backend() const override { return "cpu"; }

  private:
    MeshScratch scratch_;
};

}  // namespace

std::unique_ptr<BatchMesher> makeCpuMesher() {
    return std::make_unique<CpuMesher>();
}

}  // namespace terrane::mesh
