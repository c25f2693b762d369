// Lights single chunks from scratch, in batches. Back ends: the calling thread here, compute shaders in
// terrane/light_gpu. They give the same light as lightChunk (light_chunk.h), to the bit. It is used on one
// thread; that of terrane/light_gpu is the context's.
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
    // The chunk to light in the middle (4) and its neighbors, by y, then x. A null chunk is unknown: it
    // counts as dark and opaque.
    std::array<world::ChunkPtr, kFieldChunks> chunks;
};

struct LightResult {
    world::ChunkPos pos;
    ChunkLight light;
};

class BatchLighter {
  public:
    virtual ~BatchLighter() = default;

    // Starts a batch from the front of `requests` and returns how many it took; 0 when no more batches fit in
    // flight: take one first. It does not wait, and the chunks are not needed afterwards. A batch is cheapest
    // when its chunks are neighbors, since they share blocks. Throws std::invalid_argument, and takes none,
    // if a chunk of the batch is not of level 0.
    [[nodiscard]] virtual std::size_t submit(std::span<const LightRequest> requests) = 0;

    // Returns the results of the oldest batch, in the order of its requests, if it is finished (with `wait`:
    // once it is); otherwise, or if none is in flight, nothing.
    [[nodiscard]] virtual std::vector<LightResult> take(bool wait) = 0;

    virtual std::string_view backend() const = 0;  // "cpu" or "gpu"
};

// Creates a lighter that works on the calling thread, in take(), even without `wait`. A batch has up to 64
// requests and takes 110 KB for each chunk that they name. `table` outlives it.
std::unique_ptr<BatchLighter> makeCpuLighter(const LightTable& table);

// Returns the light of all chunks, in the order of `requests`. Waits; nothing else may be in flight.
std::vector<ChunkLight> lightAll(BatchLighter& lighter, std::span<const LightRequest> requests);

// Returns the request for one chunk of an area with its neighbors in the area. The area's chunks outlive it.
LightRequest requestIn(const LightArea& area, int x, int y);

// Back ends call it. It throws std::invalid_argument if the chunk is not of level 0.
void requireLevel0(const LightRequest& request);

}  // namespace terrane::light
