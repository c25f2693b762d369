// What the path tracer draws: chunks and tiles with their blocks, the textures of all faces, the sky, the
// air, and the blocks that emit light. Made once, then immutable: any number of threads may trace through it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/path/emitters.h"
#include "terrane/path/sky.h"
#include "terrane/rays/surfaces.h"
#include "terrane/shared/air.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/tint.h"

namespace terrane::path {

struct Texture {
    int side = 1;                    // texels, a power of two
    std::vector<std::uint8_t> rgba;  // sRGB
};
// Reads the textures of all blocks, in the order of BlockRegistry::textures(). Errors name the texture.
base::Result<std::vector<Texture>> loadTextures(const world::BlockRegistry& blocks,
                                                const world::TextureSource& source);

// A chunk or tile. No other one covers a part of it.
struct SceneTile {
    world::ChunkPos pos;
    std::shared_ptr<const world::Chunk> chunk;
    std::optional<world::TintTile> tint;  // of its columns
};

// Air between the camera and what it sees, as the rasterizer has it (distance_fog.glsl): it takes light away
// and adds the sky behind. It neither darkens nor lights anything else.
struct Air {
    shared::AirFrame frame{};
    float fogDistance = 0;  // blocks at which the view ends; 0: there is no air
    float cameraZ = 0;
    float daylight = 1;  // 0 to 1: dark caves have no haze
};

struct SceneParts {
    const world::BlockRegistry* blocks = nullptr;  // outlives the scene
    world::Heights heights;
    world::ChunkPos center;  // of the windows of all levels
    std::vector<SceneTile> tiles;
    std::vector<Texture> textures;
    Sky sky;
    Air air;
};

// Emission of a block of level 15 lights as a cube with faces of this radiance would; lower levels have a
// smaller share of it (kLampPower). So floor four blocks from a lamp is as bright as the rasterizer's.
constexpr float kLampRadiance = 32, kLampPower = 3.6f;

struct Scene {
    explicit Scene(SceneParts parts);
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    SceneParts parts;
    world::BlockRegistry farBlocks;
    rays::Scene cells;
    rays::SurfaceScene surfaces;
    EmitterTable emitters;
    std::vector<glm::vec3> emission;  // by block: radiance of a texel that glows fully

    const SceneTile* tileAt(world::ChunkPos pos) const {
        if (pos.level >= levels_) return nullptr;
        const SceneTile* tile = grid_[slotOf(pos)];
        return tile != nullptr && tile->pos == pos ? tile : nullptr;
    }

  private:
    std::size_t slotOf(world::ChunkPos pos) const {
        const auto mask = (1u << sideBits_) - 1;
        const auto x = static_cast<unsigned>(pos.x) & mask, y = static_cast<unsigned>(pos.y) & mask;
        return (std::size_t{pos.level} << 2 * sideBits_) + (std::size_t{y} << sideBits_) + x;
    }
    void setEmission();
    std::vector<Emitter> findEmitters() const;

    int levels_ = 1, sideBits_ = 4;
    std::vector<const SceneTile*> grid_;  // of all levels, as rays::Scene's
};

// A texel of a surface.
struct Texel {
    glm::vec3 color{0};  // linear, with the tint of its place
    float alpha = 1;     // as stored
    float glow = 0;      // share of its light that it gives by itself, 0 to 1
    bool isHole = false;
};
Texel texelOf(const Scene& scene, const rays::Surface& surface);

// Radiance that the surface of a block emits for others.
glm::vec3 emittedBy(const Scene& scene, const rays::Surface& surface, const Texel& texel);

const world::BlockType& blockOf(const Scene& scene, const rays::Surface& surface);

}  // namespace terrane::path
