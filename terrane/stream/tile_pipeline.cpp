#include "terrane/stream/tile_pipeline.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <unordered_set>
#include <utility>

#include "terrane/base/profile.h"
#include "terrane/mesh/chunk_mesher.h"

namespace terrane::stream {

namespace {

using world::BlockId;
using world::BlockIndex;

// The layer above which all is air.
int topOf(const world::Chunk& tile) {
    int number = tile.heights().endSection();
    while (number > tile.heights().firstSection() &&
           tile.section(number - 1).isSame(world::Section(world::kAir)))
        --number;
    return number * world::kSectionSize;
}

struct Column {
    int surface = 0;  // its highest block
    int floor = 0;    // the highest block below the liquid; none: below the world
};

// Surface and floor of the liquid that is open to the sky; equal if there is none.
Column liquidAt(const world::Chunk& tile, const world::BlockRegistry& blocks, int x, int y, int top) {
    const auto block = [&](int z) { return tile.block(world::blockIndex(x, y, z)); };
    const int bottom = tile.heights().bottom;
    int z = top - 1;
    while (z >= bottom && block(z) == world::kAir) --z;
    Column column{z, z};
    if (z < bottom) return column;
    const BlockId highest = block(z);
    if (blocks.type(highest).shape != world::Shape::Liquid) return column;
    while (column.floor >= bottom && block(column.floor) == highest) --column.floor;
    return column;
}

}  // namespace

void raiseDeepFloor(world::Chunk& tile, const world::BlockRegistry& blocks) {
    const int top = topOf(tile);
    BlockId ground = world::kAir;  // of the first such column
    for (int y = 0; y < world::kChunkSize; ++y) {
        for (int x = 0; x < world::kChunkSize; ++x) {
            const Column column = liquidAt(tile, blocks, x, y, top);
            if (column.floor < tile.heights().bottom || column.surface - column.floor <= kMaxVisibleDepth)
                continue;
            const BlockId floor = tile.block(world::blockIndex(x, y, column.floor));
            if (!blocks.type(floor).opaqueCube) continue;
            if (ground == world::kAir) ground = floor;
            for (int z = column.floor; z <= column.surface - kMaxVisibleDepth; ++z)
                tile.setBlock(world::blockIndex(x, y, z), ground);
        }
    }
}

using world::ChunkPos;

namespace {

// Tiles are far away: few mesh sections are better than a fine cull.
constexpr int kMeshSectionHeight = mesh::kMaxMeshSectionHeight;
// Enough that no worker waits for the next frame: a tile takes about a third of a millisecond.
constexpr std::size_t kJobsPerWorker = 64;
// Tiles come after all chunks, but the coarsest ones before all: without them there is no land beyond the
// chunks.
constexpr base::JobPriority kFirst = -1, kAfterChunks = base::JobPriority{1} << 40;

world::Chunk tileBlocks(const TileParts& parts, ChunkPos pos) {
    if (parts.store) {
        if (store::LoadedChunk stored = parts.store->load(pos); stored.chunk) return std::move(*stored.chunk);
    }
    return parts.generators.generate(pos);
}

}  // namespace

// Filled by any thread; jobs share it, since they may end after the pipeline.
struct TilePipeline::Results {
    struct Made {
        std::uint64_t job = 0;
        TileMesh tile;
    };
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<Made> made;  // under the mutex
    // Under the mutex. A set: a server without a view never takes them, however often its tiles change.
    std::unordered_set<ChunkPos, world::ChunkPosHash> outdated;
    std::exception_ptr failure;        // the first, under the mutex
    std::atomic<bool> isOver = false;  // jobs that begin now do nothing

    std::size_t count = 0;    // of tiles made, under the mutex
    double microseconds = 0;  // that they took

    void add(Made result, double took) {
        const std::lock_guard lock(mutex);
        ++count;
        microseconds += took;
        made.push_back(std::move(result));
        changed.notify_one();
    }
    void fail(std::exception_ptr error) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::move(error);
        changed.notify_one();
    }
};

