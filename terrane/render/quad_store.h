// The quads of all visible chunks in one GPU buffer: one binding and one draw call a face context, however
// many chunks there are. Used by the renderer on the context's thread.
//
// Everything is written and copied by commands in the stream of the context, so a frame sees a chunk's quads
// as they were or as they are, never a mixture, and nothing waits for the GPU.
#pragma once

#include <cstdint>
#include <optional>
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
    // `maxQuads`: the buffer grows no further; as many as a shader can reach where 0.
    explicit QuadStore(std::uint32_t maxQuads = 0);

    // Replaces what the chunk had. The buffer doubles when it is full: its contents are copied on the GPU.
    // False where it may not grow any more: the chunk then has no quads, since the old ones are wrong.
    bool set(world::ChunkPos pos, const mesh::ChunkMesh& mesh);
    void remove(world::ChunkPos pos);

    const std::unordered_map<world::ChunkPos, ChunkQuads, world::ChunkPosHash>& chunks() const {
        return chunks_;
    }
    const gpu::Buffer& buffer() const { return buffer_; }
    std::size_t usedBytes() const;
    const gpu::RangeAllocator& ranges() const { return ranges_; }

  private:
    std::optional<std::uint32_t> allocate(std::uint32_t count);
    bool grow(std::uint32_t count);

    std::uint32_t maxQuads_;
    gpu::Buffer buffer_;
    gpu::RangeAllocator ranges_;
    std::unordered_map<world::ChunkPos, ChunkQuads, world::ChunkPosHash> chunks_;
};

}  // namespace terrane::render
