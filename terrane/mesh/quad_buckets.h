// Collects the quads of a region, one bucket a context and group, and appends them in order to a mesh.
// Scratch memory of one worker: buckets keep their capacity from chunk to chunk.
#pragma once

#include <array>
#include <vector>

#include "terrane/mesh/chunk_mesh.h"

namespace terrane::mesh {

class QuadBuckets {
  public:
    // Quads for one context and group. Valid until finishRegion().
    std::vector<shared::Quad>& bucket(int context, int group);
    // Widens the region's bounds by blocks minZ … maxZ − 1.
    void coverHeight(int minZ, int maxZ);
    // Appends all buckets to `quads`, says where each went, and empties them.
    RegionMesh finishRegion(std::vector<shared::Quad>& quads);

  private:
    std::array<std::vector<shared::Quad>, kContextCount * kGroupCount> buckets_;
    int minZ_ = world::kChunkHeight, maxZ_ = 0;
};

}  // namespace terrane::mesh
