// Unpacked bricks to compute with: 16³ values of 16 bits, light or opacities (the same number in all four
// nibbles). Index: x + 16 y + 256 z, so that 16 values along x, a row, are 32 bytes. Part of LocalLight
// (light_chunk.h).
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "terrane/light/chunk_light.h"

namespace terrane::light {

struct Brick {
    alignas(64) std::array<LightValue, world::kBlocksPerSection> values;
};

// A brick that somebody else keeps. `writable` is null where it must not be changed.
struct BrickView {
    const LightValue* values = nullptr;
    LightValue* writable = nullptr;
    bool isUniform = false;  // known to hold one value only

    LightValue uniformValue() const { return values[0]; }
};

// Of uniform bricks the usual values exist once: darkness, full daylight and the sixteen opacities. 136 KiB.
// Null for other values.
const Brick* sharedUniformBrick(LightValue value);

// The smallest form of the values.
LightBrick packBrick(BrickView view);

// Keeps bricks for a computation and hands them out again for the next. One thread at a time.
class BrickPool {
  public:
    // 8 KiB with any content, valid until reset() or release().
    Brick* acquire();
    BrickView uniform(LightValue value);
    BrickView unpack(const LightBrick& brick);
    // Everything acquired may be handed out again.
    void reset();
    // Everything acquired so far, for the caller to keep.
    std::vector<std::unique_ptr<Brick>> release();

  private:
    std::vector<std::unique_ptr<Brick>> used_, spare_;
};

}  // namespace terrane::light
