// Keeps the chunks around a camera generated and meshed, on worker threads, nearest first.
//
// A chunk's way: wanted → generating → active (in the world) → meshing → visible. It is meshed only once the
// eight chunks around it are active. All functions are for one thread, the one that owns the world; workers
// see only immutable chunks and hand results back through a queue.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/gen/generator.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::stream {

struct MeshChange {
    world::ChunkPos pos;
    std::shared_ptr<const mesh::ChunkMesh> mesh;  // null: the chunk is no longer visible
};

struct Progress {
    std::size_t wanted = 0;   // chunks within the view distance
    std::size_t visible = 0;  // of these, meshed
    bool complete() const { return visible == wanted; }
};

class ChunkPipeline {
  public:
    // All arguments outlive the pipeline.
    ChunkPipeline(base::JobSystem& jobs, const gen::Generator& generator, const world::BlockRegistry& blocks,
                  world::World& world);
    ~ChunkPipeline();  // waits for its running jobs

    // Chunks up to `viewDistance` (Chebyshev) around `centre` are to be visible.
    void setView(world::ChunkPos centre, int viewDistance);
    // How chunks are meshed from now on; those that were meshed otherwise are meshed again, and shown as they
    // were until then.
    void setMeshOptions(const mesh::MeshOptions& options);
    // Takes in what workers finished and gives them new work. Call each frame.
    void update();
    // Blocks until a worker has finished something or the time is over.
    void waitForWorkers(std::chrono::milliseconds atMost);

    // The chunk's blocks changed: it is meshed again, and the neighbours that see its border.
    void blocksChanged(world::BlockPos pos);

    // What changed on screen since the last call, at most `limit` chunks. Of a chunk only the newest mesh.
    std::vector<MeshChange> takeMeshes(std::size_t limit);

    Progress progress() const;

  private:
    struct Results;

    void orderOffsets();
    void submitGeneration();
    void submitMesh(world::ChunkPos pos);
    void meshWhereReady(world::ChunkPos around);
    void onGenerated(world::ChunkPos pos, world::ChunkPtr chunk);
    void unloadDistant();
    void addChange(world::ChunkPos pos, std::shared_ptr<const mesh::ChunkMesh> mesh);
    world::ChunkPtr chunkOrOutside(world::ChunkPos pos) const;
    bool isReadyToMesh(world::ChunkPos pos) const;
    base::JobPriority priority(world::ChunkPos pos) const;

    base::JobSystem& jobs_;
    const gen::Generator& generator_;
    const world::BlockRegistry& blocks_;
    world::World& world_;
    std::shared_ptr<Results> results_;
    world::ChunkPtr outside_;  // stands for chunks beyond the world's edge: air

    world::ChunkPos centre_;
    int viewDistance_ = -1;
    mesh::MeshOptions meshOptions_;
    std::vector<world::ChunkPos> offsets_;  // of wanted chunks and the ring around them, nearest first
    std::size_t nextOffset_ = 0;            // those before are active or being generated

    std::unordered_map<world::ChunkPos, base::JobHandle, world::ChunkPosHash> generating_;
    // Number of the newest mesh asked for; results of older ones are dropped.
    std::unordered_map<world::ChunkPos, std::uint64_t, world::ChunkPosHash> meshAsked_;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> visible_;
    std::uint64_t meshNumber_ = 0;
    // What was not taken yet: the newest by chunk, and the chunks in the order in which they first changed.
    std::unordered_map<world::ChunkPos, std::shared_ptr<const mesh::ChunkMesh>, world::ChunkPosHash> changes_;
    std::deque<world::ChunkPos> changed_;
};

}  // namespace terrane::stream
