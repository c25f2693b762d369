#include "terrane/stream/chunk_workers.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace terrane::stream {

using world::ChunkPos;

namespace {

constexpr std::array kTaskNames = {"load", "generate", "make deeper", "local light", "light", "mesh"};
static_assert(kTaskNames.size() == kTaskCount);

// Jobs in flight for each worker: enough that none waits for the next update, few enough that the queue
// follows the camera. A job takes about a millisecond (docs/performance.md), so one for each millisecond
// between updates.
constexpr std::int64_t kMinJobsPerWorker = 8, kMaxJobsPerWorker = 128;

}  // namespace

ChunkWorkers::ChunkWorkers(const PipelineParts& parts)
    : parts_(parts), results_(std::make_shared<WorkerResults>()) {}

ChunkWorkers::~ChunkWorkers() {
    results_->isOver = true;
    parts_.jobs.waitIdle();
}

// Exceptions of jobs are reported, so that nobody waits for a chunk that never comes: the pipeline's owner
// saves and ends.
template <class Work>
base::JobHandle ChunkWorkers::submit(base::JobPriority priority, Work work) {
    const auto guarded = [work = std::move(work), results = results_] {
        if (results->isOver) return;
        try {
            results->add(work(*results));
        } catch (...) {
            results->fail(std::current_exception());
        }
    };
    return parts_.jobs.submit(priority, guarded);
}

base::JobHandle ChunkWorkers::submitLoad(base::JobPriority priority, ChunkPos pos, const ChunkSource& source,
                                         int section, bool isToBeLit) {
    return submit(
        priority, [pos, source, section, isToBeLit, lights = &parts_.lights](WorkerResults& results) {
            ReadChunk read = results.timed(kLoad, [&] { return loadStored(source, pos, *lights); });
            if (!read)
                read = results.timed(kGenerate, [&] { return generateChunk(source, pos, section, *lights); });
            LocalLightPtr local;
            if (read && isToBeLit)
                local = results.timed(kLocalLight, [&] { return localLight(*read.chunk, *lights); });
            return WorkerResults::Load{pos, std::move(read), std::move(local)};
        });
}

void ChunkWorkers::submitDepth(base::JobPriority priority, const DepthJob& job, world::ChunkPtr chunk,
                               const ChunkSource& source) {
    submit(priority,
           [job, chunk = std::move(chunk), source, lights = &parts_.lights](WorkerResults& results) {
               const auto deepen = [&] {
                   const ReadChunk generated = generateTo(source, job.pos, job.section, *lights);
                   auto deeper = std::make_shared<world::Chunk>(*chunk);
                   deeper->makeDeeper(*generated.chunk);
                   // Edits may have opened what is generated.
                   return ReadChunk{deeper, light::lowestOpenSection(*deeper, *lights)};
               };
               ReadChunk deeper = results.timed(kDeepen, deepen);
               auto local = results.timed(kLocalLight, [&] { return localLight(*deeper.chunk, *lights); });
               return WorkerResults::Deepened{job, chunk, std::move(deeper), std::move(local)};
           });
}

void ChunkWorkers::submitLocalLight(base::JobPriority priority, ChunkPos pos,
                                    std::shared_ptr<world::Chunk> chunk) {
    submit(priority, [pos, chunk = std::move(chunk), lights = &parts_.lights](WorkerResults& results) {
        auto local = results.timed(kLocalLight, [&] { return localLight(*chunk, *lights); });
        return WorkerResults::Load{pos, {chunk, chunk->heights().endSection()}, std::move(local)};
    });
}

void ChunkWorkers::submitLighting(base::JobPriority priority, ChunkPos pos, ChunkNeighborhood around,
                                  const mesh::MeshOptions& options) {
    submit(priority,
           [pos, around = std::move(around), options, lights = &parts_.lights, blocks = &parts_.blocks,
            isMeshedHere = parts_.meshing == MeshPolicy::Workers](WorkerResults& results) {
               auto light = results.timed(kLight, [&] { return lightOf(around, *lights); });
               MeshPtr mesh;
               if (isMeshedHere)
                   mesh = results.timed(
                       kMesh, [&] { return meshOf(closeCaves(around, *light, *blocks), *blocks, options); });
               return WorkerResults::Lit{pos, std::move(light), std::move(mesh)};
           });
}

void ChunkWorkers::submitFirstMesh(base::JobPriority priority, ChunkPos pos, light::ChunkLightPtr light,
                                   const ChunkNeighborhood& around, const mesh::MeshOptions& options) {
    submit(priority,
           [pos, light = std::move(light), around, options, blocks = &parts_.blocks](WorkerResults& results) {
               auto mesh = results.timed(
                   kMesh, [&] { return meshOf(closeCaves(around, *light, *blocks), *blocks, options); });
               return WorkerResults::Lit{pos, light, std::move(mesh)};
           });
}

void ChunkWorkers::submitMesh(base::JobPriority priority, const MeshJob& job, light::ChunkLightPtr light,
                              const ChunkNeighborhood& around, const mesh::MeshOptions& options) {
    submit(priority,
           [job, light = std::move(light), around, options, blocks = &parts_.blocks](WorkerResults& results) {
               auto mesh = results.timed(
                   kMesh, [&] { return meshOf(closeCaves(around, *light, *blocks), *blocks, options); });
               return WorkerResults::Meshed{job, std::move(mesh)};
           });
}

WorkerResults::Lists ChunkWorkers::takeResults() {
    WorkerResults::Lists done = results_->takeAll();
    if (done.failure) std::rethrow_exception(done.failure);
    return done;
}

std::size_t ChunkWorkers::jobLimit(std::chrono::nanoseconds sinceUpdate) const {
    const auto passed = std::chrono::duration_cast<std::chrono::milliseconds>(sinceUpdate).count();
    const std::int64_t jobs = std::clamp<std::int64_t>(passed, kMinJobsPerWorker, kMaxJobsPerWorker);
    return static_cast<std::size_t>(jobs) * parts_.jobs.threadCount();
}

std::vector<TaskTime> ChunkWorkers::taskTimes() const {
    std::vector<TaskTime> times;
    for (std::size_t k = 0; k < kTaskCount; ++k) {
        const auto microseconds = static_cast<double>(results_->nanoseconds[k]) / 1000;
        times.push_back({kTaskNames[k], results_->counts[k], microseconds});
    }
    return times;
}

}  // namespace terrane::stream
