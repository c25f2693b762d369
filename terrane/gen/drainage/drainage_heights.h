// Places and heights of a map's nodes: the author's expression run on the samples of each cell, of which the
// lowest becomes the cell's node. One DrainageHeights a map and seed; any thread may use it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/compile/program.h"
#include "terrane/gen/drainage/drainage_network.h"
#include "terrane/world/coords.h"

namespace terrane::gen {

// A cell of a map: spacing · x … spacing · (x + 1) − 1 blocks. Wraps with the blocks of the world.
struct DrainageCell {
    std::int32_t x = 0, y = 0;
};

// 1/16 blocks from the corner of the cell.
struct NodePlace {
    std::int32_t x, y;
};
constexpr std::int32_t kPlaceUnits = 16;  // a block

struct DrainageNodes {
    std::vector<HeightKey> heights;  // by y, then x
    std::vector<float> gradients;    // likewise; empty if the map has no valleys
    std::vector<NodePlace> places;
};

// A cell has kCellSamples² samples, each for a square of its own. The generator that records the heights is
// of this level: its columns are those squares.
constexpr int kCellSamples = 2;
constexpr int kCellSamplesLog2 = 1;
int drainageLevel(const DrainageSpec& spec);

class Executor;

// Regions overlap by their margins, so nodes are kept in blocks of one tile of samples.
class DrainageHeights {
  public:
    DrainageHeights(const DrainageGraph& graph, std::uint64_t worldSeed);

    // Returns the nodes of side² cells from `corner` on. Corner and side are multiples of 16 / kCellSamples.
    DrainageNodes nodes(DrainageCell corner, int side) const;
    // Returns a hash of the cell, for random decisions.
    std::uint32_t hash(DrainageCell cell) const;
    const DrainageSpec& spec() const { return graph_.spec; }
    bool hasValleys() const { return graph_.hasValleys(); }

  private:
    static constexpr int kBlockCells = kTileSize / kCellSamples, kBlockNodes = kBlockCells * kBlockCells;
    struct Block {
        std::array<HeightKey, kBlockNodes> heights;
        std::array<float, kBlockNodes> gradients;
        std::array<NodePlace, kBlockNodes> places;
    };
    using Blocks = std::unordered_map<world::ChunkPos, std::shared_ptr<const Block>, world::ChunkPosHash>;
    // Regions of a row of 64 tiles need 1,000 to 1,500 blocks: 2 × 2,048 × 1.3 KB = 5 MB.
    static constexpr std::size_t kMaxBlocks = 2048;

    std::shared_ptr<const Block> findBlock(world::ChunkPos tile) const;
    std::shared_ptr<const Block> makeBlock(Executor& executor, world::ChunkPos tile) const;

    DrainageGraph graph_;
    Seeds seeds_;
    std::uint32_t seed_;
    Program program_;
    mutable std::mutex mutex_;
    // Blocks used lately, and those used before these were kMaxBlocks; guarded by mutex_.
    mutable Blocks blocks_, olderBlocks_;
};

// Returns the same cell on the other side of the world's edge.
DrainageCell wrapped(DrainageCell cell, int spacing);

}  // namespace terrane::gen
