// Makes the tiles that a view needs beyond its chunks, on worker threads: from the store if edits changed
// them, else from the generator, without light and without neighbors. tile_table.h has the rules. It is used
// on the thread that owns the world; workers return results through a queue.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/gen/level_generators.h"
#include "terrane/mesh/mesh_options.h"
#include "terrane/store/chunk_store.h"
#include "terrane/stream/pipeline_types.h"
#include "terrane/stream/tile_table.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/chunk.h"

namespace terrane::stream {

// The depth of water in blocks that hides the ground: on far tiles no light is left after 15
// (render/water/water.glsl), and the color of the water itself is within a twentieth of that of deep water.
constexpr int kMaxVisibleDepth = 24;

// Raises ground of a tile that lies deeper than kMaxVisibleDepth under a liquid to that depth, with one kind
// of block: in tiles with a quarter of sea this saves most quads, which are invisible.
void raiseDeepFloor(world::Chunk& tile, const world::BlockRegistry& blocks);

// The parts of the pipeline, which all outlive it.
struct TileParts {
    base::JobSystem& jobs;
    const world::BlockRegistry& blocks;  // as seen from afar
    const gen::LevelGenerators& generators;
    store::ReadableStore* store = nullptr;  // has the tiles that edits changed (edited_tiles.h); null: none
};

struct TileMesh {
    world::ChunkPos pos;
    MeshPtr mesh;            // null if none is asked for
    world::ChunkPtr blocks;  // that it shows
};

// Receives tiles that have changed. Any thread may call it, also after the end of the pipeline.
using TileListener = std::function<void(std::span<const world::ChunkPos>)>;

// Makes a tile and, with a method, its mesh. Any thread may call it. Throws if the level has no generator.
TileMesh makeTile(const TileParts& parts, world::ChunkPos pos, std::optional<mesh::MergeMethod> method);

class TilePipeline {
  public:
    explicit TilePipeline(const TileParts& parts);
    ~TilePipeline();  // waits for all running jobs; its waiting ones do nothing

    void setView(const TileView& view) { setTileView(table_, view); }
    // Sets whether a chunk of level 0 can be shown.
    void setChunkReady(world::ChunkPos pos, bool isReady) { stream::setChunkReady(table_, pos, isReady); }
    // Returns a listener. The pipeline makes the tiles of its calls again. It may outlive the pipeline.
    TileListener tileListener() const;
    // Receives the results of workers and submits new work. Call it each frame. It rethrows exceptions of
    // workers. Without a method tiles have no meshes.
    void update(std::optional<mesh::MergeMethod> method);
    // Blocks until a worker may have finished a tile, or the time is over. Runs a job if there are no
    // threads.
    void waitForWorkers(std::chrono::milliseconds timeout);

    // Removes and returns up to `limit` new tiles, which the caller can show from now on.
    std::vector<TileMesh> takeMeshes(std::size_t limit);
    // Returns a tile to the pipeline for lack of memory: takeMeshes() returns it again, unless the view no
    // longer includes it.
    void putBack(TileMesh mesh);
    // Returns the tiles to show, hide and drop among those that the caller has. Cancels the work on dropped
    // tiles.
    TileChanges takeChanges();

    // Makes all tiles again, after the caller has dropped all chunks and tiles.
    void invalidateAll();

    const TileTable& table() const { return table_; }
    TaskTime taskTime() const;  // of tiles made so far, on all workers
    // Returns the number of requested tiles that the caller does not have.
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
    std::unordered_map<std::uint64_t, Job> jobs_;  // submitted and not finished, by number
    std::uint64_t jobCount_ = 0;
    std::optional<mesh::MergeMethod> method_;  // of the last update
    std::shared_ptr<Results> results_;
};

}  // namespace terrane::stream
