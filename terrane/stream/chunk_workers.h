// Runs the pipeline's work on workers: each submit function makes one job, and takeResults() returns the
// results. Workers see only immutable snapshots. It is used on the pipeline's thread.
#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/stream/pipeline_types.h"
#include "terrane/stream/worker_results.h"

namespace terrane::stream {

class ChunkWorkers {
  public:
    // The parts outlive this.
    explicit ChunkWorkers(const PipelineParts& parts);
    ~ChunkWorkers();  // waits for all running jobs; its waiting ones do nothing

    // Loads or generates a chunk, at least down to a section (chunk_jobs.h), and computes its local light if
    // it is to be lit. Without a generator, the result is null if the store has no chunk.
    base::JobHandle submitLoad(base::JobPriority priority, world::ChunkPos pos, const ChunkSource& source,
                               int section, bool isToBeLit);
    // Makes a copy of a chunk that is deeper, and its local light.
    void submitDepth(base::JobPriority priority, const DepthJob& job, world::ChunkPtr chunk,
                     const ChunkSource& source);
    // Computes the local light of a chunk that a batch generator made.
    void submitLocalLight(base::JobPriority priority, world::ChunkPos pos,
                          std::shared_ptr<world::Chunk> chunk);
    // Lights the chunk, and meshes it if workers make meshes.
    void submitLighting(base::JobPriority priority, world::ChunkPos pos, ChunkNeighborhood around,
                        const mesh::MeshOptions& options);
    // Meshes a chunk that a batch lighter lit.
    void submitFirstMesh(base::JobPriority priority, world::ChunkPos pos, light::ChunkLightPtr light,
                         const ChunkNeighborhood& around, const mesh::MeshOptions& options);
    // Meshes a visible chunk again.
    void submitMesh(base::JobPriority priority, const MeshJob& job, light::ChunkLightPtr light,
                    const ChunkNeighborhood& around, const mesh::MeshOptions& options);

    // Removes and returns the results. It rethrows exceptions of jobs, nearly always for lack of memory.
    WorkerResults::Lists takeResults();
    // Blocks until there is a result or the time is over. Runs a job if there are no threads.
    void waitForAny(std::chrono::milliseconds timeout) {
        if (!parts_.jobs.runNextWithoutThreads()) results_->waitForAny(timeout);
    }

    // Returns the number of jobs of a kind that may be in flight, more if updates are rare.
    std::size_t jobLimit(std::chrono::nanoseconds sinceUpdate) const;
    std::vector<TaskTime> taskTimes() const;

  private:
    template <class Work>
    base::JobHandle submit(base::JobPriority priority, Work work);

    const PipelineParts& parts_;
    std::shared_ptr<WorkerResults> results_;
};

}  // namespace terrane::stream
