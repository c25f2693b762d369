#include "terrane/stream/chunk_pipeline.h"

#include <algorithm>
#include <cassert>
#include <exception>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"

namespace terrane::stream {

using world::ChunkPos;
using world::ChunkPtr;

namespace {

// Jobs in flight a worker: enough that none waits for a frame, few enough that the queue follows the camera.
constexpr std::size_t kJobsPerWorker = 8;
constexpr std::chrono::milliseconds kTidyEvery{250};

}  // namespace

// What workers leave for the pipeline's thread. Jobs hold it too, so that one that ends late finds it alive.
struct ChunkPipeline::Results {
    struct Load {
        ChunkPos pos;
        ChunkPtr chunk;  // null: to be made by a batch generator, or it failed
        LocalLightPtr local;
        bool failed = false;
    };
    struct Finish {
        ChunkPos pos;
        MeshPtr mesh;
        light::ChunkLightPtr light;
    };
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<Load> loads;
    std::vector<Finish> finishes;

    void add(Load load) {
        const std::lock_guard lock(mutex);
        loads.push_back(std::move(load));
        changed.notify_one();
    }
    void add(Finish finish) {
        const std::lock_guard lock(mutex);
        finishes.push_back(std::move(finish));
        changed.notify_one();
    }
};

ChunkPipeline::ChunkPipeline(const PipelineParts& parts)
    : parts_(parts), results_(std::make_shared<Results>()) {
    if (parts_.batches) parts_.source.generator = nullptr;
}

ChunkPipeline::~ChunkPipeline() {
    for (const auto& [pos, extra] : extras_) {
        if (extra.load) extra.load.cancel();
    }
    parts_.jobs.waitIdle();
    saveAll();
}

void ChunkPipeline::setView(ChunkPos centre, int viewDistance, glm::vec2 direction) {
    table_.setView(centre, viewDistance, direction);
    for (const ChunkPos pos : table_.takeHidden()) {
        setLight(pos, nullptr);
        ChunkChange& hidden = change(pos);
        hidden.mesh = nullptr;
        hidden.light = nullptr;
        hidden.bricks = 0;
        hidden.isHidden = true;
    }
    cancelDistantLoads();
}

// One ring outside of what is wanted a load goes on, so that a camera that paces a border does not cancel and
// ask again.
void ChunkPipeline::cancelDistantLoads() {
    for (auto it = extras_.begin(); it != extras_.end();) {
        const ChunkPos pos = it->first;
        base::JobHandle& load = it->second.load;
        ++it;
        if (!load || table_.isWanted(pos)) continue;
        load.cancel();
        if (load.state() != base::JobState::Cancelled) continue;
        extras_.erase(pos);
        table_.loadEnded(pos);
    }
}

void ChunkPipeline::setMeshOptions(const mesh::MeshOptions& options) {
    if (options == meshOptions_) return;
    meshOptions_ = options;
    for (const auto& [pos, extra] : extras_) {
        if (table_.is(pos, ChunkStage::Visible)) toMesh_.insert(pos);
        table_.blocksChanged(pos);  // meshes on the way are old
    }
}

void ChunkPipeline::update(Time now) {
    TERRANE_ZONE("pipeline update");
    now_ = now;
    takeResults();
    if (parts_.batches) takeBatches();
    applyEdits();
    remesh();
    if (now >= nextTidy_) tidy();
    submitLoads();
    submitFinishes();
}

void ChunkPipeline::takeResults() {
    std::vector<Results::Load> loads;
    std::vector<Results::Finish> finishes;
    {
        const std::lock_guard lock(results_->mutex);
        loads.swap(results_->loads);
        finishes.swap(results_->finishes);
    }
    for (Results::Load& load : loads) {
        // A job that ran on although it was cancelled.
        if (!table_.is(load.pos, ChunkStage::Loading)) continue;
        if (load.chunk) {
            onLoaded(load.pos, std::move(load.chunk), std::move(load.local));
        } else if (load.failed) {
            extras_.erase(load.pos);
            table_.loadEnded(load.pos);
        } else {
            extras_[load.pos].load = {};  // from here on it cannot be cancelled
            absent_.push_back(load.pos);
        }
    }
    for (Results::Finish& done : finishes) {
        if (!table_.finished(done.pos)) continue;
        setLight(done.pos, done.light);
        change(done.pos).mesh = std::move(done.mesh);
        dropLocalsAround(done.pos);
    }
}

void ChunkPipeline::onLoaded(ChunkPos pos, ChunkPtr chunk, LocalLightPtr local) {
    Extra& extra = extras_[pos];
    extra.load = {};
    extra.local = std::move(local);
    parts_.world.insert(pos, std::move(chunk));
    table_.loaded(pos, now_);
}

void ChunkPipeline::waitForWorkers(std::chrono::milliseconds atMost) {
    std::unique_lock lock(results_->mutex);
    results_->changed.wait_for(lock, atMost,
                               [&] { return !results_->loads.empty() || !results_->finishes.empty(); });
}

void ChunkPipeline::submitLoads() {
    const std::size_t limit = kJobsPerWorker * parts_.jobs.threadCount();
    const std::size_t room = limit - std::min(limit, table_.loadingCount() - absent_.size());
    for (const ChunkPos pos : table_.takeLoads(room)) {
        const auto work = [pos, source = parts_.source, lights = &parts_.lights,
                           results = results_](const base::CancelToken&) {
            try {
                ChunkPtr chunk = loadChunk(source, pos);
                LocalLightPtr local = chunk ? localLight(*chunk, *lights) : nullptr;
                results->add(Results::Load{pos, std::move(chunk), std::move(local)});
            } catch (const std::exception& e) {
                base::logError("chunk {},{}: {}", pos.x, pos.y, e.what());
                results->add(Results::Load{pos, nullptr, nullptr, true});
            }
        };
        extras_[pos].load = parts_.jobs.submit(table_.urgency(pos), work);
    }
}

void ChunkPipeline::takeBatches() {
    while (!absent_.empty()) {
        const std::vector<ChunkPos> wanted(absent_.begin(), absent_.end());
        const std::size_t taken = parts_.batches->submit(wanted);
        if (taken == 0) break;
        absent_.erase(absent_.begin(), absent_.begin() + static_cast<long>(taken));
    }
    for (auto& [pos, chunk] : parts_.batches->take()) {
        submitPrepare(pos, std::make_shared<world::Chunk>(std::move(chunk)));
    }
}

// A generated chunk's own light.
void ChunkPipeline::submitPrepare(ChunkPos pos, ChunkPtr chunk) {
    parts_.jobs.submit(table_.urgency(pos), [pos, chunk = std::move(chunk), lights = &parts_.lights,
                                             results = results_](const base::CancelToken&) {
        results->add(Results::Load{pos, chunk, localLight(*chunk, *lights)});
    });
}

Surroundings ChunkPipeline::surroundings(ChunkPos pos) const {
    Surroundings around;
    for (int n = 0; n < 9; ++n) {
        const ChunkPos at{pos.x + n % 3 - 1, pos.y + n / 3 - 1};
        const auto k = static_cast<std::size_t>(n);
        around.chunks[k] = parts_.world.maybeChunkAt(at);
        const auto extra = extras_.find(at);
        if (extra != extras_.end()) around.locals[k] = extra->second.local;
    }
    return around;
}

void ChunkPipeline::submitFinishes() {
    const std::size_t limit = kJobsPerWorker * parts_.jobs.threadCount();
    const std::size_t room = limit - std::min(limit, table_.finishingCount());
    for (const ChunkPos pos : table_.takeFinishes(room)) {
        // Before loads of equal urgency: what is on screen frees memory.
        parts_.jobs.submit(table_.urgency(pos) - 1, [pos, around = surroundings(pos), lights = &parts_.lights,
                                                     blocks = &parts_.blocks, options = meshOptions_,
                                                     results = results_](const base::CancelToken&) {
            light::ChunkLightPtr light = lightOf(around, *lights);
            results->add(Results::Finish{pos, meshOf(around.chunks, *blocks, options), std::move(light)});
        });
    }
}

// A chunk's own light is needed until it and its neighbours are lit.
void ChunkPipeline::dropLocalsAround(ChunkPos pos) {
    const auto isLit = [&](ChunkPos at) {
        return table_.is(at, ChunkStage::Visible) || !world::isInWorld(at);
    };
    for (int n = 0; n < 9; ++n) {
        const ChunkPos at{pos.x + n % 3 - 1, pos.y + n / 3 - 1};
        const auto extra = extras_.find(at);
        if (extra == extras_.end() || !extra->second.local) continue;
        bool isNeeded = false;
        for (int m = 0; m < 9 && !isNeeded; ++m) isNeeded = !isLit({at.x + m % 3 - 1, at.y + m / 3 - 1});
        if (!isNeeded) extra->second.local = nullptr;
    }
}

// What need not be done every frame: saving what was edited some time ago, unloading what nobody asks for.
void ChunkPipeline::tidy() {
    nextTidy_ = now_ + kTidyEvery;
    for (auto& [pos, extra] : extras_) {
        if (extra.editedAt && now_ - *extra.editedAt >= kSaveAfter) save(pos, extra);
    }
    for (const ChunkPos pos : table_.takeUnloads(now_)) {
        save(pos, extras_[pos]);
        extras_.erase(pos);
        parts_.world.erase(pos);
    }
}

void ChunkPipeline::save(ChunkPos pos, Extra& extra) {
    if (!extra.editedAt) return;
    extra.editedAt.reset();
    if (!parts_.source.store) return;
    parts_.source.store->save(pos, parts_.world.maybeChunkAt(pos), store::Origin::Edited);
}

void ChunkPipeline::saveAll() {
    for (auto& [pos, extra] : extras_) save(pos, extra);
}

ChunkPtr ChunkPipeline::maybeLoadChunkAt(ChunkPos pos) {
    table_.request(pos, now_);
    return parts_.world.maybeChunkAt(pos);
}

ChunkPtr ChunkPipeline::chunkAt(ChunkPos pos) {
    for (;;) {
        if (ChunkPtr chunk = maybeLoadChunkAt(pos)) return chunk;
        update(now_);
        waitForWorkers(std::chrono::milliseconds(10));
    }
}

ChunkChange& ChunkPipeline::change(ChunkPos pos) {
    const auto [it, isNew] = changes_.try_emplace(pos);
    it->second.pos = pos;
    it->second.isHidden = false;
    if (isNew) changed_.push_back(pos);
    return it->second;
}

std::vector<ChunkChange> ChunkPipeline::takeChanges(std::size_t limit) {
    std::vector<ChunkChange> taken;
    for (; taken.size() < limit && !changed_.empty(); changed_.pop_front()) {
        taken.push_back(std::move(changes_.extract(changed_.front()).mapped()));
    }
    return taken;
}

std::size_t ChunkPipeline::lightBytes() const {
    std::size_t bytes = 0;
    for (const auto& [pos, extra] : extras_) bytes += extra.light ? extra.light->memoryBytes() : 0;
    return bytes;
}

}  // namespace terrane::stream
