#include "terrane/gen_gpu/pass_plan.h"

#include <algorithm>

#include "terrane/gen/chunks_around.h"

namespace terrane::gen_gpu {

PassCounts neededPasses(const gen::GeneratorGraph& generator, const std::vector<world::ChunkPos>& requested) {
    const int passCount = static_cast<int>(generator.passes.size());
    PassCounts counts;
    for (const world::ChunkPos pos : requested) counts[pos] = passCount;
    // A pass asks its neighbors only for lower ones: from the last pass down each count is final when it is
    // used.
    for (int pass = passCount; pass-- > 0;) {
        const int needed = gen::passesNeededAround(generator, pass);
        if (needed == 0) continue;
        std::vector<world::ChunkPos> running;
        for (const auto& [pos, count] : counts) {
            if (count > pass) running.push_back(pos);
        }
        for (const world::ChunkPos pos : running) {
            for (const world::ChunkPos around : gen::chunksAround(pos)) {
                counts[around] = std::max(counts[around], needed);
            }
        }
    }
    return counts;
}

}  // namespace terrane::gen_gpu
