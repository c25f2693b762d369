#include "terrane/gen_gpu/pass_plan.h"

#include <algorithm>

namespace terrane::gen_gpu {
namespace {

// How many passes the neighbours of a chunk must have done before it runs `pass`; 0 where it reads none of
// theirs.
int neededFromNeighbours(const gen::GeneratorGraph& generator, std::size_t pass) {
    int needed = 0;
    for (const std::uint32_t f : generator.passes[pass].readsAt) {
        needed = std::max(needed, generator.fields[f].writtenBy + 1);
    }
    return needed;
}

}  // namespace

std::array<world::ChunkPos, 9> chunksAround(world::ChunkPos pos) {
    const auto wrap = [](std::int32_t v) {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(v) << 4) >> 4;
    };
    std::array<world::ChunkPos, 9> around;
    for (int n = 0; n < 9; ++n) {
        around[static_cast<std::size_t>(n)] = {wrap(pos.x + n % 3 - 1), wrap(pos.y + n / 3 - 1)};
    }
    return around;
}

PassCounts neededPasses(const gen::GeneratorGraph& generator, const std::vector<world::ChunkPos>& wanted) {
    const int passCount = static_cast<int>(generator.passes.size());
    PassCounts counts;
    for (const world::ChunkPos pos : wanted) counts[pos] = passCount;
    // A pass asks its neighbours only for lower ones: from the last pass down each count is final when it is
    // used.
    for (int pass = passCount; pass-- > 0;) {
        const int needed = neededFromNeighbours(generator, static_cast<std::size_t>(pass));
        if (needed == 0) continue;
        std::vector<world::ChunkPos> running;
        for (const auto& [pos, count] : counts) {
            if (count > pass) running.push_back(pos);
        }
        for (const world::ChunkPos pos : running) {
            for (const world::ChunkPos around : chunksAround(pos)) {
                counts[around] = std::max(counts[around], needed);
            }
        }
    }
    return counts;
}

}  // namespace terrane::gen_gpu
