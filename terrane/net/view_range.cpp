#include "terrane/net/view_range.h"

#include <algorithm>

#include "terrane/stream/tile_table.h"

namespace terrane::net {

View servedView(const View& asked, int maxViewDistance) {
    View view = asked;
    view.viewDistance = static_cast<std::uint8_t>(std::min<int>(asked.viewDistance, maxViewDistance));
    view.horizon = static_cast<std::uint16_t>(std::min<int>(asked.horizon, stream::kMaxHorizon));
    return view;
}

int topLevelOf(const View& view) {
    if (view.horizon == 0) return 0;
    return stream::coarsestLevel({.horizon = view.horizon, .detail = stream::kMinDetail});
}

bool isInView(const View& view, world::ChunkPos pos, int margin) {
    const world::ChunkPos center{view.center.x >> pos.level, view.center.y >> pos.level, pos.level};
    const std::int64_t distance = world::chunkDistance(pos, center);
    // One chunk more than is visible, since meshes depend on their neighbors.
    if (pos.level == 0) return distance <= view.viewDistance + 1 + margin;
    const std::int64_t horizon = (view.horizon >> pos.level) + 1;
    return distance >= kNearestTile - margin &&
           distance <= std::min<std::int64_t>(kFarthestTile, horizon) + margin;
}

}  // namespace terrane::net
