// Order of the mesh sections that have quads, from the camera outward. MeshSectionTable owns it; it uses no
// OpenGL, one thread.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "terrane/world/coords.h"

namespace terrane::render {

class MeshSectionOrder {
  public:
    // Adds a mesh section in a free slot. `heights`: see shared::MeshSectionRecord, as a signed number; any
    // values that order the mesh sections of a chunk by height.
    void add(std::uint32_t slot, world::ChunkPos pos, std::int32_t heights);
    void remove(std::uint32_t slot);

    // Sorts slots by the distance of their mesh section from the chunk `center` of level 0, nearest first.
    // Equal distances are ordered by place in the world, since slots depend on the order in which chunks
    // arrived. Returns false if nothing changed.
    bool update(world::ChunkPos center);
    const std::vector<std::uint32_t>& slots() const { return slots_; }  // as update() left them

  private:
    // Compared member by member.
    struct Entry {
        std::uint32_t distance;  // squared chunks of level 0 over the ground
        std::int32_t x, y;
        std::uint8_t level;
        std::int32_t heights;
        std::uint32_t slot, number;
        auto operator<=>(const Entry&) const = default;
    };

    bool isGone(const Entry& entry) const { return numbers_[entry.slot] != entry.number; }
    void measure(std::vector<Entry>& entries) const;

    // Sorted entries, and those added since; both may have removed ones.
    std::vector<Entry> sorted_, added_;
    std::vector<std::uint32_t> numbers_;  // of the entry that a slot has, 0 for none
    std::uint32_t lastNumber_ = 0;
    bool hasGone_ = false;
    world::ChunkPos center_{};
    std::vector<std::uint32_t> slots_;
};

}  // namespace terrane::render
