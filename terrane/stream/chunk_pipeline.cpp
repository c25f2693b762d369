#include "terrane/stream/chunk_pipeline.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <exception>

#include "terrane/base/profile.h"
#include "terrane/stream/neighbourhood.h"
#include "terrane/stream/worker_results.h"

namespace terrane::stream {

using world::ChunkPos;
using world::ChunkPtr;

namespace {

constexpr std::chrono::milliseconds kTidyEvery{250};

constexpr std::array kTaskNames = {"load or generate", "own light", "light", "mesh"};
static_assert(kTaskNames.size() == kTaskCount);

}  // namespace

ChunkPipeline::ChunkPipeline(const PipelineParts& parts)
    : parts_(parts), results_(std::make_shared<WorkerResults>()) {
    if (parts_.batches) parts_.source.generator = nullptr;
}

ChunkPipeline::~ChunkPipeline() {
    results_->isOver = true;
    parts_.jobs.waitIdle();
    saveAll();
}

void ChunkPipeline::setView(ChunkPos centre, int viewDistance, glm::vec2 direction) {
    if (!table_.setView(centre, viewDistance, direction)) return;
    for (const ChunkPos pos : table_.takeHidden()) {
        setLight(pos, nullptr);
        ChunkChange& hidden = change(pos);
        hidden.mesh = nullptr;
        hidden.regions = 0;
        hidden.needsMesh = false;
        hidden.light = nullptr;
        hidden.bricks = 0;
        hidden.isHidden = true;
    }
    giveUpLoads();
}

// Those that wait for a worker; a load that runs goes on.
void ChunkPipeline::giveUpLoads() {
    for (auto it = extras_.begin(); it != extras_.end();) {
        const ChunkPos pos = it->first;
        base::JobHandle& load = it->second.load;
        ++it;
        if (!load || !table_.mayGiveUpLoad(pos)) continue;
        load.cancel();
        if (load.state() != base::JobState::Cancelled) continue;
        extras_.erase(pos);
        table_.loadEnded(pos);
    }
}

void ChunkPipeline::setMeshOptions(const mesh::MeshOptions& options) {
    if (options == meshOptions_) return;
    meshOptions_ = options;
    for (auto& [pos, regions] : toMesh_) regions = mesh::kAllRegions;  // they were counted by another height
    for (const auto& [pos, extra] : extras_) {
        if (table_.is(pos, ChunkStage::Visible)) toMesh_[pos] = mesh::kAllRegions;
        table_.blocksChanged(pos);  // meshes on the way are old
    }
}

void ChunkPipeline::update(Time now) {
    TERRANE_ZONE("pipeline update");
    sinceUpdate_ = now - now_;
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
    std::vector<WorkerResults::Load> loads;
    std::vector<WorkerResults::Finish> finishes;
    std::exception_ptr failure;
    {
        const std::lock_guard lock(results_->mutex);
        loads.swap(results_->loads);
        finishes.swap(results_->finishes);
        failure = std::exchange(results_->failure, nullptr);
    }
    if (failure) std::rethrow_exception(failure);
    for (WorkerResults::Load& load : loads) {
        // A job that ran on although it was cancelled.
        if (!table_.is(load.pos, ChunkStage::Loading)) continue;
        if (load.chunk) {
            onLoaded(load.pos, std::move(load.chunk), std::move(load.local));
        } else {
            extras_[load.pos].load = {};  // from here on it cannot be cancelled
            absent_.push_back(load.pos);
        }
    }
    for (WorkerResults::Finish& done : finishes) {
        if (!table_.finished(done.pos)) continue;
        setLight(done.pos, done.light);
        if (done.mesh) {
            setMesh(done.pos, std::move(done.mesh));
        } else {
            askForMesh(done.pos);
        }
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
    results_->changed.wait_for(lock, atMost, [&] { return !results_->isEmpty(); });
}

// A chunk's own light is needed until it and its neighbours are lit.
void ChunkPipeline::dropLocalsAround(ChunkPos pos) {
    const auto isLit = [&](ChunkPos at) {
        return table_.is(at, ChunkStage::Visible) || !world::isInWorld(at);
    };
    for (const ChunkPos at : neighbourhood(pos)) {
        const auto extra = extras_.find(at);
        if (extra == extras_.end() || !extra->second.local) continue;
        const std::array<ChunkPos, 9> around = neighbourhood(at);
        if (std::all_of(around.begin(), around.end(), isLit)) extra->second.local = nullptr;
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
    parts_.source.store->save(pos, parts_.world.maybeChunkAt(pos), store::Provenance::Edited);
}

void ChunkPipeline::saveAll() {
    for (auto& [pos, extra] : extras_) save(pos, extra);
}

void ChunkPipeline::showAgain() {
    for (const auto& [pos, extra] : extras_) {
        if (!table_.is(pos, ChunkStage::Visible)) continue;
        setLight(pos, extra.light);
        toMesh_[pos] = mesh::kAllRegions;
    }
}

std::vector<TaskTime> ChunkPipeline::taskTimes() const {
    std::vector<TaskTime> times;
    for (std::size_t k = 0; k < kTaskCount; ++k) {
        times.push_back(
            {kTaskNames[k], results_->counts[k], static_cast<double>(results_->nanoseconds[k]) / 1000});
    }
    return times;
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
    const auto take = [&](ChunkPos pos) {
        if (auto node = changes_.extract(pos)) taken.push_back(std::move(node.mapped()));
    };
    for (; taken.size() < limit && !takeFirst_.empty(); takeFirst_.erase(takeFirst_.begin())) {
        take(*takeFirst_.begin());
    }
    for (; taken.size() < limit && !changed_.empty(); changed_.pop_front()) take(changed_.front());
    return taken;
}

std::size_t ChunkPipeline::localLightBytes() const {
    std::size_t bytes = 0;
    for (const auto& [pos, extra] : extras_) bytes += extra.local ? extra.local->memoryBytes() : 0;
    return bytes;
}

std::size_t ChunkPipeline::lightBytes() const {
    std::size_t bytes = 0;
    for (const auto& [pos, extra] : extras_) bytes += extra.light ? extra.light->memoryBytes() : 0;
    return bytes;
}

}  // namespace terrane::stream
