// The tint of columns: the color that grass has there. Made by generators (gen/builder.h), multiplied into
// the textures of tinted faces (docs/blocks.md). Plain values; any thread.
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

// Of the columns of a chunk of any level: x + 16 y.
using TintTile = std::array<PackedColor, static_cast<std::size_t>(kChunkSize) * kChunkSize>;

// What colors as stored (sRGB) are multiplied with.
inline glm::vec3 tintFactor(PackedColor tint) {
    const auto channel = [](PackedColor color, int shift) {
        return static_cast<float>(color >> shift & 255u);
    };
    return {channel(tint, 16) / channel(kNeutralTint, 16), channel(tint, 8) / channel(kNeutralTint, 8),
            channel(tint, 0) / channel(kNeutralTint, 0)};
}

}  // namespace terrane::world
