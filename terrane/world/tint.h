// The tint of columns: the color that grass has there. Generators compute it (gen/language/builder.h), and it
// is applied to the textures of tinted faces (docs/blocks.md). All are plain values; any thread may use them.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/shared/tint.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/chunk.h"

namespace terrane::world {

// A packed color: red · 2^16 + green · 2^8 + blue, each 0…255, sRGB.
using PackedColor = std::uint32_t;

constexpr PackedColor packColor(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
    return red << 16 | green << 8 | blue;
}

constexpr PackedColor kNeutralTint =
    packColor(shared::kNeutralTintRed, shared::kNeutralTintGreen, shared::kNeutralTintBlue);

// Tints of the columns of a chunk of any level: x + 16 y.
using TintTile = std::array<PackedColor, static_cast<std::size_t>(kChunkSize) * kChunkSize>;

// Tints a color, 0…1 as stored (sRGB). Each channel c becomes c t / (t + (1 − c) (n − t) / (1 − n)), with
// tint t and neutral n: neutral becomes the tint, black and white stay, and no pale color turns white, as it
// would by a factor. This is Schlick's bias function (Fast Alternatives to Perlin's Bias and Gain Functions,
// 1994), through (n, t) instead of (1/2, t). For display; block_tint.glsl does the same.
glm::vec3 tinted(glm::vec3 color, PackedColor tint);

// The mean color of a block's top face, for maps and for light that the ground reflects.
struct TopColor {
    glm::vec3 mean{0.0f};  // sRGB, 0…255
    bool tinted = false;
};
using TopColors = std::vector<TopColor>;  // by block id

// Returns the colors of the top faces; blocks without a shape are black. Fails if a texture cannot be read;
// the message names it.
base::Result<TopColors> topColors(const BlockRegistry& blocks, const TextureSource& textures);

// The surface of a chunk of any level as seen from above: height and topmost block of its columns. Far
// shadows and light from the ground are computed from it (render/land/land_map.h). All are plain values; any
// thread may use them.
struct LandTile {
    static constexpr std::size_t kColumns = static_cast<std::size_t>(kChunkSize) * kChunkSize;

    // By column, x + 16 y.
    std::array<std::int16_t, kColumns> height{};  // z of the upper side of the topmost block
    std::array<BlockId, kColumns> ground{};       // the topmost block
    PackedColor tint = kNeutralTint;              // of the whole tile
};

// Returns the surface of a chunk. Tree crowns and the surface of water count, plants do not. Columns without
// blocks have the height of the world's bottom.
LandTile landTileOf(const Chunk& chunk, const BlockRegistry& blocks);

}  // namespace terrane::world
