// The working area of the solver: 3×3 chunks of bricks surrounded by darkness, and the rows that are to be
// processed. It is a part of LightScratch (light_chunk.h); one thread at a time uses it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrane/light/brick.h"

namespace terrane::light {

constexpr int kFieldSide = 3;    // chunks along x and y
constexpr int kCenterChunk = 4;  // index of a chunk: x + 3 y
constexpr int kFieldChunks = kFieldSide * kFieldSide;
constexpr int kRowsPerBrick = 256;  // index of a row: y + 16 z

// A brick of the field. Bricks outside are dark and opaque, so that no code needs to test for them.
struct FieldBrick {
    BrickView light;
    const LightValue* opacity = nullptr;
    // Levels up to this (16 × 16, the same for all z) cannot reach the middle chunk and may be dropped.
    const LightValue* reach = nullptr;
    // In the decrease queue (relight.cpp) `light` holds the levels to remove. These are the light before the
    // change, and the sources of the changed world.
    const LightValue* before = nullptr;
    const LightValue* source = nullptr;
    std::array<std::uint64_t, kRowsPerBrick / 64> dirty{};  // rows to process, a bit each
    bool isInside = false;
    bool isQueued = false;
};

class LightField {
  public:
    // Steps between neighbors in the array of bricks.
    static constexpr int kStepX = 1, kStepY = kFieldSide + 2, kStepZ = kStepY * kStepY;

    LightField() { reset(); }
    void reset();  // all bricks outside, no marked rows

    // Returns the index of brick 0…15, from below, of chunk 0…8.
    static int indexOf(int chunk, int brick) {
        return (chunk % kFieldSide + 1) * kStepX + (chunk / kFieldSide + 1) * kStepY + (brick + 1) * kStepZ;
    }
    FieldBrick& brick(int index) { return bricks_[static_cast<std::size_t>(index)]; }
    FieldBrick& brick(int chunk, int number) { return brick(indexOf(chunk, number)); }

    void markRow(int index, int row) {
        FieldBrick& b = brick(index);
        if (!b.isInside) return;
        b.dirty[static_cast<std::size_t>(row >> 6)] |= std::uint64_t{1} << (row & 63);
        enqueue(index);
    }
    void markAll(int index);
    // Marks the rows of the lowest (z = 0) or highest (z = 15) layer.
    void markLayer(int index, int z);
    // Marks the rows of a voxel and its six neighbors.
    void markAround(int index, int voxel);

    // Returns the brick's values for writing; copies them first if they are owned elsewhere.
    LightValue* writable(FieldBrick& brick);

    // Returns the next brick with marked rows, or -1. Its rows stay marked.
    int popDirty();

    BrickPool& pool() { return pool_; }

  private:
    void enqueue(int index) {
        FieldBrick& b = brick(index);
        if (b.isQueued) return;
        b.isQueued = true;
        queue_.push_back(index);
    }

    std::array<FieldBrick, kStepZ*(world::kSectionsPerChunk + 2)> bricks_;
    std::vector<int> queue_;
    std::size_t queueHead_ = 0;
    BrickPool pool_;
};

}  // namespace terrane::light
