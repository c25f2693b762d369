#include "terrane/mesh/model_faces.h"

#include <bit>

#include "terrane/mesh/draw_bucket.h"

namespace terrane::mesh {

bool hasBit(const BitCube& cube, world::Face side, std::size_t block) {
    const std::size_t x = block & 15, y = block >> 4 & 15, layer = block >> 8;
    const std::size_t bit = isAlongX(side) ? y + 16 * x : x + 16 * y;
    return (cube[4 * layer + (bit >> 6)] >> (bit & 63) & 1) != 0;
}

void addCellFace(const ModelBlocks& blocks, std::size_t block, const world::ModelFace& face,
                 QuadCollector& out) {
    const std::uint16_t material = blocks.type.material[face.side];
    const world::Material& look = blocks.view.blocks->materials()[material];
    QuadArray& quads = out.quadsOf(drawBucket(look), look.twoSided ? kAnyDirection : int{face.side});
    const auto z = static_cast<shared::uint>(blocks.view.target.baseZ) + (block >> 8);
    *quads.reserve(1) = shared::packQuad({.x = static_cast<shared::uint>(block & 15),
                                          .y = static_cast<shared::uint>(block >> 4 & 15),
                                          .z = static_cast<shared::uint>(z),
                                          .shapeFace = face.shapeFace,
                                          .material = material});
    quads.add(1);
    out.coverHeight(static_cast<int>(z), static_cast<int>(z) + 1);
}

void addModelFaces(const ModelBlocks& blocks, const std::array<BitCube, world::kFaceCount>& uncovered,
                   QuadCollector& out) {
    const auto isHidden = [&](std::size_t block, const world::ModelFace& face) {
        return face.isOnBorder && !hasBit(uncovered[face.side], face.side, block);
    };
    for (std::size_t i = 4 * blocks.layers.first; i < 4 * blocks.layers.end; ++i) {
        for (std::uint64_t left = blocks.alongX[i]; left != 0; left &= left - 1) {
            const std::size_t block = 64 * i + static_cast<std::size_t>(std::countr_zero(left));
            const std::uint16_t state = blocks.view.blockState->get(static_cast<int>(block));
            for (const world::ModelFace& face : blocks.type.model->form(state).faces)
                if (!isHidden(block, face)) addCellFace(blocks, block, face, out);
        }
    }
}

}  // namespace terrane::mesh
