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

void Selection::setClipboard(world::Structure structure) {
    clipboard_ = std::make_shared<const world::Structure>(std::move(structure));
}

void Selection::turn(const world::BlockRegistry& blocks) {
    if (clipboard_) setClipboard(world::turnedStructure(*clipboard_, blocks, 1));
}

void Selection::mirror(const world::BlockRegistry& blocks, float yaw) {
    if (clipboard_) setClipboard(world::mirroredStructure(*clipboard_, blocks, sidewaysAxis(yaw)));
}

std::optional<BlockPos> Selection::pasteCorner(BlockPos middle) const {
    if (!clipboard_) return std::nullopt;
    const glm::ivec3 size = clipboard_->size;
    const int z = std::max(0, std::min(middle.z, world::kChunkHeight - size.z));
    return world::offsetBy({middle.x, middle.y, z}, -(size.x - 1) / 2, -(size.y - 1) / 2, 0);
}

world::MirrorAxis sidewaysAxis(float yaw) {
    const bool looksAlongY = std::abs(std::sin(glm::radians(yaw))) > std::abs(std::cos(glm::radians(yaw)));
    return looksAlongY ? world::MirrorAxis::X : world::MirrorAxis::Y;
}

}  // namespace terrane::game
