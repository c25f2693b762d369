#include "terrane/light/batch_lighter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <deque>
#include <stdexcept>
#include <unordered_map>

namespace terrane::light {
namespace {

constexpr std::size_t kMaxCpuLightBatch = 64;
constexpr std::size_t kCpuLightBatchesInFlight = 3;

class CpuLighter : public BatchLighter {
  public:
    explicit CpuLighter(const LightTable& table) : table_(table) {}

    std::size_t submit(std::span<const LightRequest> requests) override {
        if (inFlight_.size() == kCpuLightBatchesInFlight || requests.empty()) return 0;
        const auto taken = requests.first(std::min(requests.size(), kMaxCpuLightBatch));
        for (const LightRequest& request : taken) requireLevel0(request);
        inFlight_.emplace_back(taken.begin(), taken.end());
        return taken.size();
    }

    std::vector<LightResult> take(bool) override {
        if (inFlight_.empty()) return {};
        // Snapshots never change, so an address identifies a chunk.
        std::unordered_map<const world::Chunk*, LocalLight> locals;
        std::vector<LightResult> results;
        for (const LightRequest& request : inFlight_.front()) {
            LocalLightNeighborhood around{};
            for (std::size_t n = 0; n < around.size(); ++n) {
                if (request.chunks[n]) around[n] = &localOf(*request.chunks[n], locals);
            }
            results.push_back({request.pos, lightChunk(around, scratch_)});
        }
        inFlight_.pop_front();
        return results;
    }

    std::string_view backend() const override { return "cpu"; }

  private:
    const LocalLight& localOf(const world::Chunk& chunk,
                              std::unordered_map<const world::Chunk*, LocalLight>& locals) {
        const auto found = locals.find(&chunk);
        if (found != locals.end()) return found->second;
        return locals.emplace(&chunk, solveLocal(chunk, table_, scratch_)).first->second;
    }

    const LightTable& table_;
    LightScratch scratch_;
    std::deque<std::vector<LightRequest>> inFlight_;
};

}  // namespace

std::unique_ptr<BatchLighter> makeCpuLighter(const LightTable& table) {
    return std::make_unique<CpuLighter>(table);
}

std::vector<ChunkLight> lightAll(BatchLighter& lighter, std::span<const LightRequest> requests) {
    std::vector<ChunkLight> lights;
    lights.reserve(requests.size());
    std::span<const LightRequest> waiting = requests;
    while (lights.size() < requests.size()) {
        while (!waiting.empty()) {
            const std::size_t taken = lighter.submit(waiting);
            if (taken == 0) break;
            waiting = waiting.subspan(taken);
        }
        // Batches come back in the order in which they were submitted.
        for (LightResult& done : lighter.take(true)) lights.push_back(std::move(done.light));
    }
    return lights;
}

LightRequest requestIn(const LightArea& area, int x, int y) {
    LightRequest request{{x, y}, {}};
    for (int n = 0; n < kFieldChunks; ++n) {
        const int cx = x + n % kFieldSide - 1, cy = y + n / kFieldSide - 1;
        if (cx < 0 || cy < 0 || cx >= area.chunksX || cy >= area.chunksY) continue;
        // Refers to the area's chunk without owning it.
        request.chunks[static_cast<std::size_t>(n)] = world::ChunkPtr(world::ChunkPtr(), &area.chunk(cx, cy));
    }
    return request;
}

void requireLevel0(const LightRequest& request) {
    if (request.pos.level == 0) return;
    throw std::invalid_argument(fmt::format("chunk {},{} of level {}: light is found for level 0 only",
                                            request.pos.x, request.pos.y, request.pos.level));
}

}  // namespace terrane::light
