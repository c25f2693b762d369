// Faces of a block's cell, and boxes in it. Plain values; any thread.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "terrane/world/coords.h"

namespace terrane::world {

struct Box {
    glm::vec3 min{0}, max{1};  // in block units inside the cell
};

// Order of faces everywhere: -x, +x, -y, +y, -z, +z.
enum Face : std::uint8_t { kFaceNegX, kFacePosX, kFaceNegY, kFacePosY, kFaceNegZ, kFacePosZ, kFaceCount };

// The cell beside a face of a block.
constexpr BlockPos beside(BlockPos pos, Face face) {
    // Wraps around at the ends of the numbers, where no chunk is.
    const auto step = [&](std::int32_t at, int axis) {
        const std::uint32_t by = face / 2 != axis ? 0u : face % 2 == 0 ? ~0u : 1u;
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(at) + by);
    };
    return {step(pos.x, 0), step(pos.y, 1), step(pos.z, 2)};
}

}  // namespace terrane::world
