// Solves the light of areas from scratch. Back ends: the CPU here, compute shaders in terrane/light_gpu. They
// give the same light, to the bit.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "terrane/light/light_area.h"

namespace terrane::light {

class AreaSolver {
  public:
    virtual ~AreaSolver() = default;

    // Returns the light of all chunks, in the order of `area.chunks`.
    virtual std::vector<ChunkLight> solve(const LightArea& area) = 0;
    virtual std::string_view backend() const = 0;  // "cpu" or "gpu"
};

// Used on one thread, any. `table` outlives it.
std::unique_ptr<AreaSolver> makeCpuSolver(const LightTable& table);

}  // namespace terrane::light
