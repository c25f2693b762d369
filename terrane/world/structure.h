// A box of blocks copied from a world: it can be turned, mirrored, saved (store/structure_file.h) and placed
// in any world, also with other block ids. Plain values; any thread.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "terrane/world/block_registry.h"
#include "terrane/world/block_value.h"
#include "terrane/world/coords.h"
#include "terrane/world/turned_state.h"

namespace terrane::world {

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

// Turned about z by quarters, counterclockwise seen from above: a wall along x becomes one along y. The
// lowest corner stays the lowest corner.
Structure turnedStructure(const Structure& structure, const BlockRegistry& blocks, int turns);
Structure mirroredStructure(const Structure& structure, const BlockRegistry& blocks, MirrorAxis axis);

// The palette as values of a session; names that the registry lacks become "missing".
std::vector<BlockValue> paletteValues(const Structure& structure, const BlockRegistry& blocks);
// Names of the palette that the registry lacks, each once.
std::vector<std::string> unknownNames(const Structure& structure, const BlockRegistry& blocks);

}  // namespace terrane::world
