// Lists the chunks that are solved together, each once, and their neighbors. Pure bookkeeping without OpenGL.
// Used by gpu_batch_lighter.cpp.
#pragma once

#include <span>
#include <vector>

#include "terrane/light/batch_lighter.h"
#include "terrane/shared/light_solver.h"

namespace terrane::light_gpu {

// 16×16 neighboring chunks with one chunk around them, because light travels 15 blocks.
constexpr std::size_t kMaxRequests = 16 * 16;
constexpr std::size_t kMaxSolved = 18 * 18;

struct LightBatch {
    std::vector<world::ChunkPos> requested;
    std::vector<world::ChunkPtr> chunks;  // the requested ones, in order, then their neighbors
    std::vector<shared::uvec4> beside;  // by chunk: numbers of its neighbors at −x, +x, −y, +y, or kNoChunk
};

// Takes as many requests from the front as fit, at least one. A batch has one snapshot of a chunk, so it ends
// before a request that has another one, or that asks for the same chunk again.
LightBatch gatherBatch(std::span<const light::LightRequest> requests);

}  // namespace terrane::light_gpu
