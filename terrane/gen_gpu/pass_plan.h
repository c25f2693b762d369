// Plans the passes of each chunk that a batch needs: pure bookkeeping without OpenGL. Used by
// gpu_generator.cpp. Any thread.
#pragma once

#include <unordered_map>
#include <vector>

#include "terrane/gen/generator_graph.h"
#include "terrane/world/coords.h"

namespace terrane::gen_gpu {

using PassCounts = std::unordered_map<world::ChunkPos, int, world::ChunkPosHash>;

// Number of passes that each chunk must have done so that all of `requested` can be finished.
PassCounts neededPasses(const gen::GeneratorGraph& generator, const std::vector<world::ChunkPos>& requested);

}  // namespace terrane::gen_gpu
