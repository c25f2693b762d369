#include "terrane/mesh_gpu/mesh_queue.h"

#include <algorithm>
#include <chrono>

#include "terrane/base/profile.h"

namespace terrane::mesh_gpu {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kFirstBatch = 8;  // chunks; from there on by how long they took

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

MeshQueue::MeshQueue(GpuMesher mesher, const world::BlockRegistry& blocks, double budgetMilliseconds)
    : mesher_(std::move(mesher)),
      blocks_(blocks),
      budgetMilliseconds_(budgetMilliseconds),
      batchSize_(budgetMilliseconds > 0 ? kFirstBatch : GpuMesher::kMaxChunks) {}

void MeshQueue::add(world::ChunkPos pos) {
    if (isWaiting_.insert(pos).second) waiting_.push_back(pos);
}

void MeshQueue::remove(world::ChunkPos pos) {
    isWaiting_.erase(pos);
    if (isCounted(pos)) isRemoved_.insert(pos);
}

bool MeshQueue::isCounted(world::ChunkPos pos) const {
    return std::ranges::find(counted_, pos) != counted_.end() && !isRemoved_.contains(pos);
}

void MeshQueue::advance(const mesh::MeshOptions& options, const MeshQueueHost& host) {
    if (!counted_.empty()) {
        if (!mesher_.isCounted()) return;
        write(host);
    }
    if (!isWaiting_.empty()) count(options, host);
}

void MeshQueue::count(const mesh::MeshOptions& options, const MeshQueueHost& host) {
    TERRANE_ZONE("mesh queue: count");
    const auto start = Clock::now();
    std::vector<mesh::MeshBlocks> chunks;
    for (; !waiting_.empty() && counted_.size() < batchSize_; waiting_.pop_front()) {
        if (isWaiting_.erase(waiting_.front()) == 0) continue;
        counted_.push_back(waiting_.front());
        chunks.push_back(host.blocks(waiting_.front()));
    }
    std::vector<mesh::MeshInput> inputs;
    for (const mesh::MeshBlocks& chunk : chunks) inputs.push_back(mesh::meshInput(chunk, blocks_, options));
    mesher_.count(inputs);
    countMilliseconds_ = millisecondsSince(start);
}

void MeshQueue::write(const MeshQueueHost& host) {
    TERRANE_ZONE("mesh queue: write");
    const auto start = Clock::now();
    const std::vector<mesh::RegionMesh> regions = mesher_.regions();
    const std::size_t perChunk = regions.size() / counted_.size();
    std::vector<std::uint32_t> places;
    for (std::size_t k = 0; k < counted_.size(); ++k) {
        std::vector<std::uint32_t> firstQuads;
        if (!isRemoved_.contains(counted_[k])) {
            firstQuads = host.place(counted_[k], std::span(regions).subspan(k * perChunk, perChunk));
        }
        firstQuads.resize(perChunk, kNoPlace);
        places.insert(places.end(), firstQuads.begin(), firstQuads.end());
    }
    mesher_.write(places, host.quads());
    // Writing does on the GPU what counting does.
    const double onGpu = 2 * mesher_.countMilliseconds();
    adaptBatch(counted_.size(), std::max(onGpu, countMilliseconds_ + millisecondsSince(start)));
    counted_.clear();
    isRemoved_.clear();
}

// At most twice as many as the time before: a few chunks of air tell nothing of the next ones.
void MeshQueue::adaptBatch(std::size_t chunks, double milliseconds) {
    if (budgetMilliseconds_ <= 0) return;
    const double wanted = static_cast<double>(chunks) * budgetMilliseconds_ / std::max(milliseconds, 1e-3);
    const double most = std::min<double>(2.0 * static_cast<double>(batchSize_), GpuMesher::kMaxChunks);
    batchSize_ = static_cast<std::size_t>(std::clamp(wanted, 1.0, most));
}

}  // namespace terrane::mesh_gpu
