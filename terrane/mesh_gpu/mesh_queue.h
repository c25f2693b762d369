// Meshes chunks on the GPU between frames, as many at a time as a budget allows, without waiting: a batch is
// counted in one frame, and its quads are written in the next one that finds the counts there. Until then
// the old quads are drawn. Used on the context's thread.
#pragma once

#include <deque>
#include <functional>
#include <span>
#include <unordered_set>
#include <vector>

#include "terrane/mesh_gpu/gpu_mesher.h"

namespace terrane::mesh_gpu {

// What the queue takes chunks from and gives their quads to.
struct MeshQueueHost {
    // What a chunk is meshed from, as it is now.
    std::function<mesh::MeshBlocks(world::ChunkPos)> blocks;
    // Makes room for a chunk's quads and says where those of each region begin; empty where there is no room.
    std::function<std::vector<std::uint32_t>(world::ChunkPos, std::span<const mesh::RegionMesh>)> place;
    // The buffer that the places are in.
    std::function<const gpu::Buffer&()> quads;
};

class MeshQueue {
  public:
    // Time of a batch, on the processor or the GPU, whichever takes longer: 0 for as large ones as can be.
    MeshQueue(GpuMesher mesher, const world::BlockRegistry& blocks, double budgetMilliseconds);

    // The chunk is to be meshed: once more where a batch with it is on the way.
    void add(world::ChunkPos pos);
    // It is not to be shown any more.
    void remove(world::ChunkPos pos);
    // It will be meshed from what it is when its turn comes, or later.
    bool contains(world::ChunkPos pos) const { return isWaiting_.contains(pos) || isCounted(pos); }
    std::size_t size() const { return isWaiting_.size() + counted_.size(); }

    // Writes the quads of the batch on the way, if it is counted, and begins the next one.
    void advance(const mesh::MeshOptions& options, const MeshQueueHost& host);

  private:
    bool isCounted(world::ChunkPos pos) const;
    void write(const MeshQueueHost& host);
    void count(const mesh::MeshOptions& options, const MeshQueueHost& host);
    void adaptBatch(std::size_t chunks, double milliseconds);

    GpuMesher mesher_;
    const world::BlockRegistry& blocks_;
    double budgetMilliseconds_;
    std::size_t batchSize_;
    std::deque<world::ChunkPos> waiting_;  // in order; some were removed again
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> isWaiting_;
    // The batch on the way, and those of it that were removed.
    std::vector<world::ChunkPos> counted_;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> isRemoved_;
    double countMilliseconds_ = 0;  // of it, on the processor
};

}  // namespace terrane::mesh_gpu
