// The tint of grass and leaves over an area of a map, from a few samples, since it changes slowly. Any thread
// may use it.
#pragma once

#include <mutex>
#include <vector>

#include "terrane/gen/level_generators.h"
#include "terrane/map/lru_cache.h"
#include "terrane/map/surface_source.h"
#include "terrane/world/tint.h"

namespace terrane::map {

// Samples 16 columns apart: sample (i, j) is at column x0 + 16 i, y0 + 16 j.
struct TintField {
    static constexpr int kStep = 16;
    std::int64_t x0 = 0, y0 = 0;
    int width = 0, height = 0;                // samples
    std::vector<world::PackedColor> samples;  // sample (i, j) is at i + width · j
};

// Computes tint fields, and caches tints that neighbors share.
class TintSource {
  public:
    // `generators` outlives this.
    explicit TintSource(const gen::LevelGenerators& generators) : generators_(generators) {}

    // Returns a field that extends beyond the rectangle, so that each of its columns lies between four
    // samples. The tint is neutral outside the world and if the generator has none.
    TintField field(const ColumnRect& rect);
    // Returns the tint of a whole chunk.
    world::PackedColor of(world::ChunkPos chunk);

  private:
    world::PackedColor sample(int level, std::int64_t x, std::int64_t y);

    const gen::LevelGenerators& generators_;
    std::mutex mutex_;  // guards the tiles
    LruCache<world::ChunkPos, std::shared_ptr<const world::TintTile>, world::ChunkPosHash> tiles_{4 << 20};
};

}  // namespace terrane::map
