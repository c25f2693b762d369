#include "terrane/volume/read_chunks.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "terrane/volume/block_area.h"

namespace terrane::volume {
namespace {

// Chunks that one call of the store loads. Few, so that threads end together.
constexpr std::int64_t kChunksOfPart = 4;

// The error of the lowest number, whatever the order of threads.
class FirstError {
  public:
    void note(std::int64_t number, base::Error error) {
        const std::lock_guard lock(mutex_);
        if (number >= number_) return;
        number_ = number;
        error_ = std::move(error);
        isSet_ = true;
    }
    bool isSet() const { return isSet_; }
    // Whether one of a lower number is known.
    bool isBelow(std::int64_t number) const { return number_ < number; }
    const base::Error& error() const { return error_; }

  private:
    std::mutex mutex_;
    std::atomic<std::int64_t> number_ = std::numeric_limits<std::int64_t>::max();
    base::Error error_;
    std::atomic<bool> isSet_{false};
};

base::Result<world::Chunk> chunkFrom(store::LoadedChunk& stored, world::ChunkPos pos,
                                     const OpenedWorld& world) {
    if (!world::isInWorld(pos)) return world::Chunk();  // its key is that of another chunk
    if (stored.isUnread && !stored.isOverBudget)
        return base::fail(base::ErrorCode::Io, "{}: {}", store::nameOf(pos), stored.problem);
    if (stored.chunk) return std::move(*stored.chunk);
    const auto generator = TERRANE_TRY(world.generator(pos.level));
    return generator->generate(pos);
}

}  // namespace

ChunkList chunksOf(const world::ChunkArea& area) {
    return {area.chunkCount(), [area](std::int64_t number) { return chunkIn(area, number); }};
}

base::Result<void> forEachPart(OpenedWorld& world, std::int64_t count, const GoesOn& goesOn,
                               const std::function<base::Result<void>(std::int64_t)>& work) {
    const auto caller = std::this_thread::get_id();
    FirstError first;
    std::atomic<bool> isStopped{false};
    TERRANE_TRY(base::parallelFor(world.jobs(), static_cast<std::size_t>(count), [&](std::size_t k) {
        const auto number = static_cast<std::int64_t>(k);
        if (isStopped || first.isBelow(number)) return;
        if (goesOn && std::this_thread::get_id() == caller && !goesOn()) {
            isStopped = true;
            return;
        }
        if (auto done = work(number); !done) first.note(number, std::move(done.error()));
    }));
    if (first.isSet()) return tl::unexpected(first.error());
    if (isStopped) return base::fail(kStopped);
    return {};
}

base::Result<void> readChunks(OpenedWorld& world, const ChunkList& list, const GoesOn& goesOn,
                              const UseChunk& use) {
    const std::int64_t parts = (list.count + kChunksOfPart - 1) / kChunksOfPart;
    return forEachPart(world, parts, goesOn, [&](std::int64_t part) -> base::Result<void> {
        std::vector<world::ChunkPos> positions;
        const std::int64_t first = part * kChunksOfPart;
        for (std::int64_t k = first; k < std::min(first + kChunksOfPart, list.count); ++k)
            positions.push_back(list.at(k));
        std::vector<store::LoadedChunk> stored = world.store().loadMany(positions);
        for (std::size_t k = 0; k < positions.size(); ++k) {
            auto chunk = TERRANE_TRY(chunkFrom(stored[k], positions[k], world));
            use(first + static_cast<std::int64_t>(k), std::move(chunk));
        }
        return {};
    });
}

}  // namespace terrane::volume
