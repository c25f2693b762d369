// Compares the tiles of a level with the chunks under them: heights, kinds of ground, crowns, water. Used by
// bench_levels and by tests of generators, which limit the differences.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "terrane/gen/level_generators.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::bench {

// The top of a column as seen from above. Flowers and tufts do not hide their ground.
enum class Cover : std::uint8_t { Grass, Stone, Sand, Snow, Dirt, Water, Leaves, Wheat, Other };
constexpr int kCoverCount = 9;

// Kinds of land, determined from chunks in areas of kAreaBlocks².
enum class Land : std::uint8_t { Ocean, Plains, Hills, Mountains, Desert };
constexpr int kLandCount = 5;
constexpr int kAreaBlocks = 64;

// A square of columns, by x + width y.
struct Columns {
    int width = 0;
    int step = 1;  // blocks a column
    std::vector<Cover> cover;
    std::vector<std::int16_t> ground;  // z of the highest block of earth
    std::vector<std::int16_t> crown;   // z of the highest leaf, or 0
};

// Sums over tiles and over the chunks under them.
struct LevelFigures {
    double columns = 0;                                         // of tiles
    std::array<double, kCoverCount> chunkCover{}, tileCover{};  // shares of the area
    std::array<double, kLandCount> areas{};                     // number
    std::array<double, kLandCount> heightBias{};  // blocks: mean height of tiles less that of chunks
    std::array<double, 4> chunkCrowns{},
        tileCrowns{};  // share under leaves, by how dense the forest is in chunks
    double chunkCrownHeight = 0, tileCrownHeight = 0;  // blocks above the ground
    double waterInBoth = 0, waterInAny = 0;  // columns of tiles: of both, of either; IoU is their quotient
};

// Places with `side` × `side` chunks each, whose corner is a multiple of `side`; side is 2^level at least.
struct FigureArea {
    int side = 32;
    std::vector<world::ChunkPos> corners;
};

class LevelComparison {
  public:
    LevelComparison(const gen::LevelGenerators& generators, const world::BlockRegistry& blocks,
                    FigureArea area);
    LevelFigures of(int level) const;

  private:
    Columns columnsOf(world::ChunkPos corner, int side, int level) const;
    Cover coverOf(const std::string& name) const;

    const gen::LevelGenerators& generators_;
    FigureArea area_;
    std::vector<Cover> covers_;    // by block
    std::vector<bool> isSeen_;     // by block: hides what is below
    std::vector<Columns> chunks_;  // by corner
};

// The sums as lines of a table.
std::string coverTable(const std::vector<LevelFigures>& levels);
std::string landTable(const std::vector<LevelFigures>& levels);

}  // namespace terrane::bench
