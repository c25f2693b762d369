// The tint of columns: the color that grass has there. Made by generators (gen/builder.h), applied to the
// textures of tinted faces (docs/blocks.md). Plain values; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "terrane/shared/tint.h"
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

}  // namespace terrane::world
