#include "terrane/light/light_field.h"

#include <algorithm>
#include <cassert>

namespace terrane::light {

void LightField::reset() {
    for (const FieldBrick& b : bricks_)
        indices_[static_cast<std::size_t>(b.chunk)]
                [static_cast<std::size_t>(b.number - world::kLowestSection)] = 0;
    bricks_.clear();
    FieldBrick outside;
    outside.light = {sharedUniformBrick(kDark)->values.data(), nullptr, true};
    bricks_.push_back(outside);
    queue_.clear();
    queueHead_ = 0;
    pool_.reset();
}

int LightField::add(int chunk, int number) {
    assert(find(chunk, number) == 0 && "a brick is added once");
    const int index = brickCount(), x = chunk % kFieldSide, y = chunk / kFieldSide;
    FieldBrick& brick = bricks_.emplace_back();
    brick.light = bricks_[0].light;
    brick.reach = bricks_[0].light.values;
    brick.chunk = static_cast<std::int8_t>(chunk);
    brick.number = static_cast<std::int16_t>(number);
    indices_[static_cast<std::size_t>(chunk)][static_cast<std::size_t>(number - world::kLowestSection)] =
        static_cast<std::int16_t>(index);
    if (x > 0) link(index, kWest, chunk - 1, number);
    if (x + 1 < kFieldSide) link(index, kEast, chunk + 1, number);
    if (y > 0) link(index, kSouth, chunk - kFieldSide, number);
    if (y + 1 < kFieldSide) link(index, kNorth, chunk + kFieldSide, number);
    if (number > world::kLowestSection) link(index, kBelow, chunk, number - 1);
    if (number + 1 < world::kLowestSection + world::kMostSections) link(index, kAbove, chunk, number + 1);
    return index;
}

void LightField::link(int index, Side side, int chunk, int number) {
    const int other = find(chunk, number);
    if (other == 0) return;
    brick(index).beside[side] = other;
    brick(other).beside[side ^ 1] = index;
}

void LightField::markAll(int index) {
    if (index == 0) return;
    brick(index).dirty.fill(~std::uint64_t{0});
    enqueue(index);
}

void LightField::markLayer(int index, int z) {
    if (index == 0) return;
    brick(index).dirty[static_cast<std::size_t>(z >> 2)] |= std::uint64_t{0xFFFF} << 16 * (z & 3);
    enqueue(index);
}

void LightField::markAround(int index, int voxel) {
    const std::array<int, kSideCount>& beside = brick(index).beside;
    const int x = voxel & 15, y = voxel >> 4 & 15, z = voxel >> 8, row = voxel >> 4;
    markRow(index, row);
    if (x == 0) markRow(beside[kWest], row);
    if (x == 15) markRow(beside[kEast], row);
    y > 0 ? markRow(index, row - 1) : markRow(beside[kSouth], row + 15);
    y < 15 ? markRow(index, row + 1) : markRow(beside[kNorth], row - 15);
    z > 0 ? markRow(index, row - 16) : markRow(beside[kBelow], row + 240);
    z < 15 ? markRow(index, row + 16) : markRow(beside[kAbove], row - 240);
}

LightValue* LightField::writable(FieldBrick& brick) {
    if (!brick.light.writable) {
        Brick* copy = pool_.acquire();
        std::copy_n(brick.light.values, world::kBlocksPerSection, copy->values.data());
        brick.light = {copy->values.data(), copy->values.data(), false};
    }
    return brick.light.writable;
}

int LightField::popDirty() {
    if (queueHead_ == queue_.size()) {
        queue_.clear();
        queueHead_ = 0;
        return 0;
    }
    const int index = queue_[queueHead_++];
    brick(index).isQueued = false;
    return index;
}

}  // namespace terrane::light
