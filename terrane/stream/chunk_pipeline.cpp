#include "terrane/stream/chunk_pipeline.h"

#include <algorithm>
#include <cassert>

#include "terrane/base/profile.h"

namespace terrane::stream {
namespace {

using world::ChunkPos;
using world::ChunkPtr;

// Jobs in flight a worker: enough that none waits for a frame, few enough that the queue follows the camera.
constexpr std::size_t kJobsPerWorker = 8;

ChunkPos offsetBy(ChunkPos pos, int dx, int dy) {
    return {pos.x + dx, pos.y + dy};
}

std::int64_t squaredDistance(ChunkPos a, ChunkPos b) {
    const std::int64_t dx = std::int64_t{a.x} - b.x, dy = std::int64_t{a.y} - b.y;
    return dx * dx + dy * dy;
}

}  // namespace

// What workers leave for the pipeline's thread. Jobs hold it too, so that one that ends late finds it alive.
struct ChunkPipeline::Results {
    struct Mesh {
        ChunkPos pos;
        std::uint64_t number;
        std::shared_ptr<const mesh::ChunkMesh> mesh;
    };
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<std::pair<ChunkPos, ChunkPtr>> chunks;
    std::vector<Mesh> meshes;
};

ChunkPipeline::ChunkPipeline(base::JobSystem& jobs, const gen::Generator& generator,
                             const world::BlockRegistry& blocks, world::World& world)
    : jobs_(jobs),
      generator_(generator),
      blocks_(blocks),
      world_(world),
      results_(std::make_shared<Results>()),
      outside_(std::make_shared<world::Chunk>()) {}

ChunkPipeline::~ChunkPipeline() {
    for (const auto& [pos, job] : generating_) job.cancel();
    jobs_.waitIdle();
}

void ChunkPipeline::setView(ChunkPos centre, int viewDistance) {
    assert(viewDistance >= 0 && "a view shows at least the camera's chunk");
    if (centre == centre_ && viewDistance == viewDistance_) return;
    const bool newDistance = viewDistance != viewDistance_;
    centre_ = centre;
    viewDistance_ = viewDistance;
    if (newDistance) orderOffsets();
    nextOffset_ = 0;
    unloadDistant();
    for (const ChunkPos offset : offsets_) {
        const ChunkPos pos = offsetBy(centre_, offset.x, offset.y);
        if (isReadyToMesh(pos)) submitMesh(pos);
    }
}

void ChunkPipeline::setMeshOptions(const mesh::MeshOptions& options) {
    if (options == meshOptions_) return;
    meshOptions_ = options;
    for (const auto& asked : meshAsked_) submitMesh(asked.first);  // adds no entry
}

void ChunkPipeline::orderOffsets() {
    offsets_.clear();
    const int reach = viewDistance_ + 1;
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) offsets_.push_back({x, y});
    }
    std::stable_sort(offsets_.begin(), offsets_.end(),
                     [](ChunkPos a, ChunkPos b) { return squaredDistance(a, {}) < squaredDistance(b, {}); });
}

base::JobPriority ChunkPipeline::priority(ChunkPos pos) const {
    return squaredDistance(pos, centre_);
}

void ChunkPipeline::update() {
    TERRANE_ZONE("pipeline update");
    std::vector<std::pair<ChunkPos, ChunkPtr>> chunks;
    std::vector<Results::Mesh> meshes;
    {
        const std::lock_guard lock(results_->mutex);
        chunks.swap(results_->chunks);
        meshes.swap(results_->meshes);
    }
    for (auto& [pos, chunk] : chunks) onGenerated(pos, std::move(chunk));
    for (Results::Mesh& result : meshes) {
        const auto asked = meshAsked_.find(result.pos);
        if (asked == meshAsked_.end() || asked->second != result.number) continue;
        visible_.insert(result.pos);
        addChange(result.pos, std::move(result.mesh));
    }
    submitGeneration();
}

void ChunkPipeline::waitForWorkers(std::chrono::milliseconds atMost) {
    std::unique_lock lock(results_->mutex);
    results_->changed.wait_for(lock, atMost,
                               [&] { return !results_->chunks.empty() || !results_->meshes.empty(); });
}

void ChunkPipeline::submitGeneration() {
    const std::size_t limit = kJobsPerWorker * jobs_.threadCount();
    while (nextOffset_ < offsets_.size() && generating_.size() < limit) {
        const ChunkPos pos = offsetBy(centre_, offsets_[nextOffset_].x, offsets_[nextOffset_].y);
        ++nextOffset_;
        if (!world::isInWorld(pos) || world_.maybeChunkAt(pos) || generating_.contains(pos)) continue;
        generating_[pos] =
            jobs_.submit(priority(pos), [this, pos, results = results_](const base::CancelToken&) {
                auto chunk = std::make_shared<world::Chunk>(generator_.generate(pos));
                const std::lock_guard lock(results->mutex);
                results->chunks.emplace_back(pos, std::move(chunk));
                results->changed.notify_one();
            });
    }
}

