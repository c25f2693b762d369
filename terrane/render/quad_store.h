// The quads of all visible chunks in a few GPU buffers (arenas): one binding and one draw call for each arena
// and draw bucket, however many chunks there are. Used by the renderer on the context's thread.
//
// The first arena begins with 8 MiB (less in a small budget) and doubles up to 256 MiB, or to what a shader
// can reach where that is less (128 MiB in Mesa's software renderer: a landscape at view distance 55).
// Further arenas come after it without a copy. The quads of a mesh section lie in one arena. No growth takes
// the buffers past setMaxBytes(), with the copy that a doubling needs for a moment.
//
// Everything is written and copied by commands in the stream of the context, so a frame sees a mesh section's
// quads as they were or as they are, never a mixture, and nothing waits for the GPU. A chunk's mesh sections
// lie together until an edit gives one of them another place.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "terrane/gpu/arena_allocator.h"
#include "terrane/gpu/arena_buffers.h"
#include "terrane/gpu/buffer.h"
#include "terrane/gpu/buffer_texture.h"
#include "terrane/mesh/remesh.h"
#include "terrane/shared/mesh_section.h"
#include "terrane/world/coords.h"

namespace terrane::render {

// Of a chunk the mesh sections, lowest first. Their ranges are addresses: see gpu::ArenaAllocator.
using ChunkMeshSections = std::vector<mesh::MeshSection>;

struct QuadStoreSizes {
    std::uint32_t arenaQuads = 0;  // of an arena; 0: 256 MiB, or as many as a shader can reach
    std::uint32_t maxArenas = shared::kMaxArenas;
    std::uint32_t firstQuads =
        1u << 20;  // the first arena begins with 8 MiB, a landscape at view distance 16
};

class QuadStore {
  public:
    explicit QuadStore(const QuadStoreSizes& sizes = {});

    // The most that all buffers may take from now on. What they take already stays.
    void setMaxBytes(std::size_t bytes) { maxBytes_ = bytes; }

    // Replaces the quads of these mesh sections; of others `mesh` has none. Grows when the arenas are full.
    // False where they may not grow any more: the mesh sections then have no quads, since the old ones are
    // wrong.
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
    gpu::ArenaBuffers buffers() const;  // until the next change
    const gpu::BufferTexture& texels(std::size_t arena) const {
        return arenas_[arena].texels;
    }  // a quad each
    std::size_t usedBytes() const;
    std::size_t bufferBytes() const;  // of all arenas
    // The most that the buffers took at once since the last call, with copies.
    std::size_t takePeakBytes() { return std::max(std::exchange(peakBytes_, 0), bufferBytes()); }
    std::uint64_t uploadedBytes() const { return uploadedBytes_; }  // by set(), since the beginning
    const gpu::ArenaAllocator& ranges() const { return ranges_; }

  private:
    struct Arena {
        gpu::Buffer buffer;
        gpu::BufferTexture texels;
    };

    void free(ChunkMeshSections& chunk, mesh::MeshSectionSet meshSections);
    std::optional<std::uint32_t> allocate(std::uint32_t count);
    bool grow(std::uint32_t count);
    static Arena makeArena(std::uint32_t quads);

    gpu::ArenaAllocator ranges_;
    std::vector<Arena> arenas_;
    std::size_t maxBytes_ = SIZE_MAX, peakBytes_ = 0;
    std::unordered_map<world::ChunkPos, ChunkMeshSections, world::ChunkPosHash> chunks_;
    std::uint64_t uploadedBytes_ = 0;
};

}  // namespace terrane::render
