#include "terrane/light/light_field.h"

#include <algorithm>
#include <cassert>

namespace terrane::light {

void LightField::reset() {
    FieldBrick outside;
    outside.light = {sharedUniformBrick(kDark)->values.data(), nullptr, true};
    outside.opacity = sharedUniformBrick(allComponents(kMaxLevel))->values.data();
    outside.reach = sharedUniformBrick(kDark)->values.data();
    bricks_.fill(outside);
    queue_.clear();
    queueHead_ = 0;
    pool_.reset();
}

void LightField::markAll(int index) {
    if (!brick(index).isInside) return;
    brick(index).dirty.fill(~std::uint64_t{0});
    enqueue(index);
}

void LightField::markLayer(int index, int z) {
    if (!brick(index).isInside) return;
    brick(index).dirty[static_cast<std::size_t>(z >> 2)] |= std::uint64_t{0xFFFF} << 16 * (z & 3);
    enqueue(index);
}

void LightField::markAround(int index, int voxel) {
    const int x = voxel & 15, y = voxel >> 4 & 15, z = voxel >> 8, row = voxel >> 4;
    markRow(index, row);
    if (x == 0) markRow(index - kStepX, row);
    if (x == 15) markRow(index + kStepX, row);
    y > 0 ? markRow(index, row - 1) : markRow(index - kStepY, row + 15);
    y < 15 ? markRow(index, row + 1) : markRow(index + kStepY, row - 15);
    z > 0 ? markRow(index, row - 16) : markRow(index - kStepZ, row + 240);
    z < 15 ? markRow(index, row + 16) : markRow(index + kStepZ, row - 240);
}

LightValue* LightField::writable(FieldBrick& brick) {
    if (!brick.light.writable) {
        assert(brick.isInside && "what lies outside stays dark");
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
        return -1;
    }
    const int index = queue_[queueHead_++];
    brick(index).isQueued = false;
    return index;
}

}  // namespace terrane::light