TileMesh makeTile(const TileParts& parts, ChunkPos pos, std::optional<mesh::MergeMethod> method) {
    TERRANE_ZONE("make tile");
    thread_local mesh::MeshScratch scratch;
    auto chunk = std::make_shared<world::Chunk>(tileBlocks(parts, pos));
    raiseDeepFloor(*chunk, parts.blocks);
    MeshPtr mesh;
    if (method)
        mesh = std::make_shared<const mesh::ChunkMesh>(
            mesh::meshTile(*chunk, parts.blocks, {*method, kMeshSectionHeight}, scratch));
    return {pos, std::move(mesh), std::move(chunk)};
}

TilePipeline::TilePipeline(const TileParts& parts) : parts_(parts), results_(std::make_shared<Results>()) {}

TilePipeline::~TilePipeline() {
    results_->isOver = true;
    parts_.jobs.waitIdle();
}

void TilePipeline::update(std::optional<mesh::MergeMethod> method) {
    takeResults();
    if (std::exchange(method_, method) != method) invalidateAllTiles(table_);
    const std::size_t limit = kJobsPerWorker * parts_.jobs.threadCount();
    for (const ChunkPos tile : popTileRequests(table_, limit - std::min(limit, jobs_.size()))) submit(tile);
}

void TilePipeline::takeResults() {
    const std::lock_guard lock(results_->mutex);
    if (results_->failure) std::rethrow_exception(results_->failure);
    for (Results::Made& made : results_->made) {
        if (jobs_.erase(made.job) > 0) finished_.push_back(std::move(made.tile));
    }
    results_->made.clear();
    for (const ChunkPos tile : results_->outdated) invalidateTile(table_, tile);
    results_->outdated.clear();
}

// The result for a tile that is no longer requested is not used when the tile is requested again: its blocks
// may have changed.
TileChanges TilePipeline::takeChanges() {
    TileChanges changes = updateTiles(table_);
    std::erase_if(jobs_, [&](const auto& entry) {
        const Job& job = entry.second;
        if (isTileLoading(table_, job.tile)) return false;
        job.handle.cancel();
        return true;
    });
    std::erase_if(finished_, [&](const TileMesh& mesh) { return !isTileLoading(table_, mesh.pos); });
    return changes;
}

void TilePipeline::submit(ChunkPos tile) {
    const base::JobPriority priority = tile.level == coarsestLevel(table_.view)
                                           ? kFirst
                                           : kAfterChunks + tileDistance(table_.view.center, tile);
    const std::uint64_t number = jobCount_++;
    const auto work = [tile, number, method = method_, parts = parts_, results = results_] {
        if (results->isOver) return;
        try {
            const auto start = std::chrono::steady_clock::now();
            TileMesh made = makeTile(parts, tile, method);
            const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
            results->add({number, std::move(made)}, took.count());
        } catch (...) {
            results->fail(std::current_exception());
        }
    };
    jobs_.emplace(number, Job{tile, parts_.jobs.submit(priority, work)});
}

TileListener TilePipeline::tileListener() const {
    return [results = results_](std::span<const ChunkPos> tiles) {
        const std::lock_guard lock(results->mutex);
        results->outdated.insert(tiles.begin(), tiles.end());
        results->changed.notify_one();
    };
}

void TilePipeline::waitForWorkers(std::chrono::milliseconds timeout) {
    if (parts_.jobs.runNextWithoutThreads()) return;
    std::unique_lock lock(results_->mutex);
    results_->changed.wait_for(lock, timeout, [&] {
        return !results_->made.empty() || !results_->outdated.empty() || results_->failure;
    });
}

std::vector<TileMesh> TilePipeline::takeMeshes(std::size_t limit) {
    std::vector<TileMesh> taken;
    while (taken.size() < limit && !finished_.empty()) {
        TileMesh mesh = std::move(finished_.back());
        finished_.pop_back();
        finishTile(table_, mesh.pos);
        taken.push_back(std::move(mesh));
    }
    return taken;
}

void TilePipeline::putBack(TileMesh mesh) {
    reopenTile(table_, mesh.pos);
    finished_.push_back(std::move(mesh));
}

TaskTime TilePipeline::taskTime() const {
    const std::lock_guard lock(results_->mutex);
    return {"tile", results_->count, results_->microseconds};
}

void TilePipeline::invalidateAll() {
    const TileView view = table_.view;
    table_ = {};
    setTileView(table_, view);
    for (const auto& [number, job] : jobs_) job.handle.cancel();
    jobs_.clear();
    finished_.clear();
}

}  // namespace terrane::stream
