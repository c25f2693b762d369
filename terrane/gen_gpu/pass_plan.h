// Plans the passes of each chunk that a batch needs: pure bookkeeping without OpenGL. gpu_generator.cpp uses
// it. Any thread may use it.
#pragma once

#include <cstdint>
#include <list>
#include <optional>
#include <unordered_map>
#include <vector>

#include "terrane/gen/compile/generator_graph.h"
#include "terrane/world/coords.h"

namespace terrane::gen_gpu {

// Assigns slots on the GPU to the intermediate results of chunks, and counts their finished passes. It uses
// no OpenGL. It is used on one thread, that of gpu_generator.cpp.
class SlotCache {
  public:
    explicit SlotCache(std::size_t slots);

    // Gives all of `chunks` slots at once; the cache must have as many. Chunks that have a slot keep it,
    // others replace the least recently used.
    void reserve(const std::vector<world::ChunkPos>& chunks);

    // Returns the slot of a chunk of the last reserve().
    std::uint32_t slot(world::ChunkPos pos) const { return entries_.at(pos).slot; }
    std::optional<std::uint32_t> find(world::ChunkPos pos) const;
    int passesDone(world::ChunkPos pos) const { return entries_.at(pos).passesDone; }
    void setPassesDone(world::ChunkPos pos, int passes) { entries_.at(pos).passesDone = passes; }

  private:
    using Order = std::list<world::ChunkPos>;
    struct Entry {
        std::uint32_t slot;
        int passesDone;
        Order::iterator order;
    };

    std::vector<std::uint32_t> free_;
    Order order_;  // most recently used first
    std::unordered_map<world::ChunkPos, Entry, world::ChunkPosHash> entries_;
};

using PassCounts = std::unordered_map<world::ChunkPos, int, world::ChunkPosHash>;

// Returns the number of passes that each chunk must have done so that all of `requested` can be finished.
PassCounts neededPasses(const gen::GeneratorGraph& generator, const std::vector<world::ChunkPos>& requested);

}  // namespace terrane::gen_gpu
