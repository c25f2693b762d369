// Light of single chunks from scratch, many at a time, by whichever back end: the calling thread here,
// compute shaders in terrane/light_gpu. They give the same light as lightChunk (light_chunk.h), to the bit.
// Used on one thread; that of terrane/light_gpu is the context's.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "terrane/light/light_area.h"
#include "terrane/world/coords.h"

namespace terrane::light {

struct LightRequest {
    world::ChunkPos pos;  // level 0: light loses levels by the block
    // The chunk to light in the middle (4) and what is around it, by y, then x. Null: nothing is known there,
    // and it counts as dark and opaque.
    std::array<world::ChunkPtr, kFieldChunks> chunks;
};

struct LightResult {
    world::ChunkPos pos;
    ChunkLight light;
};

class BatchLighter {
  public:
    virtual ~BatchLighter() = default;

    // Starts a batch from the front of `requests` and returns how many it took. 0 when as many batches are in
    // flight as there is room for: take one first. Does not wait, and keeps what it needs of the chunks. A
    // batch is cheapest where its chunks lie together, since neighbors share their blocks. Throws
    // std::invalid_argument, and takes none, where a chunk of the batch is not of level 0.
    [[nodiscard]] virtual std::size_t submit(std::span<const LightRequest> requests) = 0;

    // The oldest batch in the order of its requests, if it is finished (with `wait`: once it is); otherwise,
    // and where none is in flight, nothing.
    [[nodiscard]] virtual std::vector<LightResult> take(bool wait) = 0;

    virtual std::string_view backend() const = 0;  // "cpu" or "gpu"
};

// On the calling thread, which works in take() even where it is not asked to wait. Up to 64 requests a batch,
// 110 KB for each chunk that they name while it is worked on. `table` outlives it.
std::unique_ptr<BatchLighter> makeCpuLighter(const LightTable& table);

// The light of all chunks, in the order of `requests`. Waits; nothing else may be in flight.
std::vector<ChunkLight> lightAll(BatchLighter& lighter, std::span<const LightRequest> requests);

// One chunk of an area and what the area has around it. The area's chunks outlive it.
LightRequest requestIn(const LightArea& area, int x, int y);

// Throws std::invalid_argument where the chunk has no level 0: for back ends.
void requireLevel0(const LightRequest& request);

}  // namespace terrane::light