void ChunkPipeline::onGenerated(ChunkPos pos, ChunkPtr chunk) {
    generating_.erase(pos);
    if (world::chunkDistance(pos, centre_) > viewDistance_ + 2) return;
    world_.insert(pos, std::move(chunk));
    meshWhereReady(pos);
}

void ChunkPipeline::meshWhereReady(ChunkPos around) {
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const ChunkPos pos = offsetBy(around, dx, dy);
            if (isReadyToMesh(pos)) submitMesh(pos);
        }
    }
}

ChunkPtr ChunkPipeline::chunkOrOutside(ChunkPos pos) const {
    return world::isInWorld(pos) ? world_.maybeChunkAt(pos) : outside_;
}

bool ChunkPipeline::isReadyToMesh(ChunkPos pos) const {
    if (!world::isInWorld(pos) || world::chunkDistance(pos, centre_) > viewDistance_) return false;
    if (meshAsked_.contains(pos)) return false;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            if (!chunkOrOutside(offsetBy(pos, dx, dy))) return false;
        }
    }
    return true;
}

void ChunkPipeline::submitMesh(ChunkPos pos) {
    const std::uint64_t number = ++meshNumber_;
    meshAsked_[pos] = number;
    const std::array<ChunkPtr, 5> chunks = {
        chunkOrOutside(pos), chunkOrOutside(offsetBy(pos, -1, 0)), chunkOrOutside(offsetBy(pos, 1, 0)),
        chunkOrOutside(offsetBy(pos, 0, -1)), chunkOrOutside(offsetBy(pos, 0, 1))};
    jobs_.submit(priority(pos), [chunks, number, pos, blocks = &blocks_, options = meshOptions_,
                                 results = results_](const base::CancelToken&) {
        TERRANE_ZONE("mesh chunk");
        mesh::MeshInput input;
        input.centre = chunks[0].get();
        input.neighbours = {chunks[1].get(), chunks[2].get(), chunks[3].get(), chunks[4].get()};
        input.blocks = blocks;
        input.options = options;
        thread_local mesh::MeshScratch scratch;
        auto mesh = std::make_shared<const mesh::ChunkMesh>(mesh::meshChunk(input, scratch));
        const std::lock_guard lock(results->mutex);
        results->meshes.push_back({pos, number, std::move(mesh)});
        results->changed.notify_one();
    });
}

void ChunkPipeline::blocksChanged(world::BlockPos pos) {
    const auto again = [&](ChunkPos chunk) {
        if (!meshAsked_.contains(chunk)) return;  // not meshed yet: it will be, with the new blocks
        submitMesh(chunk);
    };
    const ChunkPos chunk = world::chunkOf(pos);
    again(chunk);
    const int x = pos.x & 15, y = pos.y & 15;
    if (x == 0) again(offsetBy(chunk, -1, 0));
    if (x == 15) again(offsetBy(chunk, 1, 0));
    if (y == 0) again(offsetBy(chunk, 0, -1));
    if (y == 15) again(offsetBy(chunk, 0, 1));
}

// A chunk stays one ring longer than it is wanted, so that a camera that paces a border does not load it each
// time.
void ChunkPipeline::unloadDistant() {
    std::vector<ChunkPos> distant;
    for (const auto& [pos, chunk] : world_.chunks()) {
        if (world::chunkDistance(pos, centre_) > viewDistance_ + 2) distant.push_back(pos);
    }
    for (const ChunkPos pos : distant) world_.erase(pos);
    for (auto it = generating_.begin(); it != generating_.end();) {
        const bool isDistant = world::chunkDistance(it->first, centre_) > viewDistance_ + 2;
        if (isDistant) it->second.cancel();
        const base::JobState state = it->second.state();
        it = isDistant && state == base::JobState::Cancelled ? generating_.erase(it) : std::next(it);
    }
    for (auto it = meshAsked_.begin(); it != meshAsked_.end();) {
        if (world::chunkDistance(it->first, centre_) <= viewDistance_) {
            ++it;
            continue;
        }
        if (visible_.erase(it->first) > 0) addChange(it->first, nullptr);
        it = meshAsked_.erase(it);
    }
}

void ChunkPipeline::addChange(ChunkPos pos, std::shared_ptr<const mesh::ChunkMesh> mesh) {
    if (changes_.insert_or_assign(pos, std::move(mesh)).second) changed_.push_back(pos);
}

std::vector<MeshChange> ChunkPipeline::takeMeshes(std::size_t limit) {
    std::vector<MeshChange> taken;
    for (; taken.size() < limit && !changed_.empty(); changed_.pop_front()) {
        auto change = changes_.extract(changed_.front());
        taken.push_back({change.key(), std::move(change.mapped())});
    }
    return taken;
}

Progress ChunkPipeline::progress() const {
    Progress progress;
    for (const ChunkPos offset : offsets_) {
        const ChunkPos pos = offsetBy(centre_, offset.x, offset.y);
        if (world::isInWorld(pos) && world::chunkDistance(pos, centre_) <= viewDistance_) ++progress.wanted;
    }
    progress.visible = visible_.size();
    return progress;
}

}  // namespace terrane::stream
