// The visible faces of a chunk, found one block at a time from the rules, without bits and without merging.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/mesh/section_faces.h"
#include "terrane/world/blocks/block_model.h"

namespace terrane::mesh {

// One face of one block in a number, which sorts faster than a struct: x 4 bits, y 4, z above the lowest
// bottom 16, shape face 16, material 16, from the lowest.
using CellFace = std::uint64_t;

inline CellFace cellFace(unsigned x, unsigned y, int z, unsigned shapeFace, unsigned material) {
    const auto layer = static_cast<unsigned>(z - world::kLowestBottom);
    return x | y << 4 | layer << 8 | CellFace{shapeFace} << 24 | CellFace{material} << 40;
}

inline std::string describe(CellFace face) {
    return fmt::format("shape face {}, material {} at {} {} {}", face >> 24 & 65535, face >> 40, face & 15,
                       face >> 4 & 15, static_cast<int>(face >> 8 & 65535) + world::kLowestBottom);
}

class ReferenceFaces {
  public:
    explicit ReferenceFaces(const MeshInput& input) : input_(input) {}

    // In ascending order.
    std::vector<CellFace> find() {
        faces_.clear();
        for (int z = heights_.bottom; z < heights_.top; ++z) {
            for (int y = 0; y < 16; ++y) {
                for (int x = 0; x < 16; ++x) addBlock(x, y, z);
            }
        }
        std::sort(faces_.begin(), faces_.end());
        return faces_;
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

    world::BlockId idAt(int x, int y, int z) const {
        if (!heights_.contains(z)) return world::kAir;
        return chunkAt(x, y)->block(world::blockIndex(x & 15, y & 15, z));
    }

    // Whether the layer is more than kOpenSections below the highest of the solid sections at the bottom.
    bool isDeep(int z) const {
        int highest = heights_.firstSection() - 1;
        while (highest + 1 < heights_.endSection() &&
               isAllOpaque(input_.center->section(highest + 1), *input_.blocks))
            ++highest;
        return (z >> 4) < highest - kOpenSections;
    }

    // Beyond an open border an opaque cube meets air, but in deep solid ground, and everything else its own
    // kind.
    world::BlockId idBeside(world::BlockId id, int x, int y, int z) const {
        if (chunkAt(x, y)) return idAt(x, y, z);
        return typeOf(id).opaqueCube && !isDeep(z) ? world::kAir : id;
    }

    const world::BlockType& typeOf(world::BlockId id) const { return input_.blocks->type(id); }

    bool isTwoSided(const world::BlockType& type, int side) const {
        return input_.blocks->materials()[type.material[static_cast<std::size_t>(side)]].twoSided;
    }

    bool touchesOpaqueCube(int x, int y, int z, int side) const {
        const int step = side % 2 == 0 ? -1 : 1;
        const int nx = x + (side / 2 == 0 ? step : 0), ny = y + (side / 2 == 1 ? step : 0);
        const int nz = z + (side / 2 == 2 ? step : 0);
        if (nz < heights_.bottom) return true;
        return chunkAt(nx, ny) && typeOf(idAt(nx, ny, nz)).opaqueCube;
    }

    void addModel(int x, int y, int z) {
        const world::BlockType& type = typeOf(idAt(x, y, z));
        const std::uint16_t state = input_.center->blockState(world::blockIndex(x, y, z));
        for (const world::ModelFace& face : type.model->form(state).faces) {
            if (face.hiddenBy != world::kFaceCount && touchesOpaqueCube(x, y, z, face.hiddenBy)) continue;
            faces_.push_back(cellFace(static_cast<unsigned>(x), static_cast<unsigned>(y), z, face.shapeFace,
                                      type.material[face.look]));
        }
    }

    // Whether the side of the cell toward its neighbor is drawn.
    bool sideVisible(int x, int y, int z, int side) const {
        const int step = side % 2 == 0 ? -1 : 1;
        const int nx = x + (side / 2 == 0 ? step : 0), ny = y + (side / 2 == 1 ? step : 0);
        const int nz = z + (side / 2 == 2 ? step : 0);
        if (nz < heights_.bottom) return false;
        const world::BlockId id = idAt(x, y, z), next = idBeside(id, nx, ny, nz);
        if (typeOf(next).opaqueCube) return false;
        if (next != id) return true;
        const world::BlockType& type = typeOf(id);
        if (type.shape == world::Shape::Liquid || !type.innerFaces) return false;
        const bool pairIsOneFace = side % 2 == 0 && isTwoSided(type, side + 1);
        return !pairIsOneFace;
    }

    void push(int x, int y, int z, unsigned shapeFace, int side) {
        const world::BlockType& type = typeOf(idAt(x, y, z));
        const std::size_t left =
            std::min<std::size_t>(input_.center->blockState(world::blockIndex(x, y, z)), type.growth.size());
        faces_.push_back(
            cellFace(static_cast<unsigned>(x), static_cast<unsigned>(y), z, shapeFace,
                     left > 0 ? type.growth[left - 1] : type.material[static_cast<std::size_t>(side)]));
    }

    void addSides(int x, int y, int z, int first, unsigned shapeFaceOfNegX) {
        for (int side = first; side < 6; ++side) {
            if (sideVisible(x, y, z, side))
                push(x, y, z, shapeFaceOfNegX + static_cast<unsigned>(side), side);
        }
    }

    void addPlanes(int x, int y, int z, unsigned first, int count) {
        for (int k = 0; k < count; ++k) push(x, y, z, first + static_cast<unsigned>(k), k);
    }

    // Level and whether it falls, of a liquid.
    unsigned formAt(int x, int y, int z) const {
        return chunkAt(x, y)->blockState(world::blockIndex(x & 15, y & 15, z)) & 15u;
    }

    // Eighths of the surface's height; 9: the whole cell.
    static unsigned flowHeight(unsigned form) { return form >= 8 ? 9 : 8 - form; }

    // Not known at the top of a section in a chunk beside.
    bool isStillFull(int x, int y, int z) const {
        if (((x | y) & ~15) != 0 && (z & 15) == 15) return false;
        const world::BlockId above = idAt(x, y, z + 1);
        return above == idAt(x, y, z) || typeOf(above).opaqueCube;
    }

    void addFlowSide(int x, int y, int z, int side, unsigned low, unsigned high) {
        const unsigned pair = high * (high - 1) / 2 + low;
        if (low < high) push(x, y, z, 28 + 4 * pair + static_cast<unsigned>(side), side);
    }

    // Toward lower cells of the same liquid that flow, or that do not where this one does.
    void addStepsDown(int x, int y, int z, unsigned height) {
        constexpr int kStep[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
        for (int side = 0; side < 4; ++side) {
            const int nx = x + kStep[side][0], ny = y + kStep[side][1];
            if (!chunkAt(nx, ny) || idAt(nx, ny, z) != idAt(x, y, z)) continue;
            if (formAt(x, y, z) == 0 && formAt(nx, ny, z) == 0) continue;
            const bool isFull = formAt(nx, ny, z) == 0 && isStillFull(nx, ny, z);
            addFlowSide(x, y, z, side, isFull ? 9 : flowHeight(formAt(nx, ny, z)), height);
        }
    }

    void addFlowing(int x, int y, int z) {
        const unsigned form = formAt(x, y, z);
        for (int side = 0; side < 4; ++side) {
            if (sideVisible(x, y, z, side)) addFlowSide(x, y, z, side, 0, flowHeight(form));
        }
        addStepsDown(x, y, z, flowHeight(form));
        if (sideVisible(x, y, z, 4)) push(x, y, z, 4, 4);
        if (form < 8) push(x, y, z, 20 + form, 5);
        if (form >= 8 && sideVisible(x, y, z, 5)) push(x, y, z, 5, 5);
    }

    void addLiquid(int x, int y, int z) {
        const world::BlockId above = idAt(x, y, z + 1);
        const bool isSurface = above != idAt(x, y, z) && !typeOf(above).opaqueCube;
        if (formAt(x, y, z) != 0) return addFlowing(x, y, z);
        addStepsDown(x, y, z, isSurface ? 8 : 9);
        if (!isSurface) return addSides(x, y, z, 0, 0);
        for (int side = 0; side < 4; ++side) {
            if (sideVisible(x, y, z, side)) push(x, y, z, 17 + static_cast<unsigned>(side), side);
        }
        if (sideVisible(x, y, z, 4)) push(x, y, z, 4, 4);
        push(x, y, z, 16, 5);
    }

    void addBlock(int x, int y, int z) {
        switch (typeOf(idAt(x, y, z)).shape) {
            case world::Shape::None:
                return;
            case world::Shape::Cube:
                return addSides(x, y, z, 0, 0);
            case world::Shape::Liquid:
                return addLiquid(x, y, z);
            case world::Shape::Cross:
                return addPlanes(x, y, z, 6, 2);
            case world::Shape::Hash:
                return addPlanes(x, y, z, 8, 4);
            case world::Shape::Inset:
                addPlanes(x, y, z, 12, 4);
                addSides(x, y, z, 4, 0);
                return;
            case world::Shape::Model:
                addModel(x, y, z);
        }
    }

    const MeshInput& input_;
    const world::Heights heights_ = input_.center->heights();
    std::vector<CellFace> faces_;
};

// All faces the quads cover, in ascending order; a face covered twice stands twice.
inline std::vector<CellFace> coveredFaces(const ChunkMesh& mesh, const world::BlockRegistry& blocks) {
    const std::vector<shared::ShapeFace> table = shapeFaces(blocks);
    std::vector<CellFace> faces;
    const auto add = [&](shared::Quad q, int base) {
        const shared::ShapeFace& shape = table[quadShapeFace(q)];
        // The axes of merged faces lie along coordinates; steps go up whichever way the texture runs.
        const auto step = [](float a) { return a != 0 ? 1u : 0u; };
        const shared::vec4 u = shape.axisU, v = shape.axisV;
        for (unsigned j = 0; j < quadExtentV(q); ++j) {
            for (unsigned i = 0; i < quadExtentU(q); ++i) {
                const unsigned z = quadZ(q) + i * step(u.z) + j * step(v.z);
                faces.push_back(cellFace(quadX(q) + i * step(u.x) + j * step(v.x),
                                         quadY(q) + i * step(u.y) + j * step(v.y), base + static_cast<int>(z),
                                         quadShapeFace(q), quadMaterial(q)));
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
