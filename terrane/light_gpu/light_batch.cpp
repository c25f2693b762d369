#include "terrane/light_gpu/light_batch_internal.h"

#include <algorithm>
#include <unordered_map>

#include "terrane/base/require.h"

namespace terrane::light_gpu {
namespace {

using light::LightRequest;
using world::ChunkPos;
using world::ChunkPtr;

ChunkPos neighborOf(ChunkPos pos, int n) {
    return world::offsetBy(pos, n % light::kFieldSide - 1, n / light::kFieldSide - 1);
}

// The chunks that the requests of a batch name.
class KnownChunks {
  public:
    // False if the request conflicts with those before it, or there is no room. Then nothing changes.
    bool add(const LightRequest& request) {
        if (requested_ == kMaxRequests) return false;
        std::size_t fresh = 0;
        for (int n = 0; n < light::kFieldChunks; ++n) {
            const ChunkPtr& chunk = request.chunks[static_cast<std::size_t>(n)];
            const auto found = chunks_.find(neighborOf(request.pos, n));
            if (found == chunks_.end()) {
                fresh += chunk ? 1 : 0;
            } else if (found->second.chunk != chunk ||
                       (n == light::kCenterChunk && found->second.isRequested)) {
                return false;
            }
        }
        if (present_ + fresh > kMaxSolved) return false;
        present_ += fresh;
        ++requested_;
        insert(request);
        return true;
    }
    const std::vector<ChunkPos>& order() const { return order_; }  // of the chunks that exist
    bool isRequested(ChunkPos pos) const { return chunks_.at(pos).isRequested; }
    const ChunkPtr& chunk(ChunkPos pos) const { return chunks_.at(pos).chunk; }

  private:
    struct Known {
        ChunkPtr chunk;  // null: known to be absent
        bool isRequested = false;
    };

    void insert(const LightRequest& request) {
        for (int n = 0; n < light::kFieldChunks; ++n) {
            const ChunkPos pos = neighborOf(request.pos, n);
            const ChunkPtr& chunk = request.chunks[static_cast<std::size_t>(n)];
            if (chunks_.try_emplace(pos, Known{chunk}).second && chunk) order_.push_back(pos);
        }
        chunks_.at(request.pos).isRequested = true;
    }

    std::unordered_map<ChunkPos, Known, world::ChunkPosHash> chunks_;
    std::vector<ChunkPos> order_;
    std::size_t present_ = 0, requested_ = 0;
};

}  // namespace

LightBatch gatherBatch(std::span<const LightRequest> requests) {
    KnownChunks known;
    LightBatch batch;
    for (const LightRequest& request : requests) {
        base::require(request.chunks[light::kCenterChunk] != nullptr,
                      "LightRequest: the chunk to light is null");
        if (!known.add(request)) break;
        batch.requested.push_back(request.pos);
    }
    std::vector<ChunkPos> solved = batch.requested;
    for (const ChunkPos pos : known.order()) {
        if (!known.isRequested(pos)) solved.push_back(pos);
    }
    std::unordered_map<ChunkPos, shared::uint, world::ChunkPosHash> numbers;
    for (const ChunkPos pos : solved) {
        batch.chunks.push_back(known.chunk(pos));
        numbers.emplace(pos, static_cast<shared::uint>(numbers.size()));
    }
    const auto numberAt = [&](ChunkPos pos) {
        const auto found = numbers.find(pos);
        return found == numbers.end() ? shared::kNoChunk : found->second;
    };
    for (const ChunkPos pos : solved) {
        batch.beside.emplace_back(numberAt(world::offsetBy(pos, -1, 0)), numberAt(world::offsetBy(pos, 1, 0)),
                                  numberAt(world::offsetBy(pos, 0, -1)),
                                  numberAt(world::offsetBy(pos, 0, 1)));
    }
    return batch;
}

}  // namespace terrane::light_gpu
