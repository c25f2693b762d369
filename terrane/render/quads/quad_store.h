// The quads of all visible chunks in a few GPU buffers (arenas): one binding and one draw call for each arena
// and draw bucket, whatever the number of chunks. The renderer uses it on the context's thread.
//
// The first arena begins with 8 MiB (less in a small budget), light included, and doubles up to 256 MiB, or
// to the limit that a shader can reach if that is less (128 MiB in Mesa's software renderer: a landscape at
// view distance 55). Further arenas are added without a copy. The quads of a mesh section are in one arena.
// No growth takes the buffers beyond setMaxBytes(), including the temporary copy of a doubling.
//
// All writes and copies are commands in the stream of the context, so a frame uses a mesh section's quads
// before or after a change, never a mixture, and nothing waits for the GPU. A chunk's mesh sections are
// contiguous until an edit moves one of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "terrane/gpu/arena_allocator.h"
#include "terrane/gpu/buffer.h"
#include "terrane/mesh/remesh.h"
#include "terrane/render/quads/draw_commands.h"
#include "terrane/shared/mesh_section.h"
#include "terrane/shared/quad.h"
#include "terrane/shared/quad_light.h"
#include "terrane/world/coords.h"

namespace terrane::render {

// Returns the size of the buffer that replaces `buffer`; 0 if it is large enough.
inline std::size_t grownBytes(const gpu::Buffer& buffer, std::size_t neededBytes) {
    return gpu::grownBytes(buffer.sizeBytes(), neededBytes);
}

// Returns the bytes of the buffer and of its replacement: both exist until the GPU has used the old one.
inline std::size_t bytesWhileGrowing(const gpu::Buffer& buffer, std::size_t neededBytes) {
    return buffer.sizeBytes() + grownBytes(buffer, neededBytes);
}

// The mesh sections of a chunk that have quads, lowest first. Their ranges are addresses: see
// gpu::ArenaAllocator.
using ChunkMeshSections = std::vector<mesh::MeshSection>;

// Returns the most commands that drawing all faces of each draw bucket takes. `ranges`: as in
// shared::MeshSectionRecord; quads that lie together.
using BucketCommands = std::array<std::uint32_t, shared::kDrawBuckets>;
BucketCommands mostCommands(std::span<const mesh::QuadRange, shared::kRangesPerMeshSection> ranges);

// Mesh sections with quads, and the most commands that they take.
struct DrawnSections {
    std::uint32_t meshSections = 0, commands = 0;
};

struct QuadStoreSizes {
    std::uint32_t arenaQuads = 0;  // of an arena; 0: 256 MiB, or as many as a shader can reach
    std::uint32_t maxArenas = shared::kMaxArenas;
    std::uint32_t firstQuads =
        1u << 20;           // the first arena begins with 8 MiB, a landscape at view distance 16
    bool hasLight = false;  // quads have light at their corners: see corner_light.h
    DrawLimits limits = {};
};

class QuadStore {
  public:
    explicit QuadStore(const QuadStoreSizes& sizes = {});

    // Limits the size of all buffers from now on; they stay as large as they are.
    void setMaxBytes(std::size_t bytes) { maxBytes_ = bytes; }
    std::size_t maxBytes() const { return maxBytes_; }

    // Replaces the quads of these mesh sections; `mesh` has none of others. Grows when the arenas are full.
    // Returns false if they cannot grow further, or lists of draws would be too long: the mesh sections then
    // have no quads, since the old ones are wrong. `light`: of each quad, if the store has it.
    bool set(world::ChunkPos pos, const mesh::ChunkMesh& mesh,
             const mesh::MeshSectionSet& meshSections = mesh::kAllMeshSections,
             std::span<const shared::QuadLight> light = {});
    // Does the same without the quads: a shader writes them to the ranges of meshSectionsOf() before the next
    // frame.
    bool reserve(world::ChunkPos pos, std::span<const mesh::MeshSection> meshes,
                 const mesh::MeshSectionSet& meshSections = mesh::kAllMeshSections);
    void remove(world::ChunkPos pos);

    // Returns the chunks that have quads.
    const std::unordered_map<world::ChunkPos, ChunkMeshSections, world::ChunkPosHash>& chunks() const {
        return chunks_;
    }
    // Returns the mesh sections of a chunk; the result is empty if it has no quads.
    std::span<const mesh::MeshSection> meshSectionsOf(world::ChunkPos pos) const;
    // Returns the quads of a chunk as they were set, or as a shader wrote them. May wait for the GPU.
    mesh::ChunkMesh meshOf(world::ChunkPos pos) const;
    bool hasLight() const { return hasLight_; }
    gpu::ArenaBuffers buffers() const;  // until the next change
    // Returns the quads of an arena in memory, for culling on the CPU, which changes their bits. The first
    // call, and each after quads that a shader wrote, waits for the GPU.
    std::span<shared::Quad> quadsOnCpu(std::size_t arena);
    const gpu::BufferTexture& texels(std::size_t arena) const {
        return arenas_[arena].texels;
    }  // a quad each
    // Binds the quads of an arena for shaders, and their light if the store has it.
    void bindTexels(std::size_t arena) const;
    std::size_t usedBytes() const;
    std::size_t bufferBytes() const;  // of all arenas
    // Returns the most bytes that the buffers took at once since the last call, including copies.
    std::size_t takePeakBytes() { return std::max(std::exchange(peakBytes_, 0), bufferBytes()); }
    std::uint64_t uploadedBytes() const { return uploadedBytes_; }  // by set(), since the beginning
    const gpu::ArenaAllocator& ranges() const { return ranges_; }

  private:
    struct Arena {
        gpu::Buffer buffer;
        gpu::BufferTexture texels;
        gpu::Buffer light = {};  // shared::QuadLight by quad, if the store has it
        gpu::BufferTexture lightTexels = {};
        std::vector<shared::Quad> onCpu = {};  // empty until it is asked for
    };

    bool replaceRanges(world::ChunkPos pos, std::span<const mesh::MeshSection> meshes,
                       const mesh::MeshSectionSet& meshSections);
    bool hasRoomFor(std::span<const mesh::MeshSection> meshes) const;
    void free(ChunkMeshSections& chunk, const mesh::MeshSectionSet& meshSections);
    std::optional<std::uint32_t> allocate(std::uint32_t count);
    bool grow(std::uint32_t count);
    Arena makeArena(std::uint32_t quads) const;
    std::size_t bytesPerQuad() const {
        return shared::kQuadBytes + (hasLight_ ? sizeof(shared::QuadLight) : 0);
    }

    bool hasLight_;
    gpu::ArenaAllocator ranges_;
    std::vector<Arena> arenas_;
    std::size_t maxBytes_ = SIZE_MAX, peakBytes_ = 0;
    std::unordered_map<world::ChunkPos, ChunkMeshSections, world::ChunkPosHash> chunks_;
    std::uint64_t uploadedBytes_ = 0;
    DrawLimits limits_;
    DrawnSections drawn_;  // of all chunks
};

}  // namespace terrane::render
