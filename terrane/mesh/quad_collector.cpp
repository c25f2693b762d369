#include "terrane/mesh/quad_collector.h"

#include <algorithm>
#include <cassert>

namespace terrane::mesh {

void QuadArray::grow(std::size_t needed) {
    capacity_ = std::max(needed, 2 * capacity_);
    auto larger = std::make_unique_for_overwrite<shared::Quad[]>(capacity_);
    std::copy_n(quads_.get(), size_, larger.get());
    quads_ = std::move(larger);
}

QuadArray& QuadCollector::quadsOf(int bucket, int direction) {
    assert(bucket >= 0 && bucket < kDrawBucketCount && "bucket from drawBucket()");
    assert(direction >= 0 && direction < kFaceDirectionCount && "direction from faceDirection()");
    return buckets_[static_cast<std::size_t>(bucket * kFaceDirectionCount + direction)];
}

void QuadCollector::coverHeight(int minZ, int maxZ) {
    minZ_ = std::min(minZ_, minZ);
    maxZ_ = std::max(maxZ_, maxZ);
}

MeshSection QuadCollector::finishMeshSection(std::vector<shared::Quad>& quads) {
    MeshSection meshSection;
    for (int bucket = 0; bucket < kDrawBucketCount; ++bucket) {
        for (int direction = 0; direction < kFaceDirectionCount; ++direction) {
            const std::span<const shared::Quad> from = quadsOf(bucket, direction).quads();
            meshSection.ranges[bucket][direction] = {static_cast<std::uint32_t>(quads.size()),
                                                     static_cast<std::uint32_t>(from.size())};
            quads.insert(quads.end(), from.begin(), from.end());
            quadsOf(bucket, direction).clear();
        }
    }
    if (minZ_ < maxZ_) {
        meshSection.minZ = minZ_;
        meshSection.maxZ = maxZ_;
    }
    minZ_ = world::kHighestTop;
    maxZ_ = world::kLowestBottom;
    return meshSection;
}

}  // namespace terrane::mesh
