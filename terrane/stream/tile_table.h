// Decides which chunks of which level cover the land out to the horizon: the rules, without threads, clocks
// or blocks. tile_pipeline.h makes the tiles, view/world_view.h puts them on screen. One thread uses it.
//
// A tile is a chunk of level 1 or more: 16×16 columns, each 2^level blocks wide (world/coords.h). Tiles form
// a quad-tree: a tile of level k covers four chunks of level k − 1. Level 0 covers the view distance; beyond
// it lie square rings of levels 1, 2, 3 …, each twice as wide as the one before, out to the horizon.
//
// Each column within the horizon is shown by exactly one chunk or tile, once a tile of the coarsest level is
// there. A tile is replaced by its four children when all of them can be shown, and replaces them when it can
// be shown itself. Without that rule land would vanish, or be drawn twice.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "terrane/world/coords.h"

namespace terrane::stream {

struct TileView {
    world::ChunkPos center{};  // level 0, of the camera
    int viewDistance = 0;      // of level 0, chunks (Chebyshev)
    int horizon = 0;           // how far tiles reach, chunks of level 0; none unless beyond viewDistance
    int detail = 12;           // tiles from the center to the outer edge of a ring

    bool operator==(const TileView&) const = default;
};

constexpr int kMinDetail = 8;
constexpr int kMaxHorizon = 4096;

// A chunk of level 0 that can be shown, a tile, or a node between the two in the quad-tree.
struct TileRecord {
    bool isReady = false;    // it can be shown
    bool isLoading = false;  // tiles: a request was taken
    bool isStale = false;    // tiles: to be made again; until then it is shown as it is
    bool isShown = false;
    // As of the last traversal of the quad-tree. A divided tile stays divided some distance beyond the
    // border, so that small movements load nothing again.
    bool isRequested = false;              // tiles: it is to be made or kept
    bool isDivided = false;                // children are to cover it
    bool isOpen = false;                   // children are shown in its place, or some of them
    std::uint32_t visited = 0, shown = 0;  // the last walk that visited it, that showed it
};

struct TileRequest {
    std::int64_t urgency = 0;  // the smaller the sooner
    world::ChunkPos tile;
    auto operator<=>(const TileRequest&) const = default;
};

struct TileTable {
    TileView view;
    std::unordered_map<world::ChunkPos, TileRecord, world::ChunkPosHash> records;
    std::vector<TileRequest> requests;  // absent or stale tiles to make, a heap with the most urgent in front
    std::size_t loading = 0;            // tiles
    std::uint32_t walks = 0;
    bool isOutdated = true;  // something changed since updateTiles()
    bool hasGone = false;    // something that was shown cannot be any more
};

// Changes on screen, in no order. A tile that is dropped was hidden before or is hidden too.
struct TileChanges {
    std::vector<world::ChunkPos> shown, hidden, dropped;
};

// Returns the coarsest level: tiles of this level come first and cover everything. The result is 0 without a
// horizon.
int coarsestLevel(const TileView& view);
// Returns the number of chunks of level 0 between the chunk `center`, which is of level 0, and the nearest
// one that `tile` covers.
std::int64_t tileDistance(world::ChunkPos center, world::ChunkPos tile);
// Returns whether the view distance holds all chunks that the tile covers: a tile of level 1 is then replaced
// by its chunks.
bool isWithinView(const TileView& view, world::ChunkPos tile);
// Returns the chunk of the next level that covers this one, and the child with the lowest x and y.
world::ChunkPos parentOf(world::ChunkPos pos);
world::ChunkPos firstChildOf(world::ChunkPos tile);

void setTileView(TileTable& table, const TileView& view);
// Sets whether a chunk of level 0 can be shown.
void setChunkReady(TileTable& table, world::ChunkPos pos, bool isReady);
// Removes and returns up to `limit` tiles to make, most urgent first: the coarsest, then the nearest to the
// camera. They become loading.
std::vector<world::ChunkPos> popTileRequests(TileTable& table, std::size_t limit);
// Returns whether the tile is loading.
bool isTileLoading(const TileTable& table, world::ChunkPos tile);
// Marks a loading tile as ready to be shown.
void finishTile(TileTable& table, world::ChunkPos tile);
// Marks a finished tile as loading again.
void reopenTile(TileTable& table, world::ChunkPos tile);
// Marks the tile, or all tiles, as stale: they are made again if requested.
void invalidateTile(TileTable& table, world::ChunkPos tile);
void invalidateAllTiles(TileTable& table);
// Updates which tiles are shown, hidden and dropped. One walk over the quad-tree, about half a millisecond
// with some thousand tiles; none if nothing changed.
TileChanges updateTiles(TileTable& table);

// Returns the number of shown chunks of each level, from level 0 on: "1089 752 432". The text is empty
// without a horizon.
std::string shownLevels(const TileTable& table);

// Returns the number of requested tiles that are absent or stale, as of the last updateTiles().
inline std::size_t missingTiles(const TileTable& table) {
    return table.requests.size() + table.loading;
}

}  // namespace terrane::stream
