// The chunks that a view needs and their order: near ones first, those in front of the camera before those
// behind it. Plain data and pure functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "terrane/world/coords.h"

namespace terrane::stream {

struct ViewOrder {
    world::ChunkPos center;
    int distance = -1;      // chunks, Chebyshev; -1: no view yet
    glm::vec2 direction{};  // in x and y, of length 1 or 0

    // The offsets of the needed chunks from the center, most urgent first, and the index of each offset in
    // that list.
    std::vector<world::ChunkPos> offsets;
    std::vector<std::size_t> ranks;

    std::size_t size() const { return offsets.size(); }
    // Returns the chunk with a rank; it may lie beyond the world.
    world::ChunkPos at(std::size_t rank) const {
        return world::offsetBy(center, offsets[rank].x, offsets[rank].y);
    }
};

// The chunks in a view become visible. One more ring of chunks is needed to light and mesh them.
inline bool isInView(const ViewOrder& view, world::ChunkPos pos) {
    return world::chunkDistance(pos, view.center) <= view.distance;
}
inline bool isNeeded(const ViewOrder& view, world::ChunkPos pos) {
    return view.distance >= 0 && world::chunkDistance(pos, view.center) <= view.distance + 1;
}

// Sets the view; sorts the offsets again only where distance or direction changed.
void moveView(ViewOrder& view, world::ChunkPos center, int distance, glm::vec2 direction);

// Returns the urgency of any chunk, in the view or not. A smaller number is more urgent.
std::int64_t urgency(const ViewOrder& view, world::ChunkPos pos);

// Returns the index of a needed chunk in the order.
std::size_t rankOf(const ViewOrder& view, world::ChunkPos pos);

}  // namespace terrane::stream
