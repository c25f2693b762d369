#include "terrane/stream/tile_table.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace terrane::stream {

using world::ChunkPos;

namespace {

// The coarsest level is so much coarser than the outermost ring: few tiles cover everything at once.
constexpr int kCoarserFirst = 2;
// Of the tiles that give way to others, these levels are made all the same, counted from the coarsest: what
// is seen meanwhile is at most 2^3 times too coarse.
constexpr int kLevelsBetween = 3;
// A tile stays divided until the camera is this many of its widths beyond the border.
constexpr int kStayDivided = 1;
// Tiles come before they are within the horizon, chunks, and go as far beyond.
constexpr int kEarly = 16;
// Tiles of level 1 under the outermost chunks of level 0 are kept ready, since the chunks vanish at once.
// They go when they lie twice as far inside.
constexpr int kStandby = 4;

std::int64_t widthOf(int level) {
    return std::int64_t{1} << level;
}

bool isCovered(const TileTable& table, ChunkPos tile) {
    if (!world::isInWorld(tile)) return false;
    const std::int64_t beyond = tileDistance(table.view.center, tile) - table.view.horizon;
    if (beyond <= kEarly) return true;
    return beyond <= 2 * kEarly && (table.records.contains(tile) || table.divided.contains(tile));
}

// Distance to the farthest of the chunks that the tile covers.
std::int64_t farthestDistance(ChunkPos center, ChunkPos tile) {
    const std::int64_t width = widthOf(tile.level);
    const auto along = [width](std::int64_t at, std::int64_t first) {
        return std::max(at - first, first + width - 1 - at);
    };
    return std::max(along(center.x, tile.x * width), along(center.y, tile.y * width));
}

bool isWithinView(const TileView& view, ChunkPos tile) {
    return farthestDistance(view.center, tile) <= view.viewDistance;
}

// Whether children are to cover the tile.
bool isDivided(const TileTable& table, ChunkPos tile) {
    const TileView& view = table.view;
    if (tile.level == 0) return false;
    if (tile.level == 1) return isWithinView(view, tile);
    const std::int64_t distance = tileDistance(view.center, tile), width = widthOf(tile.level);
    std::int64_t border = std::max<std::int64_t>(view.detail * width / 2, view.viewDistance + 1);
    if (table.divided.contains(tile)) border += kStayDivided * width;
    return distance < border;
}

bool isReady(const TileTable& table, ChunkPos pos) {
    const auto found = table.records.find(pos);
    return found != table.records.end() && found->second.isReady;
}

std::array<ChunkPos, 4> childrenOf(ChunkPos tile) {
    const ChunkPos first = firstChildOf(tile);
    return {first, offsetBy(first, 1, 0), offsetBy(first, 0, 1), offsetBy(first, 1, 1)};
}

// One walk over the quad-tree: what is wanted, and what covers each column.
class Walk {
  public:
    Walk(const TileTable& table, int coarsest) : table_(table), coarsest_(coarsest) {}

    // Adds what shows the tile to `shown`. False where some of it cannot be shown yet.
    bool visit(ChunkPos tile, bool isWanted) {
        if (!isCovered(table_, tile)) return true;
        const bool divides = isWanted && isDivided(table_, tile);
        if (divides) divided.insert(tile);
        const std::size_t before = shown.size();
        const bool isThere = isReady(table_, tile);
        bool isWhole = false;
        if (divides || (!isThere && table_.open.contains(tile))) isWhole = visitChildren(tile, divides);
        if (isWanted && tile.level > 0 && isUseful(tile, divides, isWhole)) wanted.push_back(tile);
        if (isThere && !isWhole) {
            shown.resize(before);
            shown.push_back(tile);
            return true;
        }
        // Where the tile itself is missing a part of it is better than nothing.
        if (shown.size() > before) open.insert(tile);
        return isWhole;
    }

    std::vector<ChunkPos> shown;
    std::vector<ChunkPos> wanted;  // tiles
    std::unordered_set<ChunkPos, world::ChunkPosHash> open, divided;

  private:
    bool visitChildren(ChunkPos tile, bool isWanted) {
        bool isWhole = true;
        for (const ChunkPos child : childrenOf(tile)) isWhole = visit(child, isWanted) && isWhole;
        return isWhole;
    }

