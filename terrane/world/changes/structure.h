// A box of blocks copied from a world: it can be turned, mirrored, saved (store/chunks/structure_file.h) and
// placed in any world, also with other block ids. All are plain values; any thread may use them.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/blocks/block_type.h"
#include "terrane/world/coords.h"
#include "terrane/world/world.h"

namespace terrane::world {

// Block states of turned and mirrored blocks. The functions have no state; any thread may call them.
enum class MirrorAxis : std::uint8_t { X, Y };  // the coordinate that changes its sign

// Returns the bits of the state that depend on the neighbors of a block (`connects`).
std::uint16_t armBits(const BlockType& type);

// Returns the state of the block after `turns` quarter turns about z, counterclockwise seen from above: +x
// becomes +y. Facing and arms turn, all else stays. Any number of turns, also below 0.
std::uint16_t turnedState(const BlockType& type, std::uint16_t state, int turns);

// Returns the state of the block seen in a mirror. A shape that is not its own mirror image (an open door)
// faces the mirrored way and keeps its hinge.
std::uint16_t mirroredState(const BlockType& type, std::uint16_t state, MirrorAxis axis);

// A copy has 500,000 × 4 bytes of cells = 2 MB. Placing takes 168 bytes a block with its step to undo (the
// plan, the old blocks, both values, the event): 84 MB, and half a second (docs/performance.md).
constexpr std::int64_t kMaxStructureBlocks = 500'000;

struct StructureBlock {
    std::string name;  // of the block type: a name keeps its meaning when ids change
    std::uint16_t state = 0;

    bool operator==(const StructureBlock&) const = default;
};

// Block entity data of one cell.
struct StructureData {
    std::uint32_t cell = 0;
    BlockEntityDataPtr data;  // not null
};

struct Structure {
    glm::ivec3 size{0};                   // in blocks, each at least 1; 0 where there is nothing
    std::vector<StructureBlock> palette;  // different ones, in the order in which cells first have them
    std::vector<std::uint32_t> cells;     // indices into the palette: x + size.x · (y + size.y · z)
    std::vector<StructureData> data;      // by cell, in ascending order

    std::int64_t blockCount() const { return std::int64_t{size.x} * size.y * size.z; }
    std::uint32_t cellAt(glm::ivec3 at) const {
        return static_cast<std::uint32_t>(at.x + size.x * (at.y + size.y * at.z));
    }
    friend bool operator==(const Structure& a, const Structure& b);  // data byte by byte
};

// Copies the blocks of a box, at most kMaxStructureBlocks; air where no chunk is loaded.
Structure copyBlocks(const World& world, const BlockRegistry& blocks, const BlockBox& box);

// Returns the structure turned about z by quarter turns, counterclockwise seen from above: a wall along x
// becomes one along y. The lowest corner stays the lowest corner.
Structure turnedStructure(const Structure& structure, const BlockRegistry& blocks, int turns);
Structure mirroredStructure(const Structure& structure, const BlockRegistry& blocks, MirrorAxis axis);

// Returns the palette as values of a session; names that the registry lacks become "missing".
std::vector<BlockValue> paletteValues(const Structure& structure, const BlockRegistry& blocks);
// Returns the names of the palette that the registry lacks, each once.
std::vector<std::string> unknownNames(const Structure& structure, const BlockRegistry& blocks);

}  // namespace terrane::world
