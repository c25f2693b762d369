// The mesh sections that have quads from the camera outward. MeshSectionTable keeps it; no OpenGL, one
// thread.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "terrane/world/coords.h"

namespace terrane::render {

class MeshSectionOrder {
  public:
    // A mesh section in a slot that has none. `heights`: see shared::MeshSectionRecord; of the mesh sections
    // of a chunk any that tell which lies above which.
    void add(std::uint32_t slot, world::ChunkPos pos, std::uint32_t heights);
    void remove(std::uint32_t slot);

    // Slots by their mesh section's distance from the chunk, which is of level 0, nearest first. Where
    // distances are equal the place in the world decides: slots depend on the order in which chunks came.
    // False where all is as before.
    bool update(world::ChunkPos center);
    const std::vector<std::uint32_t>& slots() const { return slots_; }  // as update() left them

  private:
    // Compared member by member.
    struct Entry {
        std::uint32_t distance;  // squared chunks of level 0 over the ground
        std::int32_t x, y;
        std::uint8_t level;
        std::uint32_t heights, slot, number;
        auto operator<=>(const Entry&) const = default;
    };

    bool isGone(const Entry& entry) const { return numbers_[entry.slot] != entry.number; }
    void measure(std::vector<Entry>& entries) const;

    // Sorted ones, and those that came since; some of both are gone.
    std::vector<Entry> sorted_, added_;
    std::vector<std::uint32_t> numbers_;  // of the entry that a slot has, 0 for none
    std::uint32_t lastNumber_ = 0;
    bool hasGone_ = false;
    world::ChunkPos center_{};
    std::vector<std::uint32_t> slots_;
};

}  // namespace terrane::render
