#include "terrane/game/selection.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>

namespace terrane::game {

using world::BlockBox;
using world::BlockPos;

std::optional<BlockBox> Selection::box() const {
    if (!first_ && !second_) return std::nullopt;
    const BlockPos a = first_ ? *first_ : *second_, b = second_ ? *second_ : *first_;
    return BlockBox{{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
                    {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
}

bool Selection::moveEnd(End end, int blocks, world::Heights heights) {
    const auto before = box();
    if (!before) return false;
    if (!first_) first_ = second_;
    if (!second_) second_ = first_;
    // In a box of one layer the second corner moves.
    const bool isFirst = end == End::Top ? first_->z > second_->z : first_->z < second_->z;
    std::int32_t& z = isFirst ? first_->z : second_->z;
    const std::int64_t lowest = end == End::Top ? before->low.z : heights.bottom;
    const std::int64_t highest = end == End::Top ? heights.top - 1 : before->high.z;
    // A corner may be above or below the world, where the player stands: it moves only toward the world.
    z = static_cast<std::int32_t>(std::clamp(std::int64_t{z} + blocks, std::min<std::int64_t>(lowest, z),
                                             std::max<std::int64_t>(highest, z)));
    return box()->low != before->low || box()->high != before->high;
}

FillShape Selection::shape() const {
    if (shape_ != ShapeKind::Line || !first_ || !second_) return {shape_};
    return lineBetween(*first_, *second_);
}

void Selection::setClipboard(world::Structure structure) {
    clipboard_ = std::make_shared<const world::Structure>(std::move(structure));
}

void Selection::turn(const world::BlockRegistry& blocks) {
    if (clipboard_) setClipboard(world::turnedStructure(*clipboard_, blocks, 1));
}

void Selection::mirror(const world::BlockRegistry& blocks, float yaw) {
    if (clipboard_) setClipboard(world::mirroredStructure(*clipboard_, blocks, sidewaysAxis(yaw)));
}

std::optional<BlockPos> Selection::pasteCorner(BlockPos middle, world::Heights heights) const {
    if (!clipboard_) return std::nullopt;
    const glm::ivec3 size = clipboard_->size;
    const int z = std::max(heights.bottom, std::min(middle.z, heights.top - size.z));
    return world::offsetBy({middle.x, middle.y, z}, -(size.x - 1) / 2, -(size.y - 1) / 2, 0);
}

world::MirrorAxis sidewaysAxis(float yaw) {
    const bool looksAlongY = std::abs(std::sin(glm::radians(yaw))) > std::abs(std::cos(glm::radians(yaw)));
    return looksAlongY ? world::MirrorAxis::X : world::MirrorAxis::Y;
}

}  // namespace terrane::game
