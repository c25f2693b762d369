// The blocks that rays meet, on the GPU: which cells stop rays (rays/scene.h), and which block is in a cell
// (shared/ray_blocks.h), of the chunks and tiles that are shown. It is used on the thread of the context.
//
// Changes reach the GPU in update(), once a frame. A chunk that is set again is compared with the one before:
// copies of a section share memory, so an edit costs the sections that it changed.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "terrane/gpu/arena_allocator.h"
#include "terrane/gpu/buffer.h"
#include "terrane/rays/scene.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/chunk.h"

namespace terrane::render {

class RayStore {
  public:
    RayStore() = default;
    // Makes an empty store for chunks of these heights up to `viewDistance` chunks around the camera, and
    // tiles.
    RayStore(const world::BlockRegistry& blocks, world::Heights heights, int viewDistance);

    bool isUsed() const { return !scenes_.empty(); }
    // Changes the view distance; what the store has stays.
    void setViewDistance(int viewDistance);
    // Limits the size of the buffers from now on; they stay as large as they are.
    void setMaxBytes(std::size_t bytes) { maxBytes_ = bytes; }

    // Sets the blocks of a chunk or tile, not null. Returns false if there is no room: the store then does
    // not have it.
    bool set(world::ChunkPos pos, world::ChunkPtr chunk);
    void remove(world::ChunkPos pos);
    // Shows or hides a chunk; shown by default. May come before it is set; remove() resets it.
    void setShown(world::ChunkPos pos, bool isShown);

    // Makes the GPU's copy that of the chunks that are shown now. Comes before the frame.
    void update(world::ChunkPos camera);
    // Binds what shaders read: of all faces but blended ones, or of blended ones.
    void bind(bool isBlended) const;

    std::size_t gpuBytes() const;
    std::size_t usedBytes() const;  // of these, without free room
    std::size_t tileCount() const { return tiles_.size(); }

  private:
    // Words of a section in the buffer of blocks; none if it has one value.
    struct Range {
        std::uint32_t first = 0, count = 0;
    };
    struct Tile {
        world::ChunkPtr chunk;     // null: only `isShown` is known
        world::ChunkPtr uploaded;  // as on the GPU; null: it is not there
        bool isShown = true;
        std::uint32_t entry = 0;         // its place in the grid of blocks
        Range head;                      // the words of its sections
        std::vector<Range> sections;     // blocks and block state of each section, from the bottom
        std::size_t estimatedBytes = 0;  // on the GPU
    };

    void place(world::ChunkPos pos, Tile& tile);
    void replace(world::ChunkPos pos, Tile& tile);
    void unplace(world::ChunkPos pos, Tile& tile);
    std::uint32_t sectionWord(Range& range, const world::Section& section);
    void releaseRange(Range& range);
    static std::size_t mostBytes();
    Range allocate(std::uint32_t count);  // empty if there is no room
    void write(std::uint32_t first, std::span<const std::uint32_t> words);
    void uploadScenes();

    world::Heights heights_;
    std::array<std::array<rays::StopTable, 2>, 2> stops_;  // by blended or not, of chunks and far tiles
    std::vector<rays::Scene> scenes_;                      // two: all faces but blended ones, blended ones
    std::array<gpu::Buffer, 2> sceneWords_;
    gpu::Buffer blocks_, types_, forms_;
    gpu::RangeAllocator ranges_{0};  // of blocks_, in words
    world::ChunkPos center_;
    std::unordered_map<world::ChunkPos, Tile, world::ChunkPosHash> tiles_;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> changed_;
    std::size_t estimatedBytes_ = 0, maxBytes_ = SIZE_MAX;
    std::vector<std::uint32_t> words_;  // of one section, to keep its memory
};

}  // namespace terrane::render
