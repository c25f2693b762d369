#include "terrane/mesh/section_faces.h"

#include <algorithm>
#include <cassert>

#include "terrane/mesh/bit_cube.h"
#include "terrane/mesh/face_writer.h"
#include "terrane/mesh/section_bits.h"
#include "terrane/mesh/section_side.h"

namespace terrane::mesh {
namespace {

using shared::uint;
using world::BlockType;
using world::Face;
using world::Shape;

constexpr std::array<Face, world::kFaceCount> kSides{world::kFaceNegX, world::kFacePosX, world::kFaceNegY,
                                                     world::kFacePosY, world::kFaceNegZ, world::kFacePosZ};
constexpr std::size_t kUprightSides = 4;  // the first ones

bool isHidden(const SectionView& view) {
    const world::Section& section = *view.centre;
    const auto invisible = [&](world::BlockId id) { return view.blocks->type(id).shape == Shape::None; };
    if (section.isUniform()) return invisible(section.uniformValue());
    return !section.isDense() && std::all_of(section.palette().begin(), section.palette().end(), invisible);
}

using Borders = std::array<BitSlice, world::kFaceCount>;

// Opaque cubes beyond each side. What lies below the world counts as opaque: its bottom is never seen.
Borders opaqueBorders(const SectionView& view) {
    Borders borders;
    for (const Face side : kSides) {
        const world::Section* next = view.neighbours[side];
        if (next) {
            borders[side] = opaqueOnSide(*next, oppositeSide(side), *view.blocks);
        } else {
            borders[side] = side == world::kFaceNegZ ? filledSlice() : BitSlice{};
        }
    }
    return borders;
}

bool isEnclosed(const Borders& borders) {
    return std::all_of(borders.begin(), borders.end(), [](const BitSlice& b) { return b == filledSlice(); });
}

// The blocks of one type in the section.
struct TypeBlocks {
    const BlockType& type;
    world::BlockId id;
    BitCube alongX;  // rows along x
    BitCube alongY;  // the same with rows along y

    const BitCube& facing(Face side) const { return isAlongX(side) ? alongY : alongX; }
};

class SectionFaces {
  public:
    SectionFaces(const SectionView& view, const Borders& borders, QuadBuckets& out)
        : view_(view), bits_(*view.centre), writer_(view.blocks->materials(), view.baseZ, out) {
        findUncovered(borders);
    }

    void addAll();

  private:
    void findUncovered(const Borders& borders);
    bool isCovered(const BitCube& blocks) const;
    bool hidesOwnKind(const BlockType& type, Face side) const;
    BitCube visible(const TypeBlocks& blocks, Face side) const;
    Merge mergeOf(const BlockType& type, Face side) const;

    void add(const TypeBlocks& blocks);
    void addSide(const TypeBlocks& blocks, Face side);
    void addCube(const TypeBlocks& blocks);
    void addLiquid(const TypeBlocks& blocks);
    void addPlanes(const TypeBlocks& blocks, uint firstFace, uint count);

