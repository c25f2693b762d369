// The visible faces of a chunk, found one block at a time (mesh/cell_faces.h), without bits and without
// merging.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "terrane/mesh/cell_faces.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/mesh/section_faces.h"

namespace terrane::mesh {

// One face of one block in a number, which sorts faster than a struct: x 4 bits, y 4, z above the lowest
// bottom 16, shape face 16, material 16, from the lowest.
using FaceNumber = std::uint64_t;

inline FaceNumber faceNumber(unsigned x, unsigned y, int z, unsigned shapeFace, unsigned material) {
    const auto layer = static_cast<unsigned>(z - world::kLowestBottom);
    return x | y << 4 | layer << 8 | FaceNumber{shapeFace} << 24 | FaceNumber{material} << 40;
}

inline std::string describe(FaceNumber face) {
    return fmt::format("shape face {}, material {} at {} {} {}", face >> 24 & 65535, face >> 40, face & 15,
                       face >> 4 & 15, static_cast<int>(face >> 8 & 65535) + world::kLowestBottom);
}

class ReferenceFaces {
  public:
    explicit ReferenceFaces(const MeshInput& input) : input_(input) {}

    // In ascending order.
    std::vector<FaceNumber> find() const {
        std::vector<FaceNumber> faces;
        std::vector<CellFace> ofCell;
        for (int z = heights_.bottom; z < heights_.top; ++z) {
            for (int y = 0; y < 16; ++y) {
                for (int x = 0; x < 16; ++x) {
                    ofCell.clear();
                    addCellFaces(surroundingsOf(x, y, z), *input_.blocks, ofCell);
                    for (const CellFace& face : ofCell) {
                        faces.push_back(faceNumber(static_cast<unsigned>(x), static_cast<unsigned>(y), z,
                                                   face.shapeFace, face.material));
                    }
                }
            }
        }
        std::sort(faces.begin(), faces.end());
        return faces;
    }

  private:
    // Null beyond an open border.
    const world::Chunk* chunkAt(int x, int y) const {
        if (x < 0) return input_.neighbors[0];
        if (x > 15) return input_.neighbors[1];
        if (y < 0) return input_.neighbors[2];
        if (y > 15) return input_.neighbors[3];
        return input_.center;
    }

    // Beyond an open border an opaque cube meets air, and everything else its own kind.
    CellBlock blockAt(int x, int y, int z, world::BlockId self) const {
        const world::Chunk* chunk = chunkAt(x, y);
        if (z < heights_.bottom) return {world::kUnmade};
        if (z >= heights_.top) return {};
        if (!chunk) return {input_.blocks->type(self).opaqueCube ? world::kAir : self, 0, false};
        const world::BlockIndex at = world::blockIndex(x & 15, y & 15, z);
        return {chunk->block(at), chunk->blockState(at)};
    }

    CellSurroundings surroundingsOf(int x, int y, int z) const {
        constexpr int kStep[6][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
        CellSurroundings around;
        around.self = blockAt(x, y, z, world::kAir);
        for (std::size_t side = 0; side < 6; ++side) {
            const int nx = x + kStep[side][0], ny = y + kStep[side][1], nz = z + kStep[side][2];
            around.beside[side] = blockAt(nx, ny, nz, around.self.id);
            if (side >= 4) continue;
            around.aboveBeside[side] = blockAt(nx, ny, z + 1, around.self.id);
            if (((nx | ny) & ~15) != 0 && (z & 15) == 15) around.aboveBeside[side].isKnown = false;
        }
        return around;
    }

    const MeshInput& input_;
    const world::Heights heights_ = input_.center->heights();
};

// All faces the quads cover, in ascending order; a face covered twice stands twice.
inline std::vector<FaceNumber> coveredFaces(const ChunkMesh& mesh, const world::BlockRegistry& blocks) {
    const std::vector<shared::ShapeFace> table = shapeFaces(blocks);
    std::vector<FaceNumber> faces;
    const auto add = [&](shared::Quad q, int base) {
        const shared::ShapeFace& shape = table[quadShapeFace(q)];
        // The axes of merged faces lie along coordinates; steps go up whichever way the texture runs.
        const auto step = [](float a) { return a != 0 ? 1u : 0u; };
        const shared::vec4 u = shape.axisU, v = shape.axisV;
        for (unsigned j = 0; j < quadExtentV(q); ++j) {
            for (unsigned i = 0; i < quadExtentU(q); ++i) {
                const unsigned z = quadZ(q) + i * step(u.z) + j * step(v.z);
                faces.push_back(faceNumber(quadX(q) + i * step(u.x) + j * step(v.x),
                                           quadY(q) + i * step(u.y) + j * step(v.y),
                                           base + static_cast<int>(z), quadShapeFace(q), quadMaterial(q)));
            }
        }
    };
    for (const MeshSection& meshSection : mesh.meshSections) {
        const std::uint32_t first = firstQuad(meshSection);
        for (std::uint32_t k = first; k < first + quadCount(meshSection); ++k)
            add(mesh.quads[k], quadBase(meshSection));
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

}  // namespace terrane::mesh
