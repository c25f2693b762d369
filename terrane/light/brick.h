// Unpacked bricks to compute with: 16³ values of 16 bits, light or opacities (the same number in all four
// nibbles). The index is x + 16 y + 256 z, so that 16 values along x, a row, are 32 bytes. It is a part of
// LocalLight (light_chunk.h).
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

// View of a brick that is owned elsewhere. `writable` is null if it must not be changed.
struct BrickView {
    const LightValue* values = nullptr;
    LightValue* writable = nullptr;
    bool isUniform = false;  // known to hold one value only

    LightValue uniformValue() const { return values[0]; }
};

// Returns the shared uniform brick of a common value: darkness, full daylight and the sixteen opacities, 136
// KiB in all. Returns null for other values.
const Brick* sharedUniformBrick(LightValue value);

// Packs the values into their smallest form.
LightBrick packBrick(BrickView view);

// Owns the bricks of a computation and reuses them for the next. One thread at a time may use it.
class BrickPool {
  public:
    // Returns a brick of 8 KiB with undefined content, valid until reset() or release().
    Brick* acquire();
    BrickView uniform(LightValue value);
    BrickView unpack(const LightBrick& brick);
    // Makes all acquired bricks available again.
    void reset();
    // Gives ownership of all acquired bricks to the caller.
    std::vector<std::unique_ptr<Brick>> release();

  private:
    std::vector<std::unique_ptr<Brick>> used_, spare_;
};

}  // namespace terrane::light
