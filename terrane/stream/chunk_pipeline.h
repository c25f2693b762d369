// Loads, lights and meshes the chunks around a camera on worker threads, and passes edits to the screen and
// the store.
//
// Schedulers over one table of chunk records (chunk_table.h) select the next work; this class runs it.
// All functions are called on one thread, the one that owns the world; workers see only immutable snapshots
// and return results through a queue.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "terrane/stream/change_queue.h"
#include "terrane/stream/chunk_table.h"
#include "terrane/stream/chunk_workers.h"
#include "terrane/stream/depth.h"
#include "terrane/stream/meshing.h"
#include "terrane/stream/pipeline_types.h"
#include "terrane/stream/residency.h"
#include "terrane/world/changes/block_edit.h"

namespace terrane::stream {

class ChunkPipeline {
  public:
    using Time = stream::Time;

    explicit ChunkPipeline(const PipelineParts& parts);
    ~ChunkPipeline();  // waits for its running jobs, the others do nothing; saves edited chunks

    // Sets the view: chunks up to `viewDistance` (Chebyshev) around `center` become visible, and tiles beyond
    // them up to `horizon` (see TileView). `direction` is that of ViewOrder.
    void setView(world::ChunkPos center, int viewDistance, glm::vec2 direction = {}, int horizon = 0);
    // Sets the height of the camera, z of a block: deep ground is made only near it and where it is open
    // (depth.h). Without one, which is so at first, chunks are made to the bottom of the world.
    void setCameraHeight(std::optional<int> z);
    // Returns a z that is no higher than the lowest block that the view needs. It looks at all chunks.
    int lowestNeeded() const { return stream::lowestNeeded(table_) * world::kSectionSize; }
    // Sets the options. Visible chunks are meshed again in the next updates; they are shown as before until
    // then.
    void setMeshOptions(const mesh::MeshOptions& options);
    const mesh::MeshOptions& meshOptions() const { return meshOptions_; }
    // Selects who meshes whole chunks from now on.
    void setMeshing(MeshPolicy meshing) { parts_.meshing = meshing; }
    // Returns the current blocks that the chunk is meshed from.
    mesh::MeshBlocks meshBlocks(world::ChunkPos pos) const;
    // Receives the results of workers, updates meshes and light after edits, and submits new work. Call it
    // each frame. It rethrows exceptions of workers.
    void update(Time now = std::chrono::steady_clock::now());
    // Blocks until a worker or a batch may have a result, or the time is over. Runs a job if there are no
    // threads.
    void waitForWorkers(std::chrono::milliseconds timeout);

    // Returns the whole chunk, or null if it is not loaded to its bottom; then it is soon. Each call keeps it
    // loaded for 5 s.
    world::ChunkPtr maybeLoadChunkAt(world::ChunkPos pos);
    // Returns the chunk and blocks until it is loaded. `pos` is in the world.
    world::ChunkPtr chunkAt(world::ChunkPos pos);

    // Reports changed blocks. Light and mesh follow in the next update; the chunks go to the store after
    // kSaveDelay and are in the file store::SaveLimits::delay later: within two seconds in all.
    void onEdits(std::span<const world::BlockEdit> edits);
    static constexpr std::chrono::milliseconds kSaveDelay{500};
    static constexpr std::chrono::milliseconds kHousekeepingInterval{250};
    // Passes all edited chunks to the store.
    void saveAll();
    // Sets a filter: chunks for which it returns false are not saved yet and stay loaded, because their
    // changes may be reverted. With an empty filter all chunks are saved.
    void setSaveFilter(std::function<bool(world::ChunkPos)> maySave) { maySave_ = std::move(maySave); }
    // Returns whether the chunk has edits that were not passed to the store yet.
    bool isUnsaved(world::ChunkPos pos) const;
    // Returns the chunks that were loaded since the last call; the first call begins to record them. Callers
    // that change loaded chunks need it.
    std::vector<world::ChunkPos> takeLoaded();

    // Returns up to `limit` chunks whose mesh or light changed since the last call. Edited chunks come first,
    // then the rest in order of change.
    std::vector<ChunkChange> takeChanges(std::size_t limit) { return changes_.take(limit); }
    // Removes and returns only chunks that are no longer on screen, before all other changes, since they free
    // memory.
    std::vector<world::ChunkPos> takeHidden() { return changes_.takeHidden(); }
    // Removes all chunks from the screen. They are lit, meshed and shown again in the next updates.
    void hideAll();
    std::size_t waitingChanges() const { return changes_.size(); }
    // Reports the light of all visible chunks again, for a renderer with a new store of light.
    void resendLight();

    // Returns the stage of the chunk, or nothing if it is absent.
    std::optional<ChunkStage> stageAt(world::ChunkPos pos) const { return stream::stageAt(table_, pos); }
    // Returns the light in a block; none if its chunk is not visible, and above and below the world.
    std::optional<light::LightValue> lightAt(world::BlockPos pos) const;
    std::vector<TaskTime> taskTimes() const { return workers_.taskTimes(); }
    std::size_t queuedCount() const;  // chunks that are being loaded, lit or meshed
    Progress progress() const;
    // These return the bytes of the light of visible chunks, and of local light, which is stored until the
    // neighbors are lit.
    std::size_t lightBytes() const;
    std::size_t localLightBytes() const;

  private:
    ChunkNeighborhood around(world::ChunkPos pos) const;
    void takeResults();
    void onLoaded(world::ChunkPos pos, ReadChunk read, LocalLightPtr local);
    void onDeepened(const WorkerResults::Deepened& deepened);
    void findOpenSections(std::span<const world::BlockEdit> edits);
    void onLit(world::ChunkPos pos, light::ChunkLightPtr light, MeshPtr mesh);
    void dropLocalLightAround(world::ChunkPos pos);
    void exchangeChunks();
    void exchangeLight();
    void submitLoads();
    void submitDepths();
    void submitLighting();
    void submitMeshes();
    std::size_t roomFor(std::size_t running) const;

    void relight();
    void meshEdits();
    void showMesh(world::ChunkPos pos, mesh::MeshSectionSet meshSections);

    void cancelLoads();
    void runHousekeeping();
    bool save(world::ChunkPos pos, ChunkRecord& record);
    world::ChunkPtr wholeChunk(world::ChunkPos pos) const;

    PipelineParts parts_;
    mesh::MeshOptions meshOptions_;
    ChunkTable table_;
    TileView tileView_;  // for the chunks that border on tiles
    world::ChunkPtr beyond_;
    ChangeQueue changes_;
    ChunkWorkers workers_;
    // The chunks for the batch generator and the batch lighter, and the number of chunks in flight in each.
    std::deque<world::ChunkPos> toGenerate_, toLight_;
    std::size_t generating_ = 0, lighting_ = 0;
    PendingEdits toRelight_;
    std::function<bool(world::ChunkPos)> maySave_;
    std::vector<world::ChunkPos> loaded_;
    bool notesLoaded_ = false;
    Time now_{}, nextHousekeeping_{};  // now: of the last update
    Time::duration sinceUpdate_{};     // between the last two updates
};

}  // namespace terrane::stream
