#include "terrane/mesh/cell_faces.h"

#include <algorithm>

#include "terrane/mesh/section_faces.h"
#include "terrane/world/changes/liquid_flow.h"

namespace terrane::mesh {
namespace {

using shared::uint;
using world::BlockType;
using world::Face;
using world::Shape;

bool isVisible(const CellBlock& self, const CellBlock& beside, uint side,
               const world::BlockRegistry& blocks) {
    if (blocks.type(beside.id).opaqueCube) return false;
    return beside.id != self.id || !hidesSameType(blocks.type(self.id), static_cast<Face>(side), blocks);
}

// Block state of a growing plant counts the stages left.
std::uint16_t materialOf(const BlockType& type, std::uint16_t state, uint side) {
    const auto left = std::min<std::size_t>(state, type.growth.size());
    return left > 0 ? type.growth[left - 1] : type.material[side];
}

CellFace faceOf(uint shapeFace, std::uint16_t material, const world::BlockRegistry& blocks) {
    return {static_cast<std::uint16_t>(shapeFace), material, blocks.materials()[material].twoSided};
}

class CellFaces {
  public:
    CellFaces(const CellSurroundings& around, const world::BlockRegistry& blocks, std::vector<CellFace>& out)
        : around_(around), blocks_(blocks), type_(blocks.type(around.self.id)), out_(out) {}

    void add() {
        switch (type_.shape) {
            case Shape::None:
                return;
            case Shape::Cube:
                return addSides(0, world::kFaceCount, shared::kShapeFaceCube);
            case Shape::Liquid:
                return addLiquid();
            case Shape::Cross:
                return addPlanes(shared::kShapeFaceCross, 2);
            case Shape::Hash:
                return addPlanes(shared::kShapeFaceHash, 4);
            case Shape::Inset:
                addPlanes(shared::kShapeFaceInset, 4);
                return addSides(world::kFaceNegZ, world::kFaceCount, shared::kShapeFaceCube);
            case Shape::Model:
                return addModel();
        }
    }

  private:
    const BlockType& typeOf(const CellBlock& block) const { return blocks_.type(block.id); }

    // Whether a side of the cell is drawn.
    bool isVisible(uint side) const {
        return mesh::isVisible(around_.self, around_.beside[side], side, blocks_);
    }

    void push(uint shapeFace, std::uint16_t material, bool isTwoSided = false) {
        out_.push_back(faceOf(shapeFace, material, blocks_));
        out_.back().isTwoSided |= isTwoSided;
    }

    void pushSide(uint shapeFace, uint side) { push(shapeFace, materialOf(type_, around_.self.state, side)); }

    void addSides(uint first, uint end, uint shapeFaceOfNegX) {
        for (uint side = first; side < end; ++side)
            if (isVisible(side)) pushSide(shapeFaceOfNegX + side, side);
    }

    // Plane k has the material of side k.
    void addPlanes(uint first, uint count) {
        for (uint k = 0; k < count; ++k) pushSide(first + k, k);
    }

    void addModel() {
        for (const world::ModelFace& face : type_.model->form(around_.self.state).faces) {
            const bool isHidden = face.hiddenBy != world::kFaceCount &&
                                  around_.beside[face.hiddenBy].isKnown &&
                                  typeOf(around_.beside[face.hiddenBy]).opaqueCube;
            if (!isHidden) push(face.shapeFace, type_.material[face.look], face.isTwoSided);
        }
    }

    static uint formOf(const CellBlock& liquid) { return liquid.state & world::kLiquidForm; }

    // Heights as in shared/shape_face.h.
    static uint flowHeight(uint form) {
        return (form & world::kLiquidFalling) != 0 ? kHeightOfFull : kHeightOfStill - form;
    }

    bool isStillFull(uint side) const {
        const CellBlock& above = around_.aboveBeside[side];
        return above.isKnown && (above.id == around_.self.id || typeOf(above).opaqueCube);
    }

    void addFlowSide(uint side, uint low, uint high) {
        if (low < high) push(shared::flowSideFace(side, low, high), type_.material[side]);
    }

    // Toward lower cells of the same liquid that flow, or that do not where this one does.
    void addStepsDown(uint height) {
        for (uint side = 0; side < around_.aboveBeside.size(); ++side) {
            const CellBlock& next = around_.beside[side];
            if (!next.isKnown || next.id != around_.self.id) continue;
            if (formOf(around_.self) == 0 && formOf(next) == 0) continue;
            const bool isFull = formOf(next) == 0 && isStillFull(side);
            addFlowSide(side, isFull ? kHeightOfFull : flowHeight(formOf(next)), height);
        }
    }

    void addFlowing(uint form) {
        for (uint side = 0; side < around_.aboveBeside.size(); ++side)
            if (isVisible(side)) addFlowSide(side, 0, flowHeight(form));
        addStepsDown(flowHeight(form));
        addLevelSide(world::kFaceNegZ);
        if ((form & world::kLiquidFalling) != 0)
            addLevelSide(world::kFacePosZ);
        else
            push(shared::kShapeFaceFlowTop + form - 1, type_.material[world::kFacePosZ]);
    }

    void addLevelSide(uint side) {
        if (isVisible(side)) push(shared::kShapeFaceCube + side, type_.material[side]);
    }

    // A still liquid under anything but the same liquid or an opaque cube is surface: its top lies lower.
    void addLiquid() {
        const uint form = formOf(around_.self);
        if (form != 0) return addFlowing(form);
        const bool isSurface = isVisible(world::kFacePosZ);
        addStepsDown(isSurface ? kHeightOfStill : kHeightOfFull);
        for (uint side = 0; side < around_.aboveBeside.size(); ++side) {
            const uint first = isSurface ? shared::kShapeFaceLiquidSide : shared::kShapeFaceCube;
            if (isVisible(side)) push(first + side, type_.material[side]);
        }
        addLevelSide(world::kFaceNegZ);
        if (isSurface) push(shared::kShapeFaceLiquidTop, type_.material[world::kFacePosZ]);
    }

    const CellSurroundings& around_;
    const world::BlockRegistry& blocks_;
    const BlockType& type_;
    std::vector<CellFace>& out_;
};

}  // namespace

void addCellFaces(const CellSurroundings& around, const world::BlockRegistry& blocks,
                  std::vector<CellFace>& out) {
    CellFaces(around, blocks, out).add();
}

std::optional<CellFace> cubeFace(const CellBlock& self, const CellBlock& beside, world::Face side,
                                 const world::BlockRegistry& blocks) {
    if (!isVisible(self, beside, side, blocks)) return std::nullopt;
    const BlockType& type = blocks.type(self.id);
    return faceOf(shared::kShapeFaceCube + side, materialOf(type, self.state, side), blocks);
}

}  // namespace terrane::mesh
