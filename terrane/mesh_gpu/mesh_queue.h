// Meshes chunks on the GPU between frames, as many at a time as a budget allows, without waiting: a batch is
// counted in one frame, and its quads are written in the next frame in which the counts are available. Until
// then the old quads are drawn. It is used on the context's thread.
#pragma once

#include <chrono>
#include <deque>
#include <span>
#include <unordered_set>
#include <vector>

#include "terrane/gpu/arena_allocator.h"
#include "terrane/mesh_gpu/gpu_mesher.h"

namespace terrane::mesh_gpu {

// A chunk whose quads are counted, with its mesh sections that have some. They are valid until the batch is
// written.
struct CountedChunk {
    world::ChunkPos pos;
    std::span<const mesh::MeshSection> meshSections;
};

// Addresses of the first quad of each mesh section of a chunk; empty if there is no room for them, or none.
using FirstQuads = std::vector<std::uint32_t>;

// A frame calls, in this order:
//
//   if (queue.isCounted()) { counted = queue.takeCounted(); make room; queue.write(places, buffers); }
//   if (chunks = queue.takeWaiting(); !chunks.empty()) queue.count(inputs of these chunks);
class MeshQueue {
  public:
    // The budget is the time of a batch on the CPU or the GPU, whichever takes longer; with 0 batches are as
    // large as possible.
    MeshQueue(GpuMesher mesher, double budgetMilliseconds);

    // Queues the chunk for meshing, again if a batch with it is in flight.
    void add(world::ChunkPos pos);
    // Removes the chunk from the queue and from a batch in flight.
    void remove(world::ChunkPos pos);
    // Returns whether the chunk is queued or in flight.
    bool contains(world::ChunkPos pos) const { return isWaiting_.contains(pos) || isInFlight(pos); }
    std::size_t size() const { return isWaiting_.size() + counting_.size(); }
    std::size_t gpuBytes() const { return mesher_.gpuBytes(); }

    // Returns whether a batch is in flight and its counts are available.
    bool isCounted() const { return !counting_.empty() && mesher_.isCounted(); }
    // Returns the chunks of that batch without those removed since it was counted. write() comes next.
    std::vector<CountedChunk> takeCounted();
    // Writes the quads of the chunks that takeCounted() returned, in the same order. Ends the batch.
    void write(std::span<const FirstQuads> places, const gpu::ArenaBuffers& quads);

    // Returns the chunks of the next batch; none while one is in flight. count() comes next, for exactly
    // these.
    std::vector<world::ChunkPos> takeWaiting();
    // Starts to count them. `chunks`: in the order of takeWaiting(), with the same options. Not needed
    // afterwards.
    void count(std::span<const mesh::MeshInput> chunks);

  private:
    using Clock = std::chrono::steady_clock;

    bool isInFlight(world::ChunkPos pos) const;
    void adaptBatch(std::size_t chunks, double milliseconds);

    GpuMesher mesher_;
    double budgetMilliseconds_;
    std::size_t batchSize_;
    std::deque<world::ChunkPos> waiting_;  // in order; some were removed again
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> isWaiting_;
    // The batch in flight, its removed chunks, and once it is counted the mesh sections of all.
    std::vector<world::ChunkPos> counting_;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> isRemoved_;
    CountedSections meshSections_;
    Clock::time_point start_;       // of counting or writing, whichever is under way
    double countMilliseconds_ = 0;  // of the batch, on the CPU
};

}  // namespace terrane::mesh_gpu
