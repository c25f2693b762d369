#include "terrane/view/far_view.h"

#include <algorithm>

#include "terrane/base/profile.h"

namespace terrane::view {
namespace {

// Least time between changes. Many tiles arrive in it, and each change visits all tiles; changes take a tenth
// of the time at most.
constexpr std::chrono::milliseconds kBetweenChanges{15};
constexpr int kTimesItself = 10;

}  // namespace

void FarView::setView(world::ChunkPos center, int viewDistance, const Horizon& horizon) {
    tiles_.setView({center, viewDistance, horizon.distance, horizon.detail});
}

void FarView::prepareChunk(world::ChunkPos pos) {
    if (!tiles_.table().records.contains(pos)) renderer_.setShown(pos, false);
}

bool FarView::upload(std::chrono::steady_clock::time_point deadline) {
    TERRANE_ZONE("upload tiles");
    while (std::chrono::steady_clock::now() < deadline) {
        std::vector<stream::TileMesh> tiles = tiles_.takeMeshes(1);
        if (tiles.empty()) return true;
        if (!tiles_.table().records.at(tiles.front().pos).isShown)
            renderer_.setShown(tiles.front().pos, false);
        const stream::TileMesh& tile = tiles.front();
        if (renderer_.setBlocks(tile.pos, tile.blocks) &&
            (!tile.mesh || renderer_.setChunk(tile.pos, *tile.mesh)))
            continue;
        tiles_.putBack(std::move(tiles.front()));
        return false;
    }
    return true;
}

void FarView::applyChanges() {
    const auto now = std::chrono::steady_clock::now();
    if (tiles_.table().loading > 0 && !tiles_.table().hasGone && now < nextChanges_) return;
    applyNow();
    const auto took = std::chrono::steady_clock::now() - now;
    nextChanges_ = now + std::max<std::chrono::steady_clock::duration>(kBetweenChanges, kTimesItself * took);
}

void FarView::applyNow() {
    const stream::TileChanges changes = tiles_.takeChanges();
    for (const world::ChunkPos pos : changes.hidden) {
        if (tiles_.table().records.contains(pos)) renderer_.setShown(pos, false);
    }
    for (const world::ChunkPos pos : changes.dropped) renderer_.removeChunk(pos);
    for (const world::ChunkPos pos : changes.shown) renderer_.setShown(pos, true);
}

}  // namespace terrane::view
