// Which work the pipeline gives to workers and to a batch generator.
#include <algorithm>
#include <array>
#include <exception>

#include "terrane/stream/chunk_pipeline.h"
#include "terrane/stream/neighbourhood.h"
#include "terrane/stream/worker_results.h"

namespace terrane::stream {

using world::ChunkPos;
using world::ChunkPtr;

namespace {

// Jobs in flight a worker: enough that none waits for the next update, few enough that the queue follows the
// camera. A job takes about a millisecond (docs/performance.md), so one for each that passes between updates.
constexpr std::int64_t kLeastJobsPerWorker = 8, kMostJobsPerWorker = 128;

}  // namespace

std::size_t ChunkPipeline::jobLimit() const {
    const auto passed = std::chrono::duration_cast<std::chrono::milliseconds>(sinceUpdate_).count();
    const std::int64_t jobs = std::clamp<std::int64_t>(passed, kLeastJobsPerWorker, kMostJobsPerWorker);
    return static_cast<std::size_t>(jobs) * parts_.jobs.threadCount();
}

// Work that reports what it throws: as good as always that memory is short. The owner of the pipeline hears
// of it, saves and ends; nobody waits for a chunk that does not come.
template <class Work>
auto ChunkPipeline::guarded(Work work) const {
    return [work = std::move(work), results = results_](const base::CancelToken&) {
        if (results->isOver) return;
        try {
            work(*results);
        } catch (...) {
            results->fail(std::current_exception());
        }
    };
}

void ChunkPipeline::submitLoads() {
    const std::size_t limit = jobLimit();
    const std::size_t room = limit - std::min(limit, table_.loadingCount() - absent_.size());
    for (const ChunkPos pos : table_.takeLoads(room)) {
        extras_[pos].load = parts_.jobs.submit(
            table_.urgency(pos),
            guarded([pos, source = parts_.source, lights = &parts_.lights](WorkerResults& results) {
                ChunkPtr chunk = results.timed(kLoad, [&] { return loadChunk(source, pos); });
                LocalLightPtr local;
                if (chunk) local = results.timed(kOwnLight, [&] { return localLight(*chunk, *lights); });
                results.add(WorkerResults::Load{pos, std::move(chunk), std::move(local)});
            }));
    }
}

void ChunkPipeline::takeBatches() {
    while (!absent_.empty()) {
        const std::vector<ChunkPos> wanted(absent_.begin(), absent_.end());
        const std::size_t taken = parts_.batches->submit(wanted);
        if (taken == 0) break;
        absent_.erase(absent_.begin(), absent_.begin() + static_cast<long>(taken));
    }
    for (auto& [pos, chunk] : parts_.batches->take(false)) submitPrepare(pos, std::move(chunk));
}

// A generated chunk's own light.
void ChunkPipeline::submitPrepare(ChunkPos pos, ChunkPtr chunk) {
    parts_.jobs.submit(
        table_.urgency(pos),
        guarded([pos, chunk = std::move(chunk), lights = &parts_.lights](WorkerResults& results) {
            LocalLightPtr local = results.timed(kOwnLight, [&] { return localLight(*chunk, *lights); });
            results.add(WorkerResults::Load{pos, chunk, std::move(local)});
        }));
}

Surroundings ChunkPipeline::surroundings(ChunkPos pos) const {
    Surroundings around;
    const std::array<ChunkPos, 9> positions = neighbourhood(pos);
    for (std::size_t n = 0; n < positions.size(); ++n) {
        around.chunks[n] = parts_.world.maybeChunkAt(positions[n]);
        const auto extra = extras_.find(positions[n]);
        if (extra != extras_.end()) around.locals[n] = extra->second.local;
    }
    return around;
}

void ChunkPipeline::submitFinishes() {
    const std::size_t limit = jobLimit();
    const std::size_t room = limit - std::min(limit, table_.finishingCount());
    for (const ChunkPos pos : table_.takeFinishes(room)) {
        // Before loads of equal urgency: what is on screen frees memory.
        parts_.jobs.submit(
            table_.urgency(pos) - 1,
            guarded([pos, around = surroundings(pos), lights = &parts_.lights, blocks = &parts_.blocks,
                     options = meshOptions_, meshes = !leavesMeshesOut_](WorkerResults& results) {
                auto light = results.timed(kLight, [&] { return lightOf(around, *lights); });
                MeshPtr mesh;
                if (meshes) {
                    mesh = results.timed(kMesh, [&] { return meshOf(around.chunks, *blocks, options); });
                }
                results.add(WorkerResults::Finish{pos, std::move(mesh), std::move(light)});
            }));
    }
}

}  // namespace terrane::stream
