#include "terrane/mesh_gpu/mesh_queue.h"

#include <algorithm>

#include "terrane/base/profile.h"
#include "terrane/base/result.h"

namespace terrane::mesh_gpu {
namespace {

constexpr std::size_t kFirstBatch = 8;  // chunks; later batches depend on the time taken

double millisecondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Returns the addresses in one arena as offsets in it, kNoPlace for the others, and whether there are any.
std::pair<std::vector<std::uint32_t>, bool> offsetsIn(std::span<const std::uint32_t> addresses,
                                                      std::uint32_t arena, std::uint32_t arenaSize) {
    std::vector<std::uint32_t> offsets(addresses.size(), kNoPlace);
    bool isAny = false;
    for (std::size_t k = 0; k < addresses.size(); ++k) {
        if (addresses[k] == kNoPlace || addresses[k] / arenaSize != arena) continue;
        offsets[k] = addresses[k] % arenaSize;
        isAny = true;
    }
    return {std::move(offsets), isAny};
}

}  // namespace

MeshQueue::MeshQueue(GpuMesher mesher, double budgetMilliseconds)
    : mesher_(std::move(mesher)),
      budgetMilliseconds_(budgetMilliseconds),
      batchSize_(budgetMilliseconds > 0 ? kFirstBatch : GpuMesher::kMaxChunks) {}

void MeshQueue::add(world::ChunkPos pos) {
    if (isWaiting_.insert(pos).second) waiting_.push_back(pos);
}

void MeshQueue::remove(world::ChunkPos pos) {
    isWaiting_.erase(pos);
    if (isInFlight(pos)) isRemoved_.insert(pos);
}

bool MeshQueue::isInFlight(world::ChunkPos pos) const {
    return std::ranges::find(counting_, pos) != counting_.end() && !isRemoved_.contains(pos);
}

std::vector<world::ChunkPos> MeshQueue::takeWaiting() {
    if (!counting_.empty()) return {};
    start_ = Clock::now();
    for (; !waiting_.empty() && counting_.size() < batchSize_; waiting_.pop_front()) {
        if (isWaiting_.erase(waiting_.front()) > 0) counting_.push_back(waiting_.front());
    }
    return counting_;
}

void MeshQueue::count(std::span<const mesh::MeshInput> chunks) {
    TERRANE_ZONE("mesh queue: count");
    base::require(chunks.size() == counting_.size(),
                  "MeshQueue::count: the chunks are those of takeWaiting()");
    mesher_.count(chunks);
    countMilliseconds_ = millisecondsSince(start_);
}

std::vector<CountedChunk> MeshQueue::takeCounted() {
    base::require(isCounted(), "MeshQueue::takeCounted: no batch is counted");
    start_ = Clock::now();
    meshSections_ = mesher_.meshSections();
    std::vector<CountedChunk> counted;
    for (std::size_t k = 0; k < counting_.size(); ++k) {
        if (isRemoved_.contains(counting_[k])) continue;
        counted.push_back({counting_[k], meshSections_.ofChunk(k)});
    }
    return counted;
}

void MeshQueue::write(std::span<const FirstQuads> places, const gpu::ArenaBuffers& quads) {
    TERRANE_ZONE("mesh queue: write");
    base::require(!counting_.empty() && places.size() == counting_.size() - isRemoved_.size(),
                  "MeshQueue::write: each chunk of takeCounted() needs a place");
    std::vector<std::uint32_t> addresses;
    auto place = places.begin();
    for (std::size_t k = 0; k < counting_.size(); ++k) {
        const std::size_t count = meshSections_.ofChunk(k).size();
        if (isRemoved_.contains(counting_[k]) || place->empty()) {
            addresses.insert(addresses.end(), count, kNoPlace);
        } else {
            base::require(place->size() == count,
                          "MeshQueue::write: each mesh section of a chunk needs a place");
            addresses.insert(addresses.end(), place->begin(), place->end());
        }
        if (!isRemoved_.contains(counting_[k])) ++place;
    }
    for (std::size_t arena = 0; arena < quads.buffers.size(); ++arena) {
        const auto [offsets, isAny] =
            offsetsIn(addresses, static_cast<std::uint32_t>(arena), quads.arenaSize);
        if (isAny) mesher_.write(offsets, *quads.buffers[arena]);
    }
    // Writing takes as long on the GPU as counting.
    const double onGpu = 2 * mesher_.countMilliseconds();
    adaptBatch(counting_.size(), std::max(onGpu, countMilliseconds_ + millisecondsSince(start_)));
    counting_.clear();
    isRemoved_.clear();
}

// Grows by at most a factor of two: a few chunks of air tell nothing about the next ones.
void MeshQueue::adaptBatch(std::size_t chunks, double milliseconds) {
    if (budgetMilliseconds_ <= 0) return;
    const double wanted = static_cast<double>(chunks) * budgetMilliseconds_ / std::max(milliseconds, 1e-3);
    const double most = std::min<double>(2.0 * static_cast<double>(batchSize_), GpuMesher::kMaxChunks);
    batchSize_ = static_cast<std::size_t>(std::clamp(wanted, 1.0, most));
}

}  // namespace terrane::mesh_gpu