    // `isWhole`: its children show all of it.
    bool isUseful(ChunkPos tile, bool divides, bool isWhole) const {
        if (!divides) return true;
        if (tile.level == 1) {
            const int standby = table_.records.contains(tile) ? 2 * kStandby : kStandby;
            if (farthestDistance(table_.view.center, tile) > table_.view.viewDistance - standby) return true;
        }
        return !isWhole && (coarsest_ - tile.level) % kLevelsBetween == 0;
    }

    const TileTable& table_;
    int coarsest_;
};

void visitAll(Walk& walk, const TileView& view, int level) {
    const std::int64_t reach = view.horizon + 2 * kEarly;
    const auto first = [&](std::int64_t center) { return (center - reach) >> level; };
    const auto last = [&](std::int64_t center) { return (center + reach) >> level; };
    for (std::int64_t y = first(view.center.y); y <= last(view.center.y); ++y) {
        for (std::int64_t x = first(view.center.x); x <= last(view.center.x); ++x) {
            walk.visit({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
                        static_cast<std::uint8_t>(level)},
                       true);
        }
    }
}

// The coarsest tiles first, then what is nearest.
void orderRequests(TileTable& table, int coarsest) {
    const auto isLess = [&](ChunkPos a, ChunkPos b) {
        const bool isFirstA = a.level == coarsest, isFirstB = b.level == coarsest;
        if (isFirstA != isFirstB) return isFirstB;
        const std::int64_t da = tileDistance(table.view.center, a), db = tileDistance(table.view.center, b);
        if (da != db) return da > db;
        return a < b;
    };
    std::ranges::sort(table.requests, isLess);
}

void applyShown(TileTable& table, const std::vector<ChunkPos>& shown, TileChanges& changes) {
    std::unordered_set<ChunkPos, world::ChunkPosHash> now(shown.begin(), shown.end());
    for (auto& [pos, record] : table.records) {
        if (record.isShown && !now.contains(pos)) {
            record.isShown = false;
            changes.hidden.push_back(pos);
        }
    }
    for (const ChunkPos pos : shown) {
        TileRecord& record = table.records.at(pos);
        if (!record.isShown) changes.shown.push_back(pos);
        record.isShown = true;
    }
}

void applyWanted(TileTable& table, const std::vector<ChunkPos>& wanted, TileChanges& changes) {
    const std::unordered_set<ChunkPos, world::ChunkPosHash> now(wanted.begin(), wanted.end());
    std::erase_if(table.records, [&](const auto& entry) {
        const auto& [pos, record] = entry;
        if (pos.level == 0) return !record.isReady && !record.isShown;
        if (record.isShown || now.contains(pos)) return false;
        if (record.isReady) changes.dropped.push_back(pos);
        return true;
    });
    table.requests.clear();
    for (const ChunkPos pos : wanted) {
        if (!table.records.contains(pos)) table.requests.push_back(pos);
    }
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
    TileRecord& record = table.records[pos];
    if (record.isReady == isReady) return;
    record.isReady = isReady;
    table.isOutdated = true;
}

std::vector<ChunkPos> popTileRequests(TileTable& table, std::size_t limit) {
    std::vector<ChunkPos> popped;
    while (popped.size() < limit && !table.requests.empty()) {
        popped.push_back(table.requests.back());
        table.requests.pop_back();
        table.records[popped.back()].isLoading = true;
    }
    return popped;
}

bool isAwaited(const TileTable& table, ChunkPos tile) {
    const auto found = table.records.find(tile);
    return found != table.records.end() && found->second.isLoading;
}

void finishTile(TileTable& table, ChunkPos tile) {
    assert(isAwaited(table, tile) && "only what is loading becomes ready");
    table.records[tile] = {.isReady = true};
    table.isOutdated = true;
}

TileChanges updateTiles(TileTable& table) {
    TileChanges changes;
    if (!table.isOutdated) return changes;
    table.isOutdated = false;
    const int coarsest = coarsestLevel(table.view);
    Walk walk(table, coarsest);
    if (coarsest > 0) {
        visitAll(walk, table.view, coarsest);
    } else {
        for (const auto& [pos, record] : table.records) {
            if (pos.level == 0 && record.isReady) walk.shown.push_back(pos);
        }
    }
    table.open = std::move(walk.open);
    table.divided = std::move(walk.divided);
    applyShown(table, walk.shown, changes);
    applyWanted(table, walk.wanted, changes);
    orderRequests(table, coarsest);
    return changes;
}

std::size_t missingTiles(const TileTable& table) {
    return table.requests.size() +
           static_cast<std::size_t>(std::ranges::count_if(
               table.records, [](const auto& entry) { return entry.second.isLoading; }));
}

}  // namespace terrane::stream
