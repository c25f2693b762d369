#include "terrane/mesh/model_faces.h"

#include <algorithm>
#include <bit>

#include "terrane/mesh/cell_faces.h"
#include "terrane/mesh/draw_bucket.h"
#include "terrane/world/changes/liquid_flow.h"

namespace terrane::mesh {

bool hasBit(const BitCube& cube, world::Face side, std::size_t block) {
    const std::size_t x = block & 15, y = block >> 4 & 15, layer = block >> 8;
    const std::size_t bit = isAlongX(side) ? y + 16 * x : x + 16 * y;
    return (cube[4 * layer + (bit >> 6)] >> (bit & 63) & 1) != 0;
}

void addCellFace(const ModelBlocks& blocks, std::size_t block, const world::ModelFace& face,
                 QuadCollector& out) {
    const std::uint16_t material = blocks.type.material[face.look];
    const world::Material& look = blocks.view.blocks->materials()[material];
    const bool isTwoSided = look.twoSided || face.isTwoSided;
    QuadArray& quads = out.quadsOf(drawBucket(alphaClass(look.alpha), isTwoSided),
                                   isTwoSided ? kAnyDirection : int{face.direction});
    const int z = blocks.view.target.baseZ + static_cast<int>(block >> 8);
    *quads.reserve(1) = shared::packQuad({.x = static_cast<shared::uint>(block & 15),
                                          .y = static_cast<shared::uint>(block >> 4 & 15),
                                          .z = shared::quadZOf(z),
                                          .shapeFace = face.shapeFace,
                                          .material = material});
    quads.add(1);
    out.coverHeight(z, z + 1);
}

void addModelFaces(const ModelBlocks& blocks, const std::array<BitCube, world::kFaceCount>& uncovered,
                   QuadCollector& out) {
    const auto isHidden = [&](std::size_t block, const world::ModelFace& face) {
        return face.hiddenBy != world::kFaceCount && !hasBit(uncovered[face.hiddenBy], face.hiddenBy, block);
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

namespace {

using shared::uint;
using world::Face;

bool mayFlow(const world::Section* states) {
    return states && (!states->isUniform() || !world::isLiquidSource(states->uniformValue()));
}

struct FlowCell {
    int x, y, z;  // in the section

    std::size_t index() const { return static_cast<std::size_t>(x + 16 * y + 256 * z); }
};

class FlowFaces {
  public:
    FlowFaces(const ModelBlocks& liquid, const BitCube& stillSurface,
              const std::array<BitCube, world::kFaceCount>& uncovered, QuadCollector& out)
        : liquid_(liquid), stillSurface_(stillSurface), uncovered_(uncovered), out_(out) {}

    void add(const FlowCell& cell) {
        const uint form = formAt(*liquid_.view.blockState, cell.index());
        for (int side = 0; side < 4; ++side) addSide(cell, form, static_cast<Face>(side));
        if (form == 0) return;
        const bool isFalling = (form & world::kLiquidFalling) != 0;
        addLevel(cell, world::kFaceNegZ, shared::kShapeFaceCube + world::kFaceNegZ);
        if (isFalling)
            addLevel(cell, world::kFacePosZ, shared::kShapeFaceCube + world::kFacePosZ);
        else
            write(cell, world::kFacePosZ, shared::kShapeFaceFlowTop + form - 1);
    }

  private:
    struct Beside {
        bool isKnown = true;  // not beyond an open border
        bool isSameLiquid = false;
        uint form = 0;
        bool isStillFull = false;
    };

    static uint formAt(const world::Section& states, std::size_t index) {
        return states.get(static_cast<int>(index)) & world::kLiquidForm;
    }

    Beside beside(const FlowCell& cell, Face side) const {
        const int step = side % 2 == 1 ? 1 : -1;
        int at[3] = {cell.x, cell.y, cell.z};
        at[side / 2] += step;
        const bool isInside = at[side / 2] >= 0 && at[side / 2] < 16;
        const SectionView& view = liquid_.view;
        const world::Section* blocks = isInside ? view.center : view.neighbors[side];
        if (!blocks) return {.isKnown = side / 2 == 2};
        const std::size_t index = FlowCell{at[0] & 15, at[1] & 15, at[2] & 15}.index();
        if (blocks->get(static_cast<int>(index)) != liquid_.type.id) return {};
        if (side / 2 == 2) return {.isSameLiquid = true};
        const world::Section* states = isInside ? view.blockState : view.neighborStates[side];
        const uint form = formAt(*states, index);
        return {
            .isSameLiquid = true, .form = form, .isStillFull = form == 0 && isFull(*blocks, isInside, index)};
    }

    // Whether the top of a still block, in the section or beside it, is not a surface. The block above is
    // unknown at the top of a section in a neighboring chunk: the top counts as a surface then.
    bool isFull(const world::Section& blocks, bool isInside, std::size_t index) const {
        const bool isTop = index >= 256 * 15;
        if (isTop && !isInside) return false;
        const world::Section* section = isTop ? liquid_.view.neighbors[world::kFacePosZ] : &blocks;
        if (!section) return false;
        const world::BlockId above = section->get(static_cast<int>((index + 256) % 4096));
        return above == liquid_.type.id || liquid_.view.blocks->type(above).opaqueCube;
    }

    // Heights as in shared/shape_face.h.
    uint heightOf(uint form, bool isStillFull) const {
        if (form == 0) return isStillFull ? kHeightOfFull : kHeightOfStill;
        return (form & world::kLiquidFalling) != 0 ? kHeightOfFull : kHeightOfStill - form;
    }

    void addSide(const FlowCell& cell, uint form, Face side) {
        if (!hasBit(uncovered_[side], side, cell.index())) return;
        const Beside next = beside(cell, side);
        if (!next.isKnown || (form == 0 && next.form == 0)) return;
        const bool isFull = !hasBit(stillSurface_, world::kFacePosZ, cell.index());
        const uint high = heightOf(form, isFull),
                   low = next.isSameLiquid ? heightOf(next.form, next.isStillFull) : 0;
        if (low < high) write(cell, side, shared::flowSideFace(side, low, high));
    }

    void addLevel(const FlowCell& cell, Face side, uint shapeFace) {
        if (hasBit(uncovered_[side], side, cell.index()) && !beside(cell, side).isSameLiquid)
            write(cell, side, shapeFace);
    }

    void write(const FlowCell& cell, Face side, uint shapeFace) {
        addCellFace(liquid_, cell.index(),
                    {.shapeFace = static_cast<std::uint16_t>(shapeFace), .look = side, .direction = side},
                    out_);
    }

    const ModelBlocks& liquid_;
    const BitCube& stillSurface_;
    const std::array<BitCube, world::kFaceCount>& uncovered_;
    QuadCollector& out_;
};

}  // namespace

bool hasFlow(const SectionView& view) {
    return mayFlow(view.blockState) || std::ranges::any_of(view.neighborStates, mayFlow);
}

BitCube flowingBlocks(const ModelBlocks& liquid) {
    return blocksWhere(liquid.alongX, liquid.layers, [&](std::size_t block) {
        return !world::isLiquidSource(liquid.view.blockState->get(static_cast<int>(block)));
    });
}

void addFlowFaces(const ModelBlocks& liquid, const BitCube& stillSurface,
                  const std::array<BitCube, world::kFaceCount>& uncovered, QuadCollector& out) {
    FlowFaces faces(liquid, stillSurface, uncovered, out);
    for (std::size_t i = 4 * liquid.layers.first; i < 4 * liquid.layers.end; ++i) {
        for (std::uint64_t left = liquid.alongX[i]; left != 0; left &= left - 1) {
            const auto block = static_cast<int>(64 * i) + std::countr_zero(left);
            faces.add({block & 15, block >> 4 & 15, block >> 8});
        }
    }
}

}  // namespace terrane::mesh