    const SectionView& view_;
    SectionBits bits_;
    FaceWriter writer_;
    std::array<BitCube, world::kFaceCount> uncovered_;  // blocks whose neighbour on a side is no opaque cube
    BitCube uncoveredAnywhere_;                         // on some side; rows along x
};

void SectionFaces::findUncovered(const Borders& borders) {
    BitCube opaque{};
    for (std::size_t n = 0; n < bits_.ids().size(); ++n) {
        if (!view_.blocks->type(bits_.ids()[n]).opaqueCube) continue;
        const BitCube blocks = bits_.blocks(n);
        for (std::size_t i = 0; i < opaque.size(); ++i) opaque[i] |= blocks[i];
    }
    const BitCube opaqueAlongY = transposed(opaque);
    BitCube all;
    all.fill(~std::uint64_t{0});
    for (const Face side : kSides) {
        const BitCube& cube = isAlongX(side) ? opaqueAlongY : opaque;
        uncovered_[side] = without(all, neighbourBits(cube, side, borders[side]));
    }
    BitCube uncoveredX;
    for (std::size_t i = 0; i < uncoveredX.size(); ++i) {
        uncoveredX[i] = uncovered_[world::kFaceNegX][i] | uncovered_[world::kFacePosX][i];
    }
    uncoveredAnywhere_ = transposed(uncoveredX);
    for (std::size_t i = 0; i < uncoveredX.size(); ++i) {
        uncoveredAnywhere_[i] |= uncovered_[world::kFaceNegY][i] | uncovered_[world::kFacePosY][i] |
                                 uncovered_[world::kFaceNegZ][i] | uncovered_[world::kFacePosZ][i];
    }
}

bool SectionFaces::isCovered(const BitCube& blocks) const {
    return isEmpty(both(blocks, uncoveredAnywhere_));
}

void SectionFaces::addAll() {
    for (std::size_t n = 0; n < bits_.ids().size(); ++n) {
        const world::BlockId id = bits_.ids()[n];
        const BlockType& type = view_.blocks->type(id);
        if (type.shape == Shape::None) continue;
        const BitCube blocks = bits_.blocks(n);
        // Planes inside the cell are drawn also where all neighbours are opaque; of other shapes nothing is
        // seen then.
        const bool hasPlanes = type.shape != Shape::Cube && type.shape != Shape::Liquid;
        if (hasPlanes ? isEmpty(blocks) : isCovered(blocks)) continue;
        add({type, id, blocks, transposed(blocks)});
    }
}

void SectionFaces::add(const TypeBlocks& blocks) {
    switch (blocks.type.shape) {
        case Shape::None:
            return;
        case Shape::Cube:
            return addCube(blocks);
        case Shape::Liquid:
            return addLiquid(blocks);
        case Shape::Cross:
            return addPlanes(blocks, shared::kShapeFaceCross, 2);
        case Shape::Hash:
            return addPlanes(blocks, shared::kShapeFaceHash, 4);
        case Shape::Inset:
            addPlanes(blocks, shared::kShapeFaceInset, 4);
            addSide(blocks, world::kFaceNegZ);
            addSide(blocks, world::kFacePosZ);
    }
}

// Whether a face toward a block of the same type is left out. Where faces inside are drawn and both of a pair
// can be seen from both sides, the pair would be the same face twice: the block at the lower coordinate draws
// it.
bool SectionFaces::hidesOwnKind(const BlockType& type, Face side) const {
    if (!type.innerFaces || type.shape == Shape::Liquid) return true;
    const bool isPositive = side % 2 == 1;
    return !isPositive && view_.blocks->materials()[type.material[oppositeSide(side)]].twoSided;
}

BitCube SectionFaces::visible(const TypeBlocks& blocks, Face side) const {
    const BitCube faces = both(blocks.facing(side), uncovered_[side]);
    if (blocks.type.opaqueCube || !hidesOwnKind(blocks.type, side)) return faces;
    const world::Section* next = view_.neighbours[side];
    const BitSlice border = next ? blocksOnSide(*next, oppositeSide(side), blocks.id) : BitSlice{};
    return without(faces, neighbourBits(blocks.facing(side), side, border));
}

// Where only the top of a texture waves, a face taller than one block would wave only at its top.
Merge SectionFaces::mergeOf(const BlockType& type, Face side) const {
    const world::Material& material = view_.blocks->materials()[type.material[side]];
    return material.animation == world::Animation::TopWaves ? Merge::None : Merge::Full;
}

void SectionFaces::addSide(const TypeBlocks& blocks, Face side) {
    const BlockType& type = blocks.type;
    writer_.write(visible(blocks, side),
                  {shared::kShapeFaceCube + side, type.material[side], mergeOf(type, side), side});
}

void SectionFaces::addCube(const TypeBlocks& blocks) {
    for (const Face side : kSides) addSide(blocks, side);
}

// Blocks under anything but the same liquid or an opaque cube are surface: their top lies lower, and so do
// their sides. These merge along u only, since no surface block stands on another. Of a full block beside a
// surface block the strip above that surface is left out.
void SectionFaces::addLiquid(const TypeBlocks& blocks) {
    const BlockType& type = blocks.type;
    const BitCube surface = visible(blocks, world::kFacePosZ);
    const BitCube surfaceAlongY = transposed(surface);
    for (std::size_t s = 0; s < kUprightSides; ++s) {
        const Face side = kSides[s];
        const BitCube faces = visible(blocks, side);
        const BitCube& lowered = isAlongX(side) ? surfaceAlongY : surface;
        writer_.write(without(faces, lowered),
                      {shared::kShapeFaceCube + side, type.material[side], mergeOf(type, side), side});
        writer_.write(both(faces, lowered),
                      {shared::kShapeFaceLiquidSide + side, type.material[side], mergeOf(type, side), side});
    }
    addSide(blocks, world::kFaceNegZ);
    writer_.write(surface, {shared::kShapeFaceLiquidTop, type.material[world::kFacePosZ],
                            mergeOf(type, world::kFacePosZ), world::kFacePosZ});
}

// Plane k has the material of side k.
void SectionFaces::addPlanes(const TypeBlocks& blocks, uint firstFace, uint count) {
    for (uint k = 0; k < count; ++k) {
        writer_.write(blocks.alongX, {firstFace + k, blocks.type.material[k], Merge::None, world::kFacePosZ});
    }
}

}  // namespace

void addSectionFaces(const SectionView& view, QuadBuckets& out) {
    assert(view.centre && view.blocks && "a section and what its ids mean");
    assert(view.baseZ % world::kSectionSize == 0 && world::isInHeight(view.baseZ) && "height of a section");
    if (isHidden(view)) return;
    const Borders borders = opaqueBorders(view);
    if (isEnclosed(borders) && isAllOpaque(*view.centre, *view.blocks)) return;
    SectionFaces(view, borders, out).addAll();
}

}  // namespace terrane::mesh
