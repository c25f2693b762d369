// The blocks of a chunk that a 3D pass makes, by layers: the memory of a chunk follows its content.
//
// A section whose layers were filled with one block owns nothing; other sections own 8 KiB. clear() keeps
// that memory for the next chunk. One thread writes; any thread may read what no thread writes any more.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "terrane/gen/compile/program.h"
#include "terrane/gen/cpu/range_kernels.h"
#include "terrane/world/coords.h"

namespace terrane::gen {

class BlockLayers {
  public:
    explicit BlockLayers(world::Heights heights = {});
    BlockLayers(BlockLayers&&) noexcept = default;
    BlockLayers& operator=(BlockLayers&&) noexcept = default;

    world::Heights heights() const { return heights_; }

    // Returns the kTileLanes blocks of a layer, x + 16 y. Layers that were not written since clear() have any
    // blocks.
    const std::uint16_t* layer(int z) const {
        const Part& part = partOf(z);
        return part.blocks + (z & (world::kSectionSize - 1)) * part.step;
    }
    // Returns the lowest and the highest block of a layer.
    BlockRange range(int z) const {
        const Part& part = partOf(z);
        if (part.step == 0) return {*part.blocks, *part.blocks};
        return part.own->ranges[static_cast<std::size_t>(z & (world::kSectionSize - 1))];
    }

    struct LayersRange {
        BlockRange blocks;
        bool isAlike;  // all layers have this range
    };
    // Returns the range of layers first…last. Returns nothing if they are too many to look at; sections of
    // one block count as one layer.
    std::optional<LayersRange> range(int first, int last) const;

    // Returns the block of all layers of a section, by its absolute number, if they are surely one block.
    std::optional<std::uint16_t> uniformBlock(int section) const;
    // Returns the blocks of a section by world::indexInSection; only where uniformBlock() returns nothing.
    std::span<const std::uint16_t, world::kBlocksPerSection> section(int number) const;

    // Forgets all blocks.
    void clear();
    // The functions below write whole layers, each at most once after clear().
    void fill(int z, int count, std::uint16_t block);
    void write(int z, const Bits* values);  // the lower halves of kTileLanes values, 64-byte aligned
    void copy(const BlockLayers& from, int z, int count);  // of the same heights
    void repeat(int z, int count);                         // copies layer z to those up to z + count − 1

    // Returns the blocks of a layer to change some of them. Its range becomes that of all blocks.
    std::uint16_t* edit(int z) {
        Part& part = partOf(z);
        Owned& owned = part.own ? *part.own : own(part);
        const auto k = static_cast<std::size_t>(z & (world::kSectionSize - 1));
        owned.ranges[k] = {0, UINT16_MAX};
        return owned.blocks.data() + k * kTileLanes;
    }

    // Frees memory that no layer needs; for blocks that stay as they are.
    void compact();
    std::size_t memoryBytes() const;  // heap and object

  private:
    struct Owned {
        alignas(64) std::array<std::uint16_t, world::kBlocksPerSection> blocks;
        std::array<BlockRange, world::kSectionSize> ranges;
    };
    // A section. `step`: from one layer to the next, 0 where one layer stands for all.
    struct Part {
        const std::uint16_t* blocks;
        std::unique_ptr<Owned> own;
        std::uint16_t step = 0;
        std::uint16_t written = 0;  // where nothing is owned: bits of the layers that were written
    };
    using Layer = std::array<std::uint16_t, kTileLanes>;

    std::size_t placeOf(int z) const { return static_cast<std::size_t>((z - heights_.bottom) >> 4); }
    const Part& partOf(int z) const { return parts_[placeOf(z)]; }
    Part& partOf(int z) { return parts_[placeOf(z)]; }
    Owned& own(Part& part);
    const std::uint16_t* constantLayer(std::uint16_t block);
    void fillPart(Part& part, int first, int count, const std::uint16_t* layer);

    world::Heights heights_;
    std::vector<Part> parts_;                        // from the bottom
    std::vector<std::unique_ptr<Layer>> constants_;  // each of one block; air comes first
    std::vector<std::unique_ptr<Owned>> spare_;
};

}  // namespace terrane::gen
