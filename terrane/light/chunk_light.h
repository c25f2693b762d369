// The light of a chunk: its levels in bricks of 16³, one for each section. A plain value; copies share the
// memory of their bricks. Shared between threads as `shared_ptr<const ChunkLight>`, like the chunk itself.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "terrane/world/coords.h"
#include "terrane/world/section.h"

namespace terrane::light {

// Light of a block: four levels of 0…15. Any thread may use it. Red in bits 0–3, green 4–7, blue 8–11,
// daylight 12–15.
using LightValue = std::uint16_t;

enum LightComponent : int { kRed, kGreen, kBlue, kDaylight, kComponentCount };

constexpr int kMaxLevel = 15;
constexpr LightValue kDark = 0;
constexpr LightValue kFullDaylight = kMaxLevel << 12;

constexpr int levelOf(LightValue value, int component) {
    return value >> (4 * component) & kMaxLevel;
}

constexpr LightValue withLevel(LightValue value, int component, int level) {
    return static_cast<LightValue>((value & ~(kMaxLevel << 4 * component)) | level << 4 * component);
}

// Returns a value with the same level in all four components, the form of opacities.
constexpr LightValue allComponents(int level) {
    return static_cast<LightValue>(level * 0x1111);
}

// A brick of one value takes no memory beside the object; others have a palette with 1, 2, 4 or 8 bits a
// block, or are dense (8 KiB). Index in a brick: x + 16 y + 256 z, as in a section of blocks.
using LightBrick = world::Section;

// Blocks and bricks are in the light's heights; a brick has the number of its section (world/heights.h).
class ChunkLight {
  public:
    // Dark.
    explicit ChunkLight(world::Heights heights = {})
        : heights_(heights), bricks_(static_cast<std::size_t>(heights.sections())) {}

    world::Heights heights() const { return heights_; }

    LightValue at(world::BlockIndex i) const {
        return brick(world::sectionOf(i)).get(world::indexInSection(i));
    }
    // Returns the light of a block: x and y in the chunk, 0…15; z in the heights.
    LightValue get(int x, int y, int z) const { return at(world::blockIndex(x, y, z)); }

    const LightBrick& brick(int number) const { return bricks_[place(number)]; }
    void setBrick(int number, LightBrick brick) { bricks_[place(number)] = std::move(brick); }

    std::size_t memoryBytes() const {  // heap and object
        std::size_t bytes = sizeof(ChunkLight);
        for (const LightBrick& brick : bricks_) bytes += brick.memoryBytes();
        return bytes;
    }

    friend bool operator==(const ChunkLight&, const ChunkLight&) = default;

  private:
    std::size_t place(int number) const {
        assert(number >= heights_.firstSection() && number < heights_.endSection() && "a brick of the chunk");
        return static_cast<std::size_t>(number - heights_.firstSection());
    }

    world::Heights heights_;
    std::vector<LightBrick> bricks_;  // from the bottom
};

using ChunkLightPtr = std::shared_ptr<const ChunkLight>;

}  // namespace terrane::light
