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

// The number of cached regions per map. One is 32² cells, 8,192² blocks with the default spacing, and takes
// up to 0.2 MB where few nodes have a river, 0.5 MB with valleys, 0.9 MB where all are rivers: a row of 64
// tiles of step 32 crosses nine of half that spacing, or both rows of them that meet there.
constexpr std::size_t kMaxCachedRegions = 64;
constexpr std::size_t kMaxCachedRegionBytes = std::size_t{32} << 20;  // the newest region is kept anyway

// Calls that read a tile: Pass::drainage, Pass::valleys. A tile for one of them leaves out pieces that cannot
// count in the other.
struct DrainageUses {
    bool rivers, valleys;
};

class DrainageMaps {
  public:
    DrainageMaps(const std::vector<DrainageGraph>& graphs, std::uint64_t worldSeed);
    ~DrainageMaps();

    // Prepares the tile whose first column is at the grid's position, for the calls of `uses`.
    void prepare(DrainageTile& tile, std::uint32_t map, SampleGrid grid, DrainageUses uses = {true, true});

    std::size_t cachedRegions() const;  // of all maps
    std::size_t bytes() const;          // that they take

  private:
    struct Map;
    std::vector<std::unique_ptr<Map>> maps_;
};

}  // namespace terrane::gen
