// The mesher as compute shaders: quads go straight into the buffer that is drawn from. They are those of
// mesh::meshChunk, in another order within their ranges. Used on the context's thread.
//
// A batch is counted first; the counts (104 bytes a mesh section) come back through a copy that nothing waits
// for, the host makes room for each mesh section, and a second run writes the quads there. What it costs, per
// section in which something may be seen, twice: 4,096 block indices read once (512 to 8,192 bytes) and 1,536
// of its neighbors, 256 invocations with 20 bit operations a side. Then greedy merging takes 96 planes, one
// invocation each, by two to three reads of shared memory a row and rectangle; the other methods take two to
// eight steps of 1,536 rows or columns. 29 KB of shared memory a work group (32 are sure): the 228 KB of a
// large GPU hold seven of the eight that its 2,048 invocations make, the 64 KB of a small one two. Planes of
// nothing end at once; in a warp of 32 planes the one with most rectangles decides.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gpu/buffer.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/shared/mesher.h"

namespace terrane::mesh_gpu {

using shared::kNoPlace;

class GpuMesher {
  public:
    static constexpr std::size_t kMaxChunks = 256;  // a batch

    // Memory on the GPU beside what batches upload (9 KB a chunk): 2.5 MB for counts and
    // places of 8,192 mesh sections.
    static base::Result<GpuMesher> create(const gpu::ShaderLoader& shaders,
                                          const world::BlockRegistry& blocks);
    GpuMesher(GpuMesher&&) noexcept;
    GpuMesher& operator=(GpuMesher&&) noexcept;
    ~GpuMesher();

    // Starts to count the quads of up to kMaxChunks chunks with the same options. What was counted before is
    // forgotten. The chunks are not needed any more afterwards.
    void count(std::span<const mesh::MeshInput> chunks);
    // Does not wait.
    bool isCounted() const;
    // Of all chunks, the lowest mesh section first; waits where isCounted() does not hold yet. Ranges count
    // from the mesh section's first quad.
    std::vector<mesh::MeshSection> meshSections() const;
    // Of the GPU for count(), once isCounted() holds.
    double countMilliseconds() const;
    // Of all buffers, with those of the batch at hand.
    std::size_t gpuBytes() const;
    // Writes the quads of each mesh section from `firstQuads` on, in the order of meshSections(), or leaves
    // them out (kNoPlace). Once for each buffer that mesh sections of the batch lie in. Shaders that run
    // later see the quads.
    void write(std::span<const std::uint32_t> firstQuads, const gpu::Buffer& quads);

  private:
    struct Impl;
    explicit GpuMesher(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::mesh_gpu
