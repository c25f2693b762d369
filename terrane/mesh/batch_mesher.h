// Meshes many chunks. Back ends: the CPU here, compute shaders in terrane/mesh_gpu. They give the same quads
// and ranges; the order of quads within a range differs between back ends.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "terrane/mesh/chunk_mesher.h"

namespace terrane::mesh {

class BatchMesher {
  public:
    virtual ~BatchMesher() = default;

    // Returns meshes in the order of `chunks`, which have the same registry and options.
    virtual std::vector<ChunkMesh> mesh(std::span<const MeshInput> chunks) = 0;
    virtual std::string_view backend() const = 0;  // "cpu" or "gpu"
};

// Used on one thread, any.
std::unique_ptr<BatchMesher> makeCpuMesher();

}  // namespace terrane::mesh
