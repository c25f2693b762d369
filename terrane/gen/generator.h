// A generator ready to run for one world seed and one level: position in, chunk out. The blocks depend on
// nothing but the generator, the seed and the position: not on threads, order of requests or instruction set.
//
// Results of a chunk that neighbors may need are computed once and stored in a cache of bounded size. Other
// results are computed with the chunk itself.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/compile/top_down_passes.h"
#include "terrane/gen/cpu/block_layers.h"
#include "terrane/gen/cpu/executor.h"
#include "terrane/world/chunk.h"
#include "terrane/world/coords.h"

namespace terrane::gen {

// Returns the chunks that a pass may read: the 3×3 chunks around `pos` by y, then x. Coordinates wrap at the
// world's edge as those of blocks do.
inline std::array<world::ChunkPos, 9> chunksAround(world::ChunkPos pos) {
    const int bits = 4 + pos.level;  // of a chunk's width in blocks
    const auto wrap = [bits](std::int32_t v) {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(v) << bits) >> bits;
    };
    std::array<world::ChunkPos, 9> around;
    for (int n = 0; n < 9; ++n) {
        around[static_cast<std::size_t>(n)] = {wrap(pos.x + n % 3 - 1), wrap(pos.y + n / 3 - 1), pos.level};
    }
    return around;
}

// The intermediate results of a chunk, shared by the threads that generate. Results of the first `passesDone`
// passes never change again.
struct ChunkWork {
    ChunkWork(std::size_t fieldCount, std::size_t passCount) : fields(fieldCount), blocks(passCount) {}

    // Returns the memory of a work without blocks.
    static std::size_t memoryBytes(std::size_t fieldCount, std::size_t passCount) {
        return sizeof(ChunkWork) + fieldCount * sizeof(ColumnValues) +
               passCount * sizeof(std::unique_ptr<BlockLayers>);
    }

    // Completes the first `passes` passes: calls run(pass) for each pass that no thread runs, and waits for a
    // pass that another thread runs. Rethrows an exception of `run`; then any thread may run the pass.
    template <class Run>
    void advance(int passes, const Run& run);

    int passesDone() const { return state_.load(std::memory_order_acquire) / 2; }

    std::vector<ColumnValues> fields;                  // by field
    std::vector<std::unique_ptr<BlockLayers>> blocks;  // by pass; null for 2D passes

  private:
    void setState(int state) {
        state_.store(state, std::memory_order_release);
        state_.notify_all();
    }

    std::atomic<int> state_ = 0;  // 2 × passes done, + 1 while a thread runs the next one
};

template <class Run>
void ChunkWork::advance(int passes, const Run& run) {
    for (;;) {
        int state = state_.load(std::memory_order_acquire);
        if (state / 2 >= passes) return;
        if (state % 2 != 0) {
            state_.wait(state, std::memory_order_acquire);
            continue;
        }
        if (!state_.compare_exchange_strong(state, state + 1)) continue;
        try {
            run(state / 2);
        } catch (...) {
            setState(state);  // wakes the threads that wait for this pass
            throw;
        }
        setState(state + 2);
    }
}

// The size of the cache of results that neighbors need: 1 KiB per field, and per 3D pass whose blocks they
// read 8 KiB for each section that is not one block. Overworld: 15 KiB per chunk, so the default holds 4,350
// chunks, more than the 4,225 of a view of 32.
struct CacheSize {
    std::size_t bytes = std::size_t{64} << 20;
    // The cache stores this many chunks even if they need more bytes, up to kMostTimes as many: with less
    // than some rows of a wide area nearly everything would be computed again.
    std::size_t minChunks = 256;
    static constexpr std::size_t kMostTimes = 8;
};

class PassCache {
  public:
    PassCache(CacheSize size, std::size_t fieldCount, std::size_t passCount)
        : size_(size), fieldCount_(fieldCount), passCount_(passCount) {}

