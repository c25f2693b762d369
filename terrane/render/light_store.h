// The light of the visible chunks on the GPU, for shaders to sample (light_sample.glsl). Used on the thread
// of the current OpenGL context.
//
// Light is kept in light tiles of 8³ blocks; light tiles of one value take an entry of the grid and nothing
// else. Grid: a 3D texture of 32-bit entries, two by two light tiles a chunk, wrapping around the camera.
// Pool: a 3D texture with four bits a component that grows by doubling.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/gpu/texture.h"
#include "terrane/light/chunk_light.h"
#include "terrane/shared/light_grid.h"
#include "terrane/world/coords.h"

namespace terrane::render {

class LightStore {
  public:
    LightStore() = default;
    // Room for chunks up to `viewDistance` + 1 around the camera. `maxSlabs`: of 4,096 light tiles each, as
    // many as the driver allows where it is 0. Light tiles for which there is no room have the light of their
    // middle.
    explicit LightStore(int viewDistance, int maxSlabs = 0);

    // `bricks`: which of the sixteen may differ from what was set before, a bit each; of a new chunk all
    // count.
    void set(world::ChunkPos pos, const light::ChunkLight& light, std::uint16_t bricks = 0xFFFF);
    void remove(world::ChunkPos pos);
    void bind() const;

    // Chunks along a side of the grid: a power of two.
    int gridChunks() const { return gridChunks_; }
    std::size_t usedBytes() const { return (tileCount_ - free_.size()) * kTileBytes + gridBytes(); }
    std::size_t uploadedTiles() const { return uploadedTiles_; }  // so far

  private:
    static constexpr std::size_t kTileBytes = 1024;  // 8³ blocks of 16 bits
    static constexpr std::uint32_t kTilesPerBrick = 8;
    using Entries = std::array<std::uint32_t, shared::kLightTilesPerChunk>;  // of the grid

    std::optional<std::uint32_t> allocateTile();
    bool growPool();  // false where it is as large as it can be
    int slabs() const;
    void uploadTile(std::uint32_t tile, const std::uint16_t* values);
    void uploadEntries(world::ChunkPos pos, const Entries& entries);
    void setBrick(std::span<std::uint32_t, kTilesPerBrick> entries, const light::LightBrick& brick);
    void release(std::span<const std::uint32_t> entries);
    std::size_t gridBytes() const;

    int gridChunks_ = 0, maxSlabs_ = 0;
    bool hasWarned_ = false;
    gpu::Texture3D grid_, pool_;
    std::size_t tileCount_ = 0;  // handed out so far, free ones included
    std::vector<std::uint32_t> free_;
    std::size_t uploadedTiles_ = 0;
    std::unordered_map<world::ChunkPos, Entries, world::ChunkPosHash> chunks_;
};

}  // namespace terrane::render
