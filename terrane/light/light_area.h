// Lights a whole area of chunks at once, for tools and tests; the streaming pipeline uses light_chunk.h.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "terrane/light/light_chunk.h"

namespace terrane::light {

// A rectangle of chunks; beyond it is dark. So only levels at least one chunk inside are those of the world.
struct LightArea {
    int chunksX = 0, chunksY = 0;
    std::vector<const world::Chunk*> chunks;  // chunksX × chunksY, x fastest, none null

    const world::Chunk& chunk(int x, int y) const {
        return *chunks[static_cast<std::size_t>(x + chunksX * y)];
    }
};

// Throws std::invalid_argument if the chunks are not as LightArea says.
void requireWhole(const LightArea& area);

// Returns the light of all chunks, in the order of `area.chunks`; requireWhole(area). One thread; it unpacks
// three rows of chunks at a time (about 300 KiB for each chunk of a row).
std::vector<ChunkLight> lightArea(const LightArea& area, const LightTable& table);

// Solves the light of areas from scratch. Back ends: the CPU here, compute shaders in terrane/light_gpu. They
// give the same light, to the bit.
class AreaSolver {
  public:
    virtual ~AreaSolver() = default;

    // Returns the light of all chunks, in the order of `area.chunks`.
    virtual std::vector<ChunkLight> solve(const LightArea& area) = 0;
    virtual std::string_view backend() const = 0;  // "cpu" or "gpu"
};

// Creates the solver of the CPU, which any one thread may use. `table` outlives it.
std::unique_ptr<AreaSolver> makeCpuSolver(const LightTable& table);

}  // namespace terrane::light
