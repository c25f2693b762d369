// Keeps the chunks around a camera loaded, lit and meshed, on worker threads, and edits on screen and on
// disk.
//
// Three schedulers over one table of chunk records (chunk_table.h) decide what is next; this runs the work.
// All functions are for one thread, the one that owns the world; workers see only immutable snapshots and
// hand results back through a queue.
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
#include "terrane/stream/pending_edits.h"
#include "terrane/stream/pipeline_types.h"
#include "terrane/stream/tile_borders.h"
#include "terrane/world/block_edit.h"

namespace terrane::stream {

class ChunkPipeline {
  public:
    using Time = stream::Time;

    explicit ChunkPipeline(const PipelineParts& parts);
    ~ChunkPipeline();  // waits for its running jobs, the others do nothing; saves what changed

    // Chunks up to `viewDistance` (Chebyshev) around `center` are to be visible, tiles beyond them to
    // `horizon`: see TileView. `direction`: see ViewOrder.
    void setView(world::ChunkPos center, int viewDistance, glm::vec2 direction = {}, int horizon = 0);
    // Visible chunks are meshed again in the next updates; they are shown as before until then.
    void setMeshOptions(const mesh::MeshOptions& options);
    const mesh::MeshOptions& meshOptions() const { return meshOptions_; }
    // The blocks that the chunk is meshed from, as they are now.
    mesh::MeshBlocks meshBlocks(world::ChunkPos pos) const;
    // Takes in what workers finished, puts edits on screen, gives out new work. Call each frame.
    // What a worker threw is thrown on from here.
    void update(Time now = std::chrono::steady_clock::now());
    // Blocks until a worker or a batch may have finished something, or the time is over.
    void waitForWorkers(std::chrono::milliseconds atMost);

    // The chunk, or null unless it is loaded; then it is loaded soon, and is kept for 5 s from each call.
    world::ChunkPtr maybeLoadChunkAt(world::ChunkPos pos);
    // Blocks until the chunk is loaded. `pos` is in the world.
    world::ChunkPtr chunkAt(world::ChunkPos pos);

    // Blocks of the world changed. Light and mesh follow in the next update; the chunks go to the store after
    // kSaveAfter and are in the file store::SaveLimits::delay later: within two seconds in all.
    void onEdits(std::span<const world::BlockEdit> edits);
    static constexpr std::chrono::milliseconds kSaveAfter{500};
    static constexpr std::chrono::milliseconds kHousekeepingEvery{250};
    // Hands all edited chunks to the store.
    void saveAll();
    // Chunks for which it says no are not saved now, and stay loaded: what was changed in them may yet be
    // taken back. Empty: all are saved.
    void setSaveFilter(std::function<bool(world::ChunkPos)> maySave) { maySave_ = std::move(maySave); }
    // Whether the chunk has edits that the store was not given yet.
    bool isUnsaved(world::ChunkPos pos) const;
    // The chunks that were loaded since the last call, once asked for: for who adds to what the store has.
    std::vector<world::ChunkPos> takeLoaded();

    // Returns up to `limit` chunks whose mesh or light changed since the last call. Edited chunks come first,
    // then the rest in order of change.
    std::vector<ChunkChange> takeChanges(std::size_t limit) { return changes_.take(limit); }
    // Of these changes the chunks that are no longer on screen, before all others: they free memory.
    std::vector<world::ChunkPos> takeHidden() { return changes_.takeHidden(); }
    // Takes all chunks off the screen. They are lit, meshed and shown again in the next updates.
    void hideAll();
    std::size_t waitingChanges() const { return changes_.size(); }
    // Hands out the light of all visible chunks again, as to a renderer whose store of light is new.
    void resendLight();

    // None where the chunk is absent.
    std::optional<ChunkStage> stageAt(world::ChunkPos pos) const { return stream::stageAt(table_, pos); }
    // The light in a block; none where its chunk is not visible, above and below the world.
    std::optional<light::LightValue> lightAt(world::BlockPos pos) const;
    std::vector<TaskTime> taskTimes() const { return workers_.taskTimes(); }
    std::size_t queuedCount() const;  // chunks that are loaded, lit or meshed now
    Progress progress() const;
    // Of visible chunks' light, and of what chunks' own blocks give, kept until their neighbors are lit.
    std::size_t lightBytes() const;
    std::size_t localLightBytes() const;

  private:
    ChunkNeighborhood around(world::ChunkPos pos) const;
    void takeResults();
    void onLoaded(world::ChunkPos pos, std::shared_ptr<world::Chunk> chunk, LocalLightPtr local);
    void onLit(world::ChunkPos pos, light::ChunkLightPtr light, MeshPtr mesh);
    void dropLocalLightAround(world::ChunkPos pos);
    void exchangeChunks();
    void exchangeLight();
    void submitLoads();
    void submitLighting();
    void submitMeshes();
    std::size_t roomFor(std::size_t running) const;

    void relight();
    void meshEdits();
    void showMesh(world::ChunkPos pos, mesh::MeshSectionSet meshSections);

    void cancelLoads();
    void keepHouse();
    bool save(world::ChunkPos pos, ChunkRecord& record);

    PipelineParts parts_;
    mesh::MeshOptions meshOptions_;
    ChunkTable table_;
    TileView tileView_;  // what borders on tiles
    world::ChunkPtr beyond_;
    ChangeQueue changes_;
    ChunkWorkers workers_;
    // For the batch generator and the batch lighter, and how many chunks they have.
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
