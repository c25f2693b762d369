// The mesher in compute shaders: quads go straight into the buffer that is drawn from. They are those of
// mesh::meshChunk, in another order within their ranges. It is used on the context's thread.
//
// A batch is counted first; the counts (104 bytes a mesh section) come back through a copy that nothing waits
// for, the host makes room for each mesh section, and a second run writes the quads there. Cost of each run,
// per section with faces that may be visible: 4,096 block indices read once (512 to 8,192 bytes) and 1,536 of
// its neighbors, 256 invocations with 20 bit operations a side. Then greedy merging takes 96 planes, one
// invocation each, with two to three reads of shared memory a row and rectangle; the other methods take two
// to eight passes over 1,536 rows or columns. A work group has 29 KB of shared memory (OpenGL guarantees 32
// KB): the 228 KB of a large GPU hold seven of the eight that fill its 2,048 invocations, the 64 KB of a
// small one two. Empty planes end at once; a warp of 32 planes takes as long as the plane with most
// rectangles.
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

// Mesh sections of a batch, of one chunk after the other.
struct CountedSections {
    std::vector<mesh::MeshSection> all;
    std::vector<std::size_t> chunkEnds;  // in `all`

    std::span<const mesh::MeshSection> ofChunk(std::size_t chunk) const {
        const std::size_t first = chunk == 0 ? 0 : chunkEnds[chunk - 1];
        return std::span(all).subspan(first, chunkEnds[chunk] - first);
    }
};

class GpuMesher {
  public:
    static constexpr std::size_t kMaxChunks = 256;  // a batch

    // Creates the mesher. Besides the uploads of batches (9 KB a chunk) it takes 300 bytes of GPU memory for
    // each mesh section of the largest batch, for counts and addresses: 2.5 MB for the first 8,192.
    static base::Result<GpuMesher> create(const gpu::ShaderLoader& shaders,
                                          const world::BlockRegistry& blocks);
    GpuMesher(GpuMesher&&) noexcept;
    GpuMesher& operator=(GpuMesher&&) noexcept;
    ~GpuMesher();

    // Starts to count the quads of up to kMaxChunks chunks with the same options. Previous counts are
    // discarded. The chunks are not needed afterwards.
    void count(std::span<const mesh::MeshInput> chunks);
    // Returns whether the counts are available, without waiting.
    bool isCounted() const;
    // Returns the mesh sections with quads of all chunks, the lowest of each first; waits until isCounted().
    // Ranges count from the mesh section's first quad.
    CountedSections meshSections() const;
    // Returns the GPU time of count(), once isCounted() is true.
    double countMilliseconds() const;
    // Returns the size of all buffers, including those of the current batch.
    std::size_t gpuBytes() const;
    // Writes the quads of each mesh section from `firstQuads` on, in the order of meshSections(), or leaves
    // them out (kNoPlace). Call it once for each buffer with mesh sections of the batch. Shaders that run
    // later see the quads.
    void write(std::span<const std::uint32_t> firstQuads, const gpu::Buffer& quads);

  private:
    struct Impl;
    explicit GpuMesher(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

// GpuMesher behind the interface that both back ends have: the quads are read back. For files, tests and
// benchmarks; drawing uses quads that stay on the GPU. It is used on the context's thread.
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
