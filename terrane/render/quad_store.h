// The quads of all visible chunks in one GPU buffer. Used by the renderer on the context's thread.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "terrane/gpu/buffer.h"
#include "terrane/gpu/range_allocator.h"
#include "terrane/mesh/chunk_mesh.h"
#include "terrane/world/coords.h"

namespace terrane::render {

struct ChunkQuads {
    std::uint32_t first = 0, count = 0;     // in the buffer
    std::vector<mesh::RegionMesh> regions;  // ranges count from `first`
};

class QuadStore {
  public:
    QuadStore();

    // Replaces what the chunk had. The buffer doubles when it is full: its contents are copied on the GPU.
    void set(world::ChunkPos pos, const mesh::ChunkMesh& mesh);
    void remove(world::ChunkPos pos);

    const std::unordered_map<world::ChunkPos, ChunkQuads, world::ChunkPosHash>& chunks() const {
        return chunks_;
    }
    const gpu::Buffer& buffer() const { return buffer_; }
    std::size_t usedBytes() const;

  private:
    std::uint32_t allocate(std::uint32_t count);

    gpu::Buffer buffer_;
    gpu::RangeAllocator ranges_;
    std::unordered_map<world::ChunkPos, ChunkQuads, world::ChunkPosHash> chunks_;
};

}  // namespace terrane::render
