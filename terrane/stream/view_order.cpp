#include "terrane/stream/view_order.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace terrane::stream {
namespace {

using world::ChunkPos;

// 16 times the square of the distance, up to twice as much behind the camera.
std::int64_t urgencyOf(ChunkPos offset, glm::vec2 direction) {
    const auto x = static_cast<float>(offset.x), y = static_cast<float>(offset.y);
    const float distance = std::sqrt(x * x + y * y);
    const float ahead = distance > 0 ? (x * direction.x + y * direction.y) / distance : 1.0f;
    const float turned = direction == glm::vec2{} ? 0.0f : (1.0f - ahead) * 0.5f;
    return static_cast<std::int64_t>(16.0f * distance * distance * (1.0f + turned));
}

void sortOffsets(ViewOrder& view) {
    const int reach = view.distance + 1, side = 2 * reach + 1;
    view.offsets.clear();
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) view.offsets.push_back({x, y});
    }
    std::stable_sort(view.offsets.begin(), view.offsets.end(), [&](ChunkPos a, ChunkPos b) {
        return urgencyOf(a, view.direction) < urgencyOf(b, view.direction);
    });
    view.ranks.resize(view.offsets.size());
    for (std::size_t k = 0; k < view.offsets.size(); ++k) {
        const ChunkPos offset = view.offsets[k];
        view.ranks[static_cast<std::size_t>((offset.y + reach) * side + offset.x + reach)] = k;
    }
}

}  // namespace

void moveView(ViewOrder& view, ChunkPos center, int distance, glm::vec2 direction) {
    assert(distance >= 0 && "a view shows at least the camera's chunk");
    const bool isSameOrder = distance == view.distance && direction == view.direction;
    view.center = center;
    view.distance = distance;
    view.direction = direction;
    if (!isSameOrder) sortOffsets(view);
}

std::int64_t urgency(const ViewOrder& view, ChunkPos pos) {
    return urgencyOf(world::offsetBy(pos, -view.center.x, -view.center.y), view.direction);
}

std::size_t rankOf(const ViewOrder& view, ChunkPos pos) {
    assert(isNeeded(view, pos) && "only needed chunks have a rank");
    const int reach = view.distance + 1, side = 2 * reach + 1;
    const int x = pos.x - view.center.x + reach, y = pos.y - view.center.y + reach;
    return view.ranks[static_cast<std::size_t>(y * side + x)];
}

}  // namespace terrane::stream
