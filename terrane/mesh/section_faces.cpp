#include "terrane/mesh/section_faces.h"

#include <algorithm>
#include <bit>
#include <bitset>
#include <cassert>
#include <cstring>
#include <optional>
#include <type_traits>

#include "terrane/mesh/bit_cube.h"
#include "terrane/mesh/bit_kernels.h"
#include "terrane/mesh/face_writer.h"
#include "terrane/mesh/model_faces.h"

namespace terrane::mesh {

namespace {

using Word = std::uint64_t;
using world::BlockId;

std::vector<BlockId> distinctIds(const world::Section& section) {
    if (section.isUniform()) return {section.uniformValue()};
    if (!section.isDense()) return {section.palette().begin(), section.palette().end()};
    std::bitset<65536> seen;
    std::vector<BlockId> ids;
    for (const Word word : section.words()) {
        for (int shift = 0; shift < 64; shift += 16) {
            const auto id = static_cast<BlockId>(word >> shift);
            if (!seen[id]) ids.push_back(id);
            seen[id] = true;
        }
    }
    return ids;
}

}  // namespace

SectionBits::SectionBits(const world::Section& section)
    : bits_(static_cast<std::size_t>(section.bits())), ids_(distinctIds(section)) {
    const std::span<const Word> words = section.words();
    assert(words.size() == 64 * bits_ && "4,096 blocks of bits() each");
    sortIntoPlanes(words.data(), bits_, kGroups, planes_.data());
}

BitCube SectionBits::blocks(std::size_t number) const {
    assert(number < ids_.size() && "number of an id");
    const std::size_t index = bits_ == kMaxBits ? ids_[number] : number;
    BitCube out;
    blocksOfIndex({planes_.data(), bits_, kGroups}, index, out.data());
    return out;
}

namespace {

using world::Section;

static_assert(std::endian::native == std::endian::little, "packed words are read in memory order");

// Indices of the blocks in a layer: first + row·rowStep + bit·bitStep.
struct LayerIndices {
    std::size_t first, rowStep, bitStep;
};

constexpr std::array<LayerIndices, world::kFaceCount> kLayers{{
    {0, 256, 16},       // -x: x = 0; rows z, bits y
    {15, 256, 16},      // +x
    {0, 256, 1},        // -y: y = 0; rows z, bits x
    {15 * 16, 256, 1},  // +y
    {0, 16, 1},         // -z: z = 0; rows y, bits x
    {15 * 256, 16, 1},  // +z
}};

// Copies rows whose blocks are contiguous in the section: 16 blocks are 2·bits bytes.
template <std::size_t kBits>
void copyRows(const std::byte* section, const LayerIndices& layer, std::byte* out) {
    for (std::size_t row = 0; row < 16; ++row) {
        std::memcpy(out + row * 2 * kBits, section + (layer.first + row * layer.rowStep) * kBits / 8,
                    2 * kBits);
    }
}

// Collects rows of blocks that lie 16 apart: the first or the last of each 16.
template <std::size_t kBits, bool kLast>
void collectRows(const std::byte* section, std::uint64_t* out) {
    using Unit = std::conditional_t<kBits == 16, std::uint16_t, std::uint8_t>;  // has the block's bits
    constexpr unsigned kShift = kLast && kBits < 8 ? 8 - kBits : 0;
    constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;
    constexpr std::size_t kPerWord = 64 / kBits;
    const std::byte* at = section + (kLast ? 2 * kBits - sizeof(Unit) : 0);
    for (std::size_t w = 0; w < 256 / kPerWord; ++w) {
        std::uint64_t word = 0;
#pragma GCC unroll 64
        for (std::size_t k = 0; k < kPerWord; ++k, at += 2 * kBits) {
            Unit unit;
            std::memcpy(&unit, at, sizeof(unit));
            word |= (std::uint64_t{unit} >> kShift & kMask) << (k * kBits);
        }
        out[w] = word;
    }
}

template <std::size_t kBits>
void copyLayer(const Section& section, world::Face side, std::uint64_t* out) {
    const auto* bytes = reinterpret_cast<const std::byte*>(section.words().data());
    if (side == world::kFaceNegX) return collectRows<kBits, false>(bytes, out);
    if (side == world::kFacePosX) return collectRows<kBits, true>(bytes, out);
    copyRows<kBits>(bytes, kLayers[side], reinterpret_cast<std::byte*>(out));
}

constexpr BitSlice filledIf(bool filled) {
    return filled ? filledSlice() : BitSlice{};
}

}  // namespace

SectionSide::SectionSide(const Section& section, world::Face side) : section_(section), side_(side) {
    assert(side < world::kFaceCount && "one of six sides");
    std::array<std::uint64_t, kGroups * 16> packed;
    switch (section.bits()) {
        case 0:
            return;
        case 1:
            copyLayer<1>(section, side, packed.data());
            break;
        case 2:
            copyLayer<2>(section, side, packed.data());
            break;
        case 4:
            copyLayer<4>(section, side, packed.data());
            break;
        case 8:
            copyLayer<8>(section, side, packed.data());
            break;
        default:
            copyLayer<16>(section, side, packed.data());
    }
    sortIntoPlanes(packed.data(), static_cast<std::size_t>(section.bits()), kGroups, planes_.data());
}

BitSlice SectionSide::blocksOfIndex(std::size_t index) const {
    std::array<std::uint64_t, kGroups> words;
    mesh::blocksOfIndex({planes_.data(), static_cast<std::size_t>(section_.bits()), kGroups}, index,
                        words.data());
    BitSlice slice;
    std::memcpy(slice.data(), words.data(), sizeof(slice));
    return slice;
}

BitSlice SectionSide::opaqueCubes(const world::BlockRegistry& blocks) const {
    if (section_.isUniform()) return filledIf(blocks.type(section_.uniformValue()).opaqueCube);
    if (section_.isDense()) return denseOpaqueCubes(blocks);
    const std::span<const BlockId> palette = section_.palette();
    BitSlice slice{};
    for (std::size_t index = 0; index < palette.size(); ++index) {
        if (!blocks.type(palette[index]).opaqueCube) continue;
        const BitSlice more = blocksOfIndex(index);
        for (std::size_t row = 0; row < 16; ++row) slice[row] |= more[row];
    }
    return slice;
}

// A dense section may have thousands of ids, so its blocks are tested one by one.
BitSlice SectionSide::denseOpaqueCubes(const world::BlockRegistry& blocks) const {
    const LayerIndices layer = kLayers[side_];
    BitSlice slice{};
    for (std::size_t row = 0; row < 16; ++row) {
        unsigned set = 0;
        for (std::size_t bit = 0; bit < 16; ++bit) {
            const auto index = static_cast<int>(layer.first + row * layer.rowStep + bit * layer.bitStep);
            set |= unsigned{blocks.type(section_.get(index)).opaqueCube} << bit;
        }
        slice[row] = static_cast<std::uint16_t>(set);
    }
    return slice;
}

BitSlice SectionSide::blocks(BlockId id) const {
    if (section_.isUniform()) return filledIf(section_.uniformValue() == id);
    if (section_.isDense()) return blocksOfIndex(id);
    const std::span<const BlockId> palette = section_.palette();
    const auto found = std::find(palette.begin(), palette.end(), id);
    if (found == palette.end()) return {};
    return blocksOfIndex(static_cast<std::size_t>(found - palette.begin()));
}

bool isAllOpaque(const Section& section, const world::BlockRegistry& blocks) {
    const auto opaque = [&](BlockId id) { return blocks.type(id).opaqueCube; };
    if (section.isUniform()) return opaque(section.uniformValue());
    return !section.isDense() && std::all_of(section.palette().begin(), section.palette().end(), opaque);
}

namespace {

using shared::uint;
using world::BlockType;
using world::Face;
using world::Shape;

constexpr std::array<Face, world::kFaceCount> kSides{world::kFaceNegX, world::kFacePosX, world::kFaceNegY,
                                                     world::kFacePosY, world::kFaceNegZ, world::kFacePosZ};
constexpr std::size_t kUprightSides = 4;  // the first ones

bool isHidden(const SectionView& view) {
    const world::Section& section = *view.center;
    const auto invisible = [&](world::BlockId id) { return view.blocks->type(id).shape == Shape::None; };
    if (section.isUniform()) return invisible(section.uniformValue());
    return !section.isDense() && std::all_of(section.palette().begin(), section.palette().end(), invisible);
}

using Borders = std::array<BitSlice, world::kFaceCount>;

// The neighbors of a section.
struct Surroundings {
    explicit Surroundings(const SectionView& view);
    bool isEnclosed() const {
        return std::all_of(opaque.begin(), opaque.end(),
                           [](const BitSlice& b) { return b == filledSlice(); });
    }