    // Returns the chunk's work, new if the cache does not have it. A work stays alive while a caller holds
    // it.
    std::shared_ptr<ChunkWork> get(world::ChunkPos pos);
    // Counts memory that a chunk's work has taken since get().
    void addBytes(world::ChunkPos pos, const ChunkWork& work, std::size_t bytes);

    std::size_t bytes() {
        const std::lock_guard lock(mutex_);
        return bytes_;
    }

  private:
    using Order = std::list<world::ChunkPos>;
    struct Entry {
        std::shared_ptr<ChunkWork> work;
        Order::iterator order;
        std::size_t bytes;
    };
    void evict();  // under the mutex

    std::mutex mutex_;
    CacheSize size_;
    std::size_t fieldCount_, passCount_, bytes_ = 0;
    Order order_;  // most recently used first
    std::unordered_map<world::ChunkPos, Entry, world::ChunkPosHash> entries_;
};

// Returns the cache size of a level. A ring of tiles is at most 64 wide and made row by row: 8 MiB hold 8
// rows of it, and neighbors need 4.
constexpr CacheSize cacheSizeOf(int level) {
    return level == 0 ? CacheSize{} : CacheSize{.bytes = std::size_t{8} << 20};
}

// Returns whether a generator of `level` makes the chunk: it is of that level and in the world.
constexpr bool isGenerated(world::ChunkPos pos, int level = 0) {
    return pos.level == level && world::isInWorld(pos);
}
// Fails with the reason if a generator of `level` does not make the chunk.
base::Result<void> checkGenerated(world::ChunkPos pos, int level = 0);
// Throws std::invalid_argument with the reason if a generator of `level` does not make the chunk.
void requireGenerated(world::ChunkPos pos, int level = 0);

// Statistics of a 3D pass over a chunk.
struct PassReport {
    int pass;
    std::vector<SlabRun> slabs;     // from the bottom
    std::size_t wholeInstructions;  // of a layer, when nothing is left out
};

// Receives a chunk that is made down to a section, by its number. Returns whether sections below are needed.
using SectionCallback = std::function<bool(const world::Chunk& chunk, int lowest)>;

class Generator {
  public:
    Generator(GeneratorGraph graph, std::uint64_t seed);  // with the cache of the graph's level
    Generator(GeneratorGraph graph, std::uint64_t seed, CacheSize cacheSize);
    ~Generator();
    Generator(Generator&&) noexcept;
    Generator& operator=(Generator&&) noexcept;

    // Generates a chunk. Any number of threads may call it at a time; if one runs out of memory the others
    // continue. Throws std::invalid_argument unless isGenerated(pos, level()). Coordinates wrap beyond the
    // world's edge.
    world::Chunk generate(world::ChunkPos pos) const;

    // Does the same and appends reports of its 3D passes, without passes that had run already for neighbors.
    world::Chunk generate(world::ChunkPos pos, std::vector<PassReport>& report) const;

    // Generates a chunk from the top down: calls goesOn() after each section and makes no section below once
    // it returns false. The sections that are made equal those of generate(). Threads and errors are those of
    // generate(), and goesOn() may throw. Requires a last pass that makes blocks.
    world::Chunk generateDown(world::ChunkPos pos, const SectionCallback& goesOn) const;

    // Passes the chunk's blocks to `take`, layer by layer from the top, until no column is requested: cheaper
    // than generate() for views from above. Leaves out layers that are one block and equal the layer above.
    // Threads and errors are those of generate(); `take` may throw.
    void generateTopDown(world::ChunkPos pos, const LayerCallback& take) const;

    // Returns the values of a field in the chunk's columns, x + 16 y, for a graph without 3D passes
    // (builder.h). Threads and errors are those of generate().
    std::array<Bits, 256> columns(world::ChunkPos pos, std::uint32_t field) const;

    const std::string& name() const;
    int level() const;
    world::Heights heights() const;  // of its chunks
    std::size_t cacheBytes() const;  // in use

  private:
    world::Chunk generate(world::ChunkPos pos, std::vector<PassReport>* report) const;
    template <class Run>
    void runDown(world::ChunkPos pos, const Run& run) const;

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::gen
