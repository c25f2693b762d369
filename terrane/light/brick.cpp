#include "terrane/light/brick.h"

#include <algorithm>

namespace terrane::light {
namespace {

constexpr std::size_t kSharedCount = 17;

std::vector<Brick> makeSharedBricks() {
    std::vector<Brick> bricks(kSharedCount);
    for (std::size_t k = 0; k < kSharedCount; ++k) {
        bricks[k].values.fill(k == 16 ? kFullDaylight : allComponents(static_cast<int>(k)));
    }
    return bricks;
}

}  // namespace

const Brick* sharedUniformBrick(LightValue value) {
    static const std::vector<Brick> bricks = makeSharedBricks();
    if (value == kFullDaylight) return &bricks[16];
    const int level = levelOf(value, kRed);
    return value == allComponents(level) ? &bricks[static_cast<std::size_t>(level)] : nullptr;
}

LightBrick packBrick(BrickView view) {
    if (view.isUniform) return LightBrick(view.uniformValue());
    return LightBrick::fromValues(std::span<const LightValue, world::kBlocksPerSection>(
        view.values, static_cast<std::size_t>(world::kBlocksPerSection)));
}

Brick* BrickPool::acquire() {
    if (spare_.empty()) {
        used_.push_back(std::make_unique_for_overwrite<Brick>());
    } else {
        used_.push_back(std::move(spare_.back()));
        spare_.pop_back();
    }
    return used_.back().get();
}

BrickView BrickPool::uniform(LightValue value) {
    if (const Brick* shared = sharedUniformBrick(value)) return {shared->values.data(), nullptr, true};
    Brick* brick = acquire();
    brick->values.fill(value);
    return {brick->values.data(), nullptr, true};
}

BrickView BrickPool::unpack(const LightBrick& brick) {
    if (brick.isUniform()) return uniform(brick.uniformValue());
    Brick* unpacked = acquire();
    brick.unpack(unpacked->values);
    return {unpacked->values.data(), nullptr, false};
}

void BrickPool::reset() {
    std::move(used_.begin(), used_.end(), std::back_inserter(spare_));
    used_.clear();
}

std::vector<std::unique_ptr<Brick>> BrickPool::release() {
    return std::exchange(used_, {});
}

}  // namespace terrane::light
