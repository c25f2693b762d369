// The light of the visible chunks on the GPU, for shaders to sample (light_sample.glsl). It is used on the
// thread of the current OpenGL context.
//
// Light is stored in light tiles of 8³ blocks; a light tile of one value takes only its entry, and a brick of
// 16³ blocks with one value only its entry in the grid. Grid: a 3D texture of 32-bit entries, one a brick,
// wrapping around the camera. Entries: eight a brick with several values, in a buffer. Pool: a 3D texture of
// light tiles with four bits a component. Entries and pool grow by doubling, the pool up to 1 GiB. No growth
// takes the textures beyond `maxBytes`, including the temporary copy.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "terrane/gpu/buffer.h"
#include "terrane/gpu/texture.h"
#include "terrane/light/chunk_light.h"
#include "terrane/shared/light_grid.h"
#include "terrane/world/coords.h"

namespace terrane::render {

class LightStore {
  public:
    LightStore() = default;
    // Creates a store for chunks of these heights up to `viewDistance` + 1 around the camera. `maxSlabs`: of
    // 4,096 light tiles (4 MiB) each; 0: as many as the driver allows.
    explicit LightStore(int viewDistance, int maxSlabs = 0, std::size_t maxBytes = SIZE_MAX,
                        world::Heights heights = {});
    // Limits further growth; the textures stay as large as they are.
    void setMaxBytes(std::size_t bytes) { maxBytes_ = bytes; }

    // Sets the light of a chunk. `bricks`: those that may differ from the last call; a new chunk sets all.
    // Returns false if some light tiles had no room: they get the light of their middle.
    bool set(world::ChunkPos pos, const light::ChunkLight& light, const world::SectionSet& bricks);
    void remove(world::ChunkPos pos);
    void addTo(gpu::TextureSet& textures) const;

    // Returns the number of chunks along a side of the grid: a power of two.
    int gridChunks() const { return gridChunks_; }
    std::size_t usedBytes() const {
        return (tileCount_ - freeTiles_.size()) * kTileBytes + grid_.sizeBytes() +
               (brickEntries_.size() - freeBricks_.size()) * sizeof(BrickEntries);
    }
    std::size_t textureBytes() const { return grid_.sizeBytes() + entries_.sizeBytes() + pool_.sizeBytes(); }
    // Returns the most bytes that the textures took at once since the last call, including copies.
    std::size_t takePeakBytes() { return std::max(std::exchange(peakBytes_, 0), textureBytes()); }
    std::size_t chunkCount() const { return chunks_.size(); }
    std::size_t uploadedTiles() const { return uploadedTiles_; }  // so far

  private:
    static constexpr std::size_t kTileBytes = 1024;  // 8³ blocks of 16 bits
    static constexpr std::size_t kTilesPerBrick = 8;
    using Column = std::vector<std::uint32_t>;  // entries of the grid, from the bottom
    using BrickEntries = std::array<std::uint32_t, kTilesPerBrick>;

    std::optional<std::uint32_t> allocateTile();
    bool growPool();  // false if it cannot grow
    int slabs() const;
    int slabsWithin(std::size_t bytes) const;
    void uploadTile(std::uint32_t tile, std::span<const std::uint16_t> values);
    std::optional<std::uint32_t> allocateEntries();
    bool growEntries(std::size_t bricks);  // false if they cannot grow so far
    void uploadColumn(world::ChunkPos pos, const Column& column);
    bool setBrick(std::uint32_t& entry, const light::LightBrick& brick);
    bool setTiles(BrickEntries& entries, const light::LightBrick& brick);
    void releaseTiles(const BrickEntries& entries);
    void release(std::uint32_t entry);
    Column unknownColumn() const;

    std::size_t placeOf(world::ChunkPos pos) const;

    world::Heights heights_;
    int gridChunks_ = 0, maxSlabs_ = 0;
    std::vector<std::optional<world::ChunkPos>> shown_;  // by place in the grid, which many chunks share
    std::size_t maxBytes_ = SIZE_MAX, peakBytes_ = 0;
    gpu::Texture3D grid_, pool_;
    std::size_t tileCount_ = 0;  // allocated so far, free ones included
    std::vector<std::uint32_t> freeTiles_;
    std::size_t uploadedTiles_ = 0;
    std::vector<BrickEntries> brickEntries_;  // by number, free ones included
    std::vector<std::uint32_t> freeBricks_;
    gpu::Buffer entries_;
    gpu::BufferTexture entryTexels_;
    std::unordered_map<world::ChunkPos, Column, world::ChunkPosHash> chunks_;
};

}  // namespace terrane::render
