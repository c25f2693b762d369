// Collects the quads of a mesh section, one array a draw bucket and face direction, and appends them in order
// to a mesh. Scratch memory of one worker: arrays keep their capacity from chunk to chunk.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/world/heights.h"

namespace terrane::mesh {

// A growing array of quads whose free room is written directly: appending to a vector would initialize the
// room first.
class QuadArray {
  public:
    // Returns room for `count` quads after the present ones.
    shared::Quad* reserve(std::size_t count) {
        if (capacity_ - size_ < count) grow(size_ + count);
        return quads_.get() + size_;
    }
    // Adds the first `count` quads of the room reserved last.
    void add(std::size_t count) { size_ += count; }
    void clear() { size_ = 0; }
    std::span<const shared::Quad> quads() const { return {quads_.get(), size_}; }

  private:
    void grow(std::size_t needed);

    std::unique_ptr<shared::Quad[]> quads_;
    std::size_t size_ = 0, capacity_ = 0;
};

class QuadCollector {
  public:
    // Returns the array of one draw bucket and face direction. Valid until finishMeshSection().
    QuadArray& quadsOf(int bucket, int direction);
    // Widens the mesh section's bounds by blocks minZ … maxZ − 1.
    void coverHeight(int minZ, int maxZ);
    // Appends all arrays to `quads`, returns their ranges, and empties them. The caller sets the layers.
    MeshSection finishMeshSection(std::vector<shared::Quad>& quads);

  private:
    std::array<QuadArray, kDrawBucketCount * kFaceDirectionCount> buckets_;
    int minZ_ = world::kHighestTop, maxZ_ = world::kLowestBottom;
};

}  // namespace terrane::mesh
