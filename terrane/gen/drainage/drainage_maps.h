// The drainage maps of a generator for one world seed: rivers and lakes near tiles, from regions that are
// made when first needed and stored in a cache of bounded size. Both back ends use it. Any thread; a region
// is made by the first one that needs it while others wait.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/noise/sample_grid.h"
#include "terrane/shared/drainage.h"

namespace terrane::gen {

struct DrainageRegion;

// Segments and lakes that may be within reach of a column of a tile, in the order of cells by y, then x. On a
// tie the first one counts.
struct DrainageTile {
    std::vector<shared::RiverSegment> segments;
    std::vector<shared::vec4> lakes;
    float reach = 0, valleyReach = 0;
    std::int32_t step = 1;  // blocks from column to column
};

// The number of cached regions per map. One is 128² cells, 32,768² blocks with the default spacing, and takes
// up to 3 MB where few nodes have a river, 8 MB with valleys, 14 MB where all are rivers: a row of 64 tiles
// of step 32 crosses three of half that spacing.
constexpr std::size_t kMaxCachedRegions = 8;
constexpr std::size_t kMaxCachedRegionBytes = std::size_t{64} << 20;  // the newest region is kept anyway

class DrainageMaps {
  public:
    DrainageMaps(const std::vector<DrainageGraph>& graphs, std::uint64_t worldSeed);
    ~DrainageMaps();

    // Prepares the tile whose first column is at the grid's position.
    void prepare(DrainageTile& tile, std::uint32_t map, SampleGrid grid);

    std::size_t cachedRegions() const;  // of all maps
    std::size_t bytes() const;          // that they take

  private:
    struct Map;
    std::vector<std::unique_ptr<Map>> maps_;
};

}  // namespace terrane::gen
