// A generator ready to run for one world seed and one level: position in, chunk out. The blocks depend on
// nothing but the generator, the seed and the position: not on threads, order of requests or instruction set.
//
// What neighbors may need of a chunk is computed once and kept, in a cache of bounded size; what they do not
// is computed with the chunk itself.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gen/down_passes.h"
#include "terrane/gen/executor.h"
#include "terrane/gen/generator_graph.h"
#include "terrane/world/chunk.h"
#include "terrane/world/coords.h"

namespace terrane::gen {

// Room for what chunks' neighbors need of them: 1 KiB a field and, where they read blocks, 128 KiB a 3D
// pass. Overworld: 15 KiB a chunk, so that the default holds 4,350 chunks, more than the 4,225 of a view
// of 32.
struct CacheSize {
    std::size_t bytes = std::size_t{64} << 20;
    // Kept even where they need more bytes: with less than some rows of a wide area nearly everything would
    // be computed again.
    std::size_t minChunks = 256;
};

// A ring of tiles is at most 64 wide and made row by row: 8 MiB hold 8 rows of it, and neighbors need 4.
constexpr CacheSize cacheSizeOf(int level) {
    return level == 0 ? CacheSize{} : CacheSize{.bytes = std::size_t{8} << 20};
}

// Whether a generator of `level` makes the chunk: of that level, in the world. Nobody gets blocks of another
// level in place of those.
constexpr bool isGenerated(world::ChunkPos pos, int level = 0) {
    return pos.level == level && world::isInWorld(pos);
}
// The reason where it is not.
base::Result<void> checkGenerated(world::ChunkPos pos, int level = 0);
// Throws std::invalid_argument with the reason.
void requireGenerated(world::ChunkPos pos, int level = 0);

// How a 3D pass went over a chunk.
struct PassReport {
    int pass;
    std::vector<SlabRun> slabs;     // from the bottom
    std::size_t wholeInstructions;  // of a layer, when nothing is left out
};

class Generator {
  public:
    Generator(GeneratorGraph graph, std::uint64_t seed);  // with the cache of the graph's level
    Generator(GeneratorGraph graph, std::uint64_t seed, CacheSize cacheSize);
    ~Generator();
    Generator(Generator&&) noexcept;
    Generator& operator=(Generator&&) noexcept;

    // Any thread, any number at a time. Where one runs out of memory the others go on. Throws
    // std::invalid_argument unless isGenerated(pos, level()). Beyond the world's edge generation sees
    // coordinates wrap.
    world::Chunk generate(world::ChunkPos pos) const;

    // The same, and how its 3D passes went as far as neighbors had not asked for them.
    world::Chunk generate(world::ChunkPos pos, std::vector<PassReport>& report) const;

    // The chunk's blocks from the top down, no deeper than `take` asks for: cheaper than generate() for those
    // who look at the land from above. Calls it with one layer after the other until it wants no column
    // any more; layers of one block that are the same as the one above are left out. Threads and errors as
    // generate(); `take` may throw.
    void generateDown(world::ChunkPos pos, const LayerTaker& take) const;

    // What 2D passes write to a field in the chunk's columns, x + 16 y, of a graph that has no 3D passes
    // (tint_graph.h). Threads and errors as generate().
    std::array<Bits, 256> columns(world::ChunkPos pos, std::uint32_t field) const;

    const std::string& name() const;
    int level() const;
    std::size_t cacheBytes() const;  // in use

  private:
    world::Chunk generate(world::ChunkPos pos, std::vector<PassReport>* report) const;

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::gen
