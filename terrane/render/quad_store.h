// The quads of all visible chunks in one GPU buffer: one binding and one draw call a draw bucket, however
// many chunks there are. Used by the renderer on the context's thread.
//
// Everything is written and copied by commands in the stream of the context, so a frame sees a mesh section's
// quads as they were or as they are, never a mixture, and nothing waits for the GPU. A chunk's mesh sections
// lie together until an edit gives one of them another place.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/gpu/buffer.h"
#include "terrane/gpu/buffer_texture.h"
#include "terrane/gpu/range_allocator.h"
#include "terrane/mesh/remesh.h"
#include "terrane/world/coords.h"

namespace terrane::render {

// Of a chunk the mesh sections, lowest first. Their ranges count in the buffer.
using ChunkMeshSections = std::vector<mesh::MeshSection>;

class QuadStore {
  public:
    // `maxQuads`: the buffer grows no further; as many as a shader can reach where 0.
    explicit QuadStore(std::uint32_t maxQuads = 0);

    // Replaces the quads of these mesh sections; of others `mesh` has none. The buffer doubles when it is
    // full: its contents are copied on the GPU. False where it may not grow any more: the mesh sections then
    // have no quads, since the old ones are wrong.
    bool set(world::ChunkPos pos, const mesh::ChunkMesh& mesh,
             mesh::MeshSectionSet meshSections = mesh::kAllMeshSections);
    // The same, but for the quads: a shader writes them to where meshSectionsOf() says, before the next
    // frame.
    bool reserve(world::ChunkPos pos, std::span<const mesh::MeshSection> meshes,
                 mesh::MeshSectionSet meshSections = mesh::kAllMeshSections);
    void remove(world::ChunkPos pos);

    // Chunks that have quads.
    const std::unordered_map<world::ChunkPos, ChunkMeshSections, world::ChunkPosHash>& chunks() const {
        return chunks_;
    }
    // Empty where the chunk has no quads.
    std::span<const mesh::MeshSection> meshSectionsOf(world::ChunkPos pos) const;
    const gpu::Buffer& buffer() const { return buffer_; }
    const gpu::BufferTexture& texels() const { return texels_; }  // of the buffer, a quad each
    std::size_t usedBytes() const;
    std::uint64_t uploadedBytes() const { return uploadedBytes_; }  // by set(), since the beginning
    const gpu::RangeAllocator& ranges() const { return ranges_; }

  private:
    void free(ChunkMeshSections& chunk, mesh::MeshSectionSet meshSections);
    std::optional<std::uint32_t> allocate(std::uint32_t count);
    bool grow(std::uint32_t count);

    std::uint32_t maxQuads_;
    gpu::Buffer buffer_;
    gpu::BufferTexture texels_;
    gpu::RangeAllocator ranges_;
    std::unordered_map<world::ChunkPos, ChunkMeshSections, world::ChunkPosHash> chunks_;
    std::uint64_t uploadedBytes_ = 0;
};

}  // namespace terrane::render