    std::array<std::optional<SectionSide>, world::kFaceCount>
        sides;  // none beyond the world or an open border
    // Opaque cubes beyond each side. Below the world all blocks count as opaque: its bottom is never seen.
    Borders opaque{};
};

Surroundings::Surroundings(const SectionView& view) {
    for (const Face side : kSides) {
        const world::Section* next = view.neighbors[side];
        if (next) opaque[side] = sides[side].emplace(*next, oppositeSide(side)).opaqueCubes(*view.blocks);
    }
    if (!sides[world::kFaceNegZ]) opaque[world::kFaceNegZ] = filledSlice();
}

// The blocks of one type in the section.
struct TypeBlocks {
    const BlockType& type;
    world::BlockId id;
    LayerRange layers;  // may have visible faces; alongY has only these
    BitCube alongX;     // rows along x
    BitCube alongY;     // the same with rows along y

    const BitCube& facing(Face side) const { return isAlongX(side) ? alongY : alongX; }
};

class SectionFaces {
  public:
    SectionFaces(const SectionView& view, const Surroundings& around, QuadCollector& out)
        : view_(view),
          around_(around),
          bits_(*view.center),
          writer_(view.blocks->materials(), view.target, out),
          out_(out),
          hasFlow_(hasFlow(view)) {
        findUncovered();
    }

