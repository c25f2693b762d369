// Keeps the chunks around a camera loaded, lit and meshed, on worker threads, and edits on screen and on
// disk.
//
// Which chunk is to be what is for ChunkTable to say; this runs the work. All functions are for one thread,
// the one that owns the world; workers see only immutable snapshots and hand results back through a queue.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "terrane/light/relight.h"
#include "terrane/stream/chunk_table.h"
#include "terrane/stream/pipeline_types.h"

namespace terrane::stream {

struct WorkerResults;

class ChunkPipeline {
  public:
    using Time = ChunkTable::Time;

    explicit ChunkPipeline(const PipelineParts& parts);
    ~ChunkPipeline();  // waits for its running jobs, the others do nothing; saves what changed

    // Chunks up to `viewDistance` (Chebyshev) around `centre` are to be visible. `direction`: see ChunkTable.
    void setView(world::ChunkPos centre, int viewDistance, glm::vec2 direction = {});
    // Visible chunks are meshed again in the next updates; they are shown as before until then.
    void setMeshOptions(const mesh::MeshOptions& options);
    // Before the first update: whoever takes the changes makes the meshes of whole chunks, as on the GPU,
    // from meshBlocks(). Edits stay here: they are to be seen at once.
    void leaveMeshesOut() { leavesMeshesOut_ = true; }
    // What the chunk is meshed from, as it is now.
    mesh::MeshBlocks meshBlocks(world::ChunkPos pos) const { return meshBlocksOf(surroundings(pos).chunks); }
    const mesh::MeshOptions& meshOptions() const { return meshOptions_; }
    // Takes in what workers finished, puts edits on screen, gives out new work. Call each frame.
    // What a worker threw is thrown on from here.
    void update(Time now = std::chrono::steady_clock::now());
    // Blocks until a worker has finished something or the time is over.
    void waitForWorkers(std::chrono::milliseconds atMost);

    // The chunk, or null unless it is loaded; then it is loaded soon, and is kept for 5 s from each call.
    world::ChunkPtr maybeLoadChunkAt(world::ChunkPos pos);
    // Blocks until the chunk is loaded. `pos` is in the world.
    world::ChunkPtr chunkAt(world::ChunkPos pos);

    // Edits: as world::updateBlock(), World::setSmallData(), World::setLargeData(). False where nothing
    // changed. Light and mesh follow in the next update; the chunk is saved within kSaveAfter.
    bool setBlock(world::BlockPos pos, world::BlockId id);
    bool setSmallData(world::BlockPos pos, std::uint16_t value);
    bool setLargeData(world::BlockPos pos, world::LargeData data);
    static constexpr std::chrono::seconds kSaveAfter{2};
    // Hands all changed chunks to the store.
    void saveAll();

    // What changed on screen since the last call, at most `limit` chunks: those that edits changed, then the
    // others in the order in which they changed first.
    std::vector<ChunkChange> takeChanges(std::size_t limit);
    std::size_t waitingChanges() const { return changes_.size(); }

    // Hands out all that is on screen again, as to a renderer that forgot it.
    void showAgain();

    // None where the chunk is absent.
    std::optional<ChunkStage> stageAt(world::ChunkPos pos) const { return table_.stageAt(pos); }
    std::vector<TaskTime> taskTimes() const;
    std::size_t queuedCount() const { return table_.loadingCount() + table_.finishingCount(); }
    Progress progress() const { return {table_.wantedVisible(), table_.visibleInView()}; }
    // Of visible chunks' light, and of what chunks' own blocks give, kept until their neighbours are lit.
    std::size_t lightBytes() const;
    std::size_t localLightBytes() const;

  private:
    // What is kept of a chunk beside its blocks.
    struct Extra {
        base::JobHandle load;
        LocalLightPtr local;         // null once nobody needs it
        light::ChunkLightPtr light;  // of visible chunks
        std::optional<Time> editedAt;
    };

    void takeResults();
    void takeBatches();
    void onLoaded(world::ChunkPos pos, world::ChunkPtr chunk, LocalLightPtr local);
    std::size_t jobLimit() const;
    void submitLoads();
    void submitPrepare(world::ChunkPos pos, world::ChunkPtr chunk);
    void submitFinishes();
    void tidy();
    void save(world::ChunkPos pos, Extra& extra);
    void dropLocalsAround(world::ChunkPos pos);
    void giveUpLoads();

    void blockChanged(world::BlockPos pos, world::BlockId before);
    void dataChanged(world::BlockPos pos);
    template <class Work>
    auto guarded(Work work) const;
    Surroundings surroundings(world::ChunkPos pos) const;
    void applyEdits();
    bool relightIncrementally(const std::set<world::ChunkPos>& edited);
    void relightFromScratch(const std::set<world::ChunkPos>& edited);
    void setLight(world::ChunkPos pos, light::ChunkLightPtr light, std::uint16_t bricks = 0xFFFF);
    void setMesh(world::ChunkPos pos, MeshPtr mesh, mesh::RegionSet regions = mesh::kAllRegions);
    void askForMesh(world::ChunkPos pos);
    bool isMeshedElsewhere(world::ChunkPos pos, mesh::RegionSet regions) const;
    void meshFirst(world::ChunkPos pos, mesh::RegionSet regions);
    void remesh();
    ChunkChange& change(world::ChunkPos pos);

    PipelineParts parts_;
    mesh::MeshOptions meshOptions_;
    bool leavesMeshesOut_ = false;
    ChunkTable table_;
    std::shared_ptr<WorkerResults> results_;
    std::unordered_map<world::ChunkPos, Extra, world::ChunkPosHash> extras_;
    std::deque<world::ChunkPos> absent_;   // to be made by `batches`
    std::vector<light::BlockEdit> edits_;  // since the last update
    std::map<world::ChunkPos, mesh::RegionSet> toMesh_;
    std::set<world::ChunkPos> meshFirst_;  // of toMesh_: what edits touched
    Time now_{}, nextTidy_{};              // now: of the last update
    Time::duration sinceUpdate_{};         // between the last two updates

    // What was not taken yet, and the chunks in the order in which they first changed; what was taken first
    // still stands there.
    std::unordered_map<world::ChunkPos, ChunkChange, world::ChunkPosHash> changes_;
    std::deque<world::ChunkPos> changed_;
    std::set<world::ChunkPos> takeFirst_;  // of changes_: what edits changed
};

}  // namespace terrane::stream
