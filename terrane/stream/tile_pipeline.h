// Makes the tiles that a view needs beyond its chunks, on worker threads: from the store where edits changed
// them, else straight from the generator, without light and without neighbors. tile_table.h has the rules.
// Used on the thread that owns the world; workers hand results back through a queue.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/gen/level_generators.h"
#include "terrane/mesh/mesh_options.h"
#include "terrane/store/chunk_store.h"
#include "terrane/stream/pipeline_types.h"
#include "terrane/stream/tile_table.h"

namespace terrane::stream {

// Everything outlives the pipeline.
struct TileParts {
    base::JobSystem& jobs;
    const world::BlockRegistry& blocks;  // as seen from afar
    const gen::LevelGenerators& generators;
    store::ReadableStore* store = nullptr;  // has the tiles that edits changed (tile_rows.h); null: none
};

struct TileMesh {
    world::ChunkPos pos;
    MeshPtr mesh;
};

// Tiles that are not any more what they were. Any thread may call it, also when the pipeline is gone.
using TileListener = std::function<void(std::span<const world::ChunkPos>)>;

// Blocks and mesh of a tile. Any thread. Throws where there is no generator of the level.
MeshPtr makeTile(const TileParts& parts, world::ChunkPos pos, mesh::MergeMethod method);

class TilePipeline {
  public:
    explicit TilePipeline(const TileParts& parts);
    ~TilePipeline();  // waits for all running jobs; its waiting ones do nothing

    void setView(const TileView& view) { setTileView(table_, view); }
    // A chunk of level 0 can be shown, or no longer.
    void setChunkReady(world::ChunkPos pos, bool isReady) { stream::setChunkReady(table_, pos, isReady); }
    // Tells the pipeline of tiles to be made again. The listener may outlive it.
    TileListener tileListener() const;
    // Takes in what workers finished, and gives out new work after all chunks that wait. Call each frame.
    // What a worker threw is thrown on from here.
    void update(mesh::MergeMethod method);
    // Blocks until a worker may have finished a tile, or the time is over.
    void waitForWorkers(std::chrono::milliseconds atMost);

    // Up to `limit` tiles that are new. The caller can show them from here on.
    std::vector<TileMesh> takeMeshes(std::size_t limit);
    // One of them found no room: it is taken again, unless the view has no place for it any more.
    void putBack(TileMesh mesh);
    // What is to be shown, hidden and dropped, by what the caller has. Cancels the work on what is dropped.
    TileChanges takeChanges();

    // The caller has nothing any more: everything comes again.
    void forgetAll();

    const TileTable& table() const { return table_; }
    TaskTime taskTime() const;  // of tiles made so far, on all workers
    // Tiles that are wanted and that the caller does not have.
    std::size_t missing() const { return missingTiles(table_); }

  private:
    struct Results;
    struct Job {
        world::ChunkPos tile;
        base::JobHandle handle;
    };

    void takeResults();
    void submit(world::ChunkPos tile);

    TileParts parts_;
    TileTable table_;
    std::vector<TileMesh> finished_;
    std::unordered_map<std::uint64_t, Job> jobs_;  // given out and not over, by number
    std::uint64_t jobCount_ = 0;
    mesh::MergeMethod method_{};  // of the last update
    std::shared_ptr<Results> results_;
};

}  // namespace terrane::stream
