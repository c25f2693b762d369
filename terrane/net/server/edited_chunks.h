// The edited chunks and tiles of a server's world, and the difference of each from its generated state.
// Workers compute a difference when it is first requested; it is then kept up to date, and evicted when too
// many are cached. On the server's thread.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/gen/level_generators.h"
#include "terrane/net/wire/chunk_difference.h"
#include "terrane/store/chunk_store.h"
#include "terrane/world/world.h"

namespace terrane::net {

class EditedChunks {
  public:
    // All parts outlive this, except `jobs`, which is destroyed first.
    struct Parts {
        const gen::LevelGenerators& generators;
        store::ReadableStore& store;
        const world::World& world;
        base::JobSystem& jobs;
    };
    explicit EditedChunks(const Parts& parts);

    // Adds a chunk of level 0 and the tiles above it. Returns false if all were known already.
    bool add(world::ChunkPos chunk);
    std::size_t count(int level) const { return positions_[static_cast<std::size_t>(level)].size(); }
    const std::unordered_set<world::ChunkPos, world::ChunkPosHash>& positions(int level) const {
        return positions_[static_cast<std::size_t>(level)];
    }
    // Edited positions up to `radius` (Chebyshev) around a chunk or tile, unordered.
    std::vector<world::ChunkPos> within(world::ChunkPos middle, int radius) const;

    // The difference as of the last onChanged(); null while a worker computes it: ask again in a later tick.
    // The pointer is valid until the next call of any function.
    const ChunkDifference* maybeDifference(world::ChunkPos pos);
    // Applies new block values of an edited chunk.
    void onChanged(world::ChunkPos pos, const ChunkDifference& newer);
    // A tile's row in the store changed.
    void onTileChanged(world::ChunkPos tile);
    // Sets a function that returns edits of a chunk that the store may lack; they are merged into the stored
    // state.
    using TailOf = std::function<ChunkDifference(world::ChunkPos)>;
    void setTail(TailOf tailOf) { tailOf_ = std::move(tailOf); }
    // Collects the results of workers.
    void update();

    // Maximum number of blocks in all cached differences: 4,000,000 × about 40 bytes = 160 MB.
    static constexpr std::size_t kMaxBlocks = 4'000'000;

  private:
    struct Known {
        ChunkDifference difference;  // while pending: the tail, and changes since the job began
        bool isPending = false;
        std::uint64_t job = 0, used = 0;
    };
    struct Found {
        world::ChunkPos pos;
        std::uint64_t job;
        std::optional<ChunkDifference> difference;  // no value: the store could not be read
    };
    struct Unread {
        world::ChunkPos pos;
        std::uint64_t job, retryAt;
    };
    struct Results;
    void findDifference(world::ChunkPos pos, Known& known);
    void submit(world::ChunkPos pos, Known& known);
    void retryUnread();
    void forgetOld();

    Parts parts_;
    TailOf tailOf_;
    std::array<std::unordered_set<world::ChunkPos, world::ChunkPosHash>, world::kMaxLevel + 1> positions_;
    std::unordered_map<world::ChunkPos, Known, world::ChunkPosHash> known_;
    std::size_t blockCount_ = 0;
    std::vector<Unread> unread_;
    std::uint64_t uses_ = 0, jobCount_ = 0, updates_ = 0;
    std::shared_ptr<Results> results_;
};

}  // namespace terrane::net
