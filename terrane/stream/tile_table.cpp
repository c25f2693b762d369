#include "terrane/stream/tile_table.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cassert>
#include <functional>

#include <utility>

namespace terrane::stream {

using world::ChunkPos;

namespace {

// The coarsest level is this many levels above the outermost ring's: few tiles cover everything at once.
constexpr int kCoarserFirst = 2;
// Every third level of divided tiles, counted from the coarsest, is made as well: the land shown while others
// load is at most 2^3 times too coarse.
constexpr int kLevelsBetween = 3;
// A tile stays divided until the camera is this many of its widths beyond the border.
constexpr int kStayDivided = 1;
// Tiles are made this many chunks before they are within the horizon, and dropped twice as far beyond it.
constexpr int kEarly = 16;
// Tiles of level 1 under the outermost chunks of level 0 are kept ready, since the chunks vanish at once.
// They are dropped twice as far inside.
constexpr int kStandby = 4;
// Tiles of a level are made in bands around the camera, this many tiles wide, row by row: neighbors, which
// share much of their generation, then follow each other.
constexpr int kBandTiles = 16;
// Larger than all distances.
constexpr std::int64_t kFarthest = std::int64_t{1} << 40;

std::int64_t widthOf(int level) {
    return std::int64_t{1} << level;
}

// Whether the tile is within the horizon. `isKnown`: it has a record.
bool isCovered(const TileView& view, ChunkPos tile, bool isKnown) {
    if (!world::isInWorld(tile)) return false;
    const std::int64_t beyond = tileDistance(view.center, tile) - view.horizon;
    return beyond <= (isKnown ? 2 * kEarly : kEarly);
}

// Distance to the farthest of the chunks that the tile covers.
std::int64_t farthestDistance(ChunkPos center, ChunkPos tile) {
    const std::int64_t width = widthOf(tile.level);
    const auto along = [width](std::int64_t at, std::int64_t first) {
        return std::max(at - first, first + width - 1 - at);
    };
    return std::max(along(center.x, tile.x * width), along(center.y, tile.y * width));
}

// Whether children are to cover the tile. `isDivided`: they were before.
bool divides(const TileView& view, ChunkPos tile, bool isDivided) {
    if (tile.level == 0) return false;
    if (tile.level == 1) return isWithinView(view, tile);
    const std::int64_t width = widthOf(tile.level);
    std::int64_t border = std::max<std::int64_t>(view.detail * width / 2, view.viewDistance + 1);
    if (isDivided) border += kStayDivided * width;
    return tileDistance(view.center, tile) < border;
}

std::array<ChunkPos, 4> childrenOf(ChunkPos tile) {
    const ChunkPos first = firstChildOf(tile);
    return {first, offsetBy(first, 1, 0), offsetBy(first, 0, 1), offsetBy(first, 1, 1)};
}

using Node = std::pair<const ChunkPos, TileRecord>;

// One walk over the quad-tree: finds the tiles to make, and the cover of each column.
class Walk {
  public:
    Walk(TileTable& table, int coarsest) : table_(table), coarsest_(coarsest) {}

    void visitAll();

    std::vector<Node*> shown;

  private:
    bool visit(ChunkPos tile, bool isRequested);
    bool visitChildren(ChunkPos tile, bool isRequested);
    bool isUseful(ChunkPos tile, bool isKnown, bool isWhole) const;
    void request(ChunkPos tile);

