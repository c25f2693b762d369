#include "terrane/stream/tile_pipeline.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <utility>

#include "terrane/base/profile.h"
#include "terrane/mesh/chunk_mesher.h"

namespace terrane::stream {

using world::ChunkPos;

namespace {

// A tile is seen from afar: few mesh sections are better than a fine cull.
constexpr int kMeshSectionHeight = world::kChunkHeight / 2;
// Enough that no worker waits for the next frame: a tile takes about a third of a millisecond.
constexpr std::size_t kJobsPerWorker = 64;
// After all chunks. The coarsest tiles come before all: without them there is nothing out there.
constexpr base::JobPriority kFirst = -1, kAfterChunks = base::JobPriority{1} << 40;

}  // namespace

// Filled by any thread; jobs hold it too, so that one that ends late finds it alive.
struct TilePipeline::Results {
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<TileMesh> meshes;      // under the mutex
    std::exception_ptr failure;        // the first, under the mutex
    std::atomic<bool> isOver = false;  // jobs that begin now do nothing

    std::size_t count = 0;    // of tiles made, under the mutex
    double microseconds = 0;  // that they took

    void add(TileMesh mesh, double took) {
        const std::lock_guard lock(mutex);
        ++count;
        microseconds += took;
        meshes.push_back(std::move(mesh));
        changed.notify_one();
    }
    void fail(std::exception_ptr error) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::move(error);
        changed.notify_one();
    }
};

MeshPtr makeTile(const TileParts& parts, ChunkPos pos, mesh::MergeMethod method) {
    TERRANE_ZONE("make tile");
    thread_local mesh::MeshScratch scratch;
    const world::Chunk chunk = parts.generators.generate(pos);
    return std::make_shared<const mesh::ChunkMesh>(
        mesh::meshTile(chunk, parts.blocks, {method, kMeshSectionHeight}, scratch));
}

TilePipeline::TilePipeline(const TileParts& parts) : parts_(parts), results_(std::make_shared<Results>()) {}

TilePipeline::~TilePipeline() {
    results_->isOver = true;
    parts_.jobs.waitIdle();
}

void TilePipeline::update(mesh::MergeMethod method) {
    {
        const std::lock_guard lock(results_->mutex);
        if (results_->failure) std::rethrow_exception(results_->failure);
        running_ -= results_->meshes.size();
        for (TileMesh& mesh : results_->meshes) finished_.push_back(std::move(mesh));
        results_->meshes.clear();
    }
    const std::size_t limit = kJobsPerWorker * parts_.jobs.threadCount();
    const int coarsest = coarsestLevel(table_.view);
    for (const ChunkPos pos : popTileRequests(table_, limit - std::min(limit, running_))) {
        ++running_;
        const base::JobPriority priority =
            pos.level == coarsest ? kFirst : kAfterChunks + tileDistance(table_.view.center, pos);
        parts_.jobs.submit(priority, [pos, method, parts = parts_, results = results_](const auto&) {
            if (results->isOver) return;
            try {
                const auto start = std::chrono::steady_clock::now();
                MeshPtr mesh = makeTile(parts, pos, method);
                const std::chrono::duration<double, std::micro> took =
                    std::chrono::steady_clock::now() - start;
                results->add({pos, std::move(mesh)}, took.count());
            } catch (...) {
                results->fail(std::current_exception());
            }
        });
    }
}

void TilePipeline::waitForWorkers(std::chrono::milliseconds atMost) {
    std::unique_lock lock(results_->mutex);
    results_->changed.wait_for(lock, atMost, [&] { return !results_->meshes.empty() || results_->failure; });
}

std::vector<TileMesh> TilePipeline::takeMeshes(std::size_t limit) {
    std::vector<TileMesh> taken;
    while (taken.size() < limit && !finished_.empty()) {
        TileMesh mesh = std::move(finished_.back());
        finished_.pop_back();
        if (!isAwaited(table_, mesh.pos)) continue;  // the view moved on
        finishTile(table_, mesh.pos);
        taken.push_back(std::move(mesh));
    }
    return taken;
}

TaskTime TilePipeline::taskTime() const {
    const std::lock_guard lock(results_->mutex);
    return {"tile", results_->count, results_->microseconds};
}

void TilePipeline::forgetAll() {
    const TileView view = table_.view;
    table_ = {};
    setTileView(table_, view);
    finished_.clear();
}

}  // namespace terrane::stream