    void addAll();

  private:
    void findUncovered();
    LayerRange visibleLayers(const BlockType& type, const BitCube& blocks) const;
    BitSlice ownKindBeyond(world::BlockId id, Face side) const;
    BitCube visible(const TypeBlocks& blocks, Face side) const;
    bool merges(const BlockType& type, Face side) const { return mergesFaces(type, side, *view_.blocks); }

    void add(const TypeBlocks& blocks);
    void addSide(const TypeBlocks& blocks, Face side);
    void addCube(const TypeBlocks& blocks);
    void addLiquid(const TypeBlocks& blocks);
    void addStillLiquid(const TypeBlocks& blocks, const BitCube& still);
    void addPlanes(const TypeBlocks& blocks, uint firstFace, uint count);
    void addGrowingPlanes(const TypeBlocks& blocks, uint firstFace, uint count);

    const SectionView& view_;
    const Surroundings& around_;
    SectionBits bits_;
    FaceWriter writer_;
    QuadCollector& out_;
    bool hasFlow_;
    std::array<BitCube, world::kFaceCount> uncovered_;  // blocks whose neighbor on a side is no opaque cube
    BitCube uncoveredAnywhere_;                         // on some side; rows along x
};

void SectionFaces::findUncovered() {
    BitCube opaque{};
    for (std::size_t n = 0; n < bits_.ids().size(); ++n) {
        if (!view_.blocks->type(bits_.ids()[n]).opaqueCube) continue;
        const BitCube blocks = bits_.blocks(n);
        for (std::size_t i = 0; i < opaque.size(); ++i) opaque[i] |= blocks[i];
    }
    const BitCube opaqueAlongY = transposed(opaque);
    for (const Face side : kSides) {
        const BitCube& cube = isAlongX(side) ? opaqueAlongY : opaque;
        uncovered_[side] = neighborBits(cube, side, around_.opaque[side]);
        for (std::uint64_t& word : uncovered_[side]) word = ~word;
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

// Shapes with planes inside the cell, and low surfaces of liquids, are visible even if all neighbors are
// opaque; other shapes are not.
LayerRange SectionFaces::visibleLayers(const BlockType& type, const BitCube& blocks) const {
    const bool hasPlanes = type.shape != Shape::Cube && (type.shape != Shape::Liquid || hasFlow_);
    return commonLayers(blocks, hasPlanes ? blocks : uncoveredAnywhere_, view_.target.layers);
}

void SectionFaces::addAll() {
    for (std::size_t n = 0; n < bits_.ids().size(); ++n) {
        const world::BlockId id = bits_.ids()[n];
        const BlockType& type = view_.blocks->type(id);
        if (type.shape == Shape::None) continue;
        const BitCube blocks = bits_.blocks(n);
        const LayerRange layers = visibleLayers(type, blocks);
        if (!layers.isEmpty()) add({type, id, layers, blocks, transposed(blocks, layers)});
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
            return;
        case Shape::Model:
            addModelFaces({view_, blocks.type, blocks.alongX, blocks.layers}, uncovered_, out_);
    }
}

// Beyond an open border every block counts as the same type.
BitSlice SectionFaces::ownKindBeyond(world::BlockId id, Face side) const {
    const auto& next = around_.sides[side];
    if (next) return next->blocks(id);
    return side < kUprightSides ? filledSlice() : BitSlice{};
}

BitCube SectionFaces::visible(const TypeBlocks& blocks, Face side) const {
    const LayerRange layers = blocks.layers;
    const BitCube faces = both(blocks.facing(side), uncovered_[side], layers);
    if (blocks.type.opaqueCube || !hidesSameType(blocks.type, side, *view_.blocks)) return faces;
    return without(faces, neighborBits(blocks.facing(side), side, ownKindBeyond(blocks.id, side), layers),
                   layers);
}

void SectionFaces::addSide(const TypeBlocks& blocks, Face side) {
    const BlockType& type = blocks.type;
    writer_.write(visible(blocks, side),
                  {shared::kShapeFaceCube + side, type.material[side], merges(type, side), side},
                  blocks.layers);
}

void SectionFaces::addCube(const TypeBlocks& blocks) {
    for (const Face side : kSides) addSide(blocks, side);
}

void SectionFaces::addLiquid(const TypeBlocks& blocks) {
    if (!hasFlow_) return addStillLiquid(blocks, blocks.alongX);
    const ModelBlocks liquid{view_, blocks.type, blocks.alongX, blocks.layers};
    const BitCube still = without(blocks.alongX, flowingBlocks(liquid), blocks.layers);
    addStillLiquid(blocks, still);
    addFlowFaces(liquid, both(visible(blocks, world::kFacePosZ), still, blocks.layers), uncovered_, out_);
}

// Blocks under anything but the same liquid or an opaque cube are surface: their top lies lower, and so do
// their sides. These merge along u only, since no surface block stands on another. A full block next to a
// surface block has no face for the strip above that surface.
void SectionFaces::addStillLiquid(const TypeBlocks& blocks, const BitCube& still) {
    const BlockType& type = blocks.type;
    const BitCube stillAlongY = transposed(still, blocks.layers);
    const auto seen = [&](Face side) {
        return both(visible(blocks, side), isAlongX(side) ? stillAlongY : still, blocks.layers);
    };
    const auto kind = [&](Face side, uint shapeFace) {
        return FaceKind{shapeFace, type.material[side], merges(type, side), side};
    };
    const BitCube surface = seen(world::kFacePosZ);
    const BitCube surfaceAlongY = transposed(surface, blocks.layers);
    for (std::size_t s = 0; s < kUprightSides; ++s) {
        const Face side = kSides[s];
        const BitCube faces = seen(side);
        const BitCube& lowered = isAlongX(side) ? surfaceAlongY : surface;
        writer_.write(without(faces, lowered, blocks.layers), kind(side, shared::kShapeFaceCube + side),
                      blocks.layers);
        writer_.write(both(faces, lowered, blocks.layers), kind(side, shared::kShapeFaceLiquidSide + side),
                      blocks.layers);
    }
    writer_.write(seen(world::kFaceNegZ), kind(world::kFaceNegZ, shared::kShapeFaceCube + world::kFaceNegZ),
                  blocks.layers);
    writer_.write(surface, kind(world::kFacePosZ, shared::kShapeFaceLiquidTop), blocks.layers);
}

// Plane k has the material of side k.
void SectionFaces::addPlanes(const TypeBlocks& blocks, uint firstFace, uint count) {
    const world::Section& blockState = *view_.blockState;
    const bool isGrown = blockState.isUniform() && blockState.uniformValue() == 0;
    if (!blocks.type.growth.empty() && !isGrown) return addGrowingPlanes(blocks, firstFace, count);
    for (uint k = 0; k < count; ++k) {
        writer_.write(blocks.alongX, {firstFace + k, blocks.type.material[k], false, world::kFacePosZ},
                      blocks.layers);
    }
}

// Adds the blocks of each stage by themselves; block state without a stage counts as the youngest.
void SectionFaces::addGrowingPlanes(const TypeBlocks& blocks, uint firstFace, uint count) {
    const std::vector<std::uint16_t>& growth = blocks.type.growth;
    for (std::size_t left = 0; left <= growth.size(); ++left) {
        const BitCube stage = blocksWhere(blocks.alongX, blocks.layers, [&](std::size_t block) {
            return std::min<std::size_t>(view_.blockState->get(static_cast<int>(block)), growth.size()) ==
                   left;
        });
        for (uint k = 0; k < count; ++k) {
            const std::uint16_t material = left == 0 ? blocks.type.material[k] : growth[left - 1];
            writer_.write(stage, {firstFace + k, material, false, world::kFacePosZ}, blocks.layers);
        }
    }
}

}  // namespace

void addSectionFaces(const SectionView& view, QuadCollector& out) {
    assert(view.center && view.blocks && "a section and what its ids mean");
    assert(view.target.baseZ % world::kSectionSize == 0 && "height of a section");
    if (isHidden(view)) return;
    const Surroundings around(view);
    if (around.isEnclosed() && isAllOpaque(*view.center, *view.blocks)) return;
    SectionFaces(view, around, out).addAll();
}

}  // namespace terrane::mesh