    TileTable& table_;
    int coarsest_;
};

void Walk::visitAll() {
    const TileView& view = table_.view;
    const std::int64_t reach = view.horizon + 2 * kEarly;
    const auto first = [&](std::int64_t center) { return (center - reach) >> coarsest_; };
    const auto last = [&](std::int64_t center) { return (center + reach) >> coarsest_; };
    for (std::int64_t y = first(view.center.y); y <= last(view.center.y); ++y) {
        for (std::int64_t x = first(view.center.x); x <= last(view.center.x); ++x) {
            visit({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
                   static_cast<std::uint8_t>(coarsest_)},
                  true);
        }
    }
}

// Adds the nodes that show the tile to `shown`. False if some of it cannot be shown yet.
bool Walk::visit(ChunkPos tile, bool isRequested) {
    auto found = table_.records.find(tile);
    const bool isKnown = found != table_.records.end();
    if (!isCovered(table_.view, tile, isKnown)) return true;
    if (!isKnown) {
        if (tile.level == 0 || !isRequested) return false;
        found = table_.records.emplace(tile, TileRecord()).first;
    }
    auto& entry = *found;  // the table may grow below
    TileRecord& record = entry.second;
    record.visited = table_.walks;
    record.isDivided = isRequested && divides(table_.view, tile, record.isDivided);
    const std::size_t before = shown.size();
    bool isWhole = false;
    if (record.isDivided || (!record.isReady && record.isOpen))
        isWhole = visitChildren(tile, record.isDivided);
    record.isRequested =
        isRequested && tile.level > 0 && (!record.isDivided || isUseful(tile, isKnown, isWhole));
    if (record.isRequested && !record.isLoading && (!record.isReady || record.isStale)) request(tile);
    const bool showsItself = record.isReady && !isWhole;
    if (showsItself) {
        shown.resize(before);
        shown.push_back(&entry);
    }
    // If the tile itself is missing, a part of it is better than nothing.
    record.isOpen = !showsItself && shown.size() > before;
    return showsItself || isWhole;
}

bool Walk::visitChildren(ChunkPos tile, bool isRequested) {
    bool isWhole = true;
    for (const ChunkPos child : childrenOf(tile)) isWhole = visit(child, isRequested) && isWhole;
    return isWhole;
}

// Whether a divided tile is to be made as well. `isWhole`: its children show all of it.
bool Walk::isUseful(ChunkPos tile, bool isKnown, bool isWhole) const {
    if (tile.level == 1) {
        const int standby = isKnown ? 2 * kStandby : kStandby;
        if (farthestDistance(table_.view.center, tile) > table_.view.viewDistance - standby) return true;
    }
    return !isWhole && (coarsest_ - tile.level) % kLevelsBetween == 0;
}

// The coarsest tiles come first, the others in bands of distance, each as wide as some tiles.
void Walk::request(ChunkPos tile) {
    const std::int64_t distance = tileDistance(table_.view.center, tile);
    const std::int64_t urgency = distance - distance % (kBandTiles * widthOf(tile.level));
    table_.requests.push_back({tile.level == coarsest_ ? urgency - kFarthest : urgency, tile});
}

// Hides and drops a node that the last walk neither shows nor requests. False if the record can be erased.
bool keep(TileTable& table, Node& node, TileChanges& changes) {
    auto& [pos, record] = node;
    if (record.visited != table.walks) record.isRequested = record.isDivided = record.isOpen = false;
    if (record.isShown && record.shown != table.walks) {
        record.isShown = false;
        changes.hidden.push_back(pos);
    }
    if (pos.level == 0) return record.isReady;
    if (record.isShown || record.isRequested) return true;
    if (record.isReady) changes.dropped.push_back(pos);
    table.loading -= record.isLoading ? 1 : 0;
    record.isReady = record.isLoading = record.isStale = false;
    return record.isDivided || record.isOpen;
}

TileChanges applyWalk(TileTable& table, const std::vector<Node*>& shown) {
    TileChanges changes;
    for (Node* node : shown) {
        if (!node->second.isShown) changes.shown.push_back(node->first);
        node->second.isShown = true;
        node->second.shown = table.walks;
    }
    for (auto it = table.records.begin(); it != table.records.end();) {
        it = keep(table, *it, changes) ? std::next(it) : table.records.erase(it);
    }
    return changes;
}

}  // namespace

int coarsestLevel(const TileView& view) {
    if (view.horizon <= view.viewDistance) return 0;
    int level = 1;
    while (view.detail * widthOf(level) < view.horizon && level < world::kMaxLevel) ++level;
    return std::min(level + kCoarserFirst, world::kMaxLevel);
}

std::int64_t tileDistance(ChunkPos center, ChunkPos tile) {
    const std::int64_t width = widthOf(tile.level);
    const auto along = [width](std::int64_t at, std::int64_t first) {
        return std::max({first - at, at - (first + width - 1), std::int64_t{0}});
    };
    return std::max(along(center.x, tile.x * width), along(center.y, tile.y * width));
}

bool isWithinView(const TileView& view, ChunkPos tile) {
    return farthestDistance(view.center, tile) <= view.viewDistance;
}

ChunkPos parentOf(ChunkPos pos) {
    assert(pos.level < world::kMaxLevel && "no level above");
    return {pos.x >> 1, pos.y >> 1, static_cast<std::uint8_t>(pos.level + 1)};
}

ChunkPos firstChildOf(ChunkPos tile) {
    assert(tile.level > 0 && "no level below");
    return {tile.x * 2, tile.y * 2, static_cast<std::uint8_t>(tile.level - 1)};
}

void setTileView(TileTable& table, const TileView& view) {
    if (view == table.view) return;
    table.view = view;
    table.isOutdated = true;
}

void setChunkReady(TileTable& table, ChunkPos pos, bool isReady) {
    assert(pos.level == 0 && "tiles have finishTile()");
    if (!isReady && !table.records.contains(pos)) return;
    TileRecord& record = table.records[pos];
    if (record.isReady == isReady) return;
    record.isReady = isReady;
    table.isOutdated = true;
    table.hasGone = table.hasGone || record.isShown;
}

std::vector<ChunkPos> popTileRequests(TileTable& table, std::size_t limit) {
    std::vector<ChunkPos> popped;
    while (popped.size() < limit && !table.requests.empty()) {
        std::ranges::pop_heap(table.requests, std::greater());
        popped.push_back(table.requests.back().tile);
        table.requests.pop_back();
        TileRecord& record = table.records.at(popped.back());
        record.isLoading = true;
        record.isStale = false;
        ++table.loading;
    }
    return popped;
}

bool isTileLoading(const TileTable& table, ChunkPos tile) {
    const auto found = table.records.find(tile);
    return found != table.records.end() && found->second.isLoading;
}

void finishTile(TileTable& table, ChunkPos tile) {
    assert(isTileLoading(table, tile) && "only what is loading becomes ready");
    TileRecord& record = table.records.at(tile);
    record.isLoading = false;
    record.isReady = true;
    --table.loading;
    table.isOutdated = true;
}

void reopenTile(TileTable& table, ChunkPos tile) {
    TileRecord& record = table.records.at(tile);
    record.isLoading = true;
    record.isReady = false;
    ++table.loading;
    table.isOutdated = true;
    table.hasGone = table.hasGone || record.isShown;
}

void invalidateTile(TileTable& table, ChunkPos tile) {
    const auto found = table.records.find(tile);
    if (found == table.records.end() || tile.level == 0) return;
    found->second.isStale = true;
    table.isOutdated = true;
}

void invalidateAllTiles(TileTable& table) {
    for (auto& [pos, record] : table.records) record.isStale = pos.level > 0;
    table.isOutdated = true;
}

std::string shownLevels(const TileTable& table) {
    if (coarsestLevel(table.view) == 0) return {};
    std::array<std::size_t, world::kMaxLevel + 1> counts{};
    for (const auto& [pos, record] : table.records) counts[pos.level] += record.isShown ? 1 : 0;
    std::string text;
    for (int level = 0; level <= coarsestLevel(table.view); ++level)
        text += fmt::format("{}{}", level > 0 ? " " : "", counts[static_cast<std::size_t>(level)]);
    return text;
}

TileChanges updateTiles(TileTable& table) {
    if (!table.isOutdated) return {};
    table.isOutdated = table.hasGone = false;
    ++table.walks;
    table.requests.clear();
    const int coarsest = coarsestLevel(table.view);
    Walk walk(table, coarsest);
    if (coarsest > 0) {
        walk.visitAll();
    } else {
        for (Node& node : table.records) {
            if (node.first.level == 0 && node.second.isReady) walk.shown.push_back(&node);
        }
    }
    std::ranges::make_heap(table.requests, std::greater());
    return applyWalk(table, walk.shown);
}

}  // namespace terrane::stream
