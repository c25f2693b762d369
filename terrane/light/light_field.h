// The working area of the solver: the bricks of 3×3 chunks whose light may change and those beside them, and
// the rows that are to be processed. It is a part of LightScratch (light_chunk.h); one thread at a time uses
// it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrane/light/brick.h"
#include "terrane/world/heights.h"

namespace terrane::light {

constexpr int kFieldSide = 3;    // chunks along x and y
constexpr int kCenterChunk = 4;  // index of a chunk: x + 3 y
constexpr int kFieldChunks = kFieldSide * kFieldSide;
constexpr int kRowsPerBrick = 256;  // index of a row: y + 16 z

// Sides of a brick, in the order −x, +x, −y, +y, −z, +z.
enum Side : std::size_t { kWest, kEast, kSouth, kNorth, kBelow, kAbove, kSideCount };

// A brick of the field. Brick 0 stands for all that are not in the field: it is dark and opaque, and none of
// its rows is ever marked, so that no code needs to test for it.
struct FieldBrick {
    BrickView light;
    const LightValue* opacity = nullptr;
    // Levels up to this (16 × 16, the same for all z) cannot reach the middle chunk and may be dropped.
    const LightValue* reach = nullptr;
    // For relight.cpp: the light before the change, and the sources of the changed world.
    const LightValue* before = nullptr;
    const LightValue* source = nullptr;
    std::array<std::uint64_t, kRowsPerBrick / 64> dirty{};  // rows to process, a bit each
    std::array<int, kSideCount> beside{};                   // bricks of the field, 0 where there is none
    bool isQueued = false;
    std::int8_t chunk = 0;
    std::int16_t number = 0;  // of its section
};

// A field takes as much time and memory as it has bricks, in worlds of any heights.
class LightField {
  public:
    LightField() { reset(); }
    void reset();  // no bricks, no marked rows

    // Adds a brick of chunk 0…8 that is not in the field yet, and returns its index. It is dark, without
    // opacities, and lies beside its neighbors in the field.
    int add(int chunk, int number);
    // Returns the index of a brick, or 0 if it is not in the field.
    int find(int chunk, int number) const {
        return indices_[static_cast<std::size_t>(chunk)]
                       [static_cast<std::size_t>(number - world::kLowestSection)];
    }
    FieldBrick& brick(int index) { return bricks_[static_cast<std::size_t>(index)]; }
    int brickCount() const { return static_cast<int>(bricks_.size()); }  // brick 0 included

    void markRow(int index, int row) {
        if (index == 0) return;
        FieldBrick& b = brick(index);
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

    // Returns the next brick with marked rows, or 0. Its rows stay marked.
    int popDirty();

    BrickPool& pool() { return pool_; }

  private:
    void enqueue(int index) {
        FieldBrick& b = brick(index);
        if (b.isQueued) return;
        b.isQueued = true;
        queue_.push_back(index);
    }
    void link(int index, Side side, int chunk, int number);

    std::vector<FieldBrick> bricks_;
    // By chunk and section: 4.6 KB, of which a reset touches the entries in use.
    std::array<std::array<std::int16_t, world::kMostSections>, kFieldChunks> indices_{};
    std::vector<int> queue_;
    std::size_t queueHead_ = 0;
    BrickPool pool_;
};

}  // namespace terrane::light
