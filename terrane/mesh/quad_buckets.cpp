#include "terrane/mesh/quad_buckets.h"

#include <algorithm>
#include <cassert>

namespace terrane::mesh {

void QuadBucket::grow(std::size_t needed) {
    capacity_ = std::max(needed, 2 * capacity_);
    auto larger = std::make_unique_for_overwrite<shared::Quad[]>(capacity_);
    std::copy_n(quads_.get(), size_, larger.get());
    quads_ = std::move(larger);
}

QuadBucket& QuadBuckets::bucket(int context, int group) {
    assert(context >= 0 && context < kContextCount && "context from faceContext()");
    assert(group >= 0 && group < kGroupCount && "group from faceGroup()");
    return buckets_[static_cast<std::size_t>(context * kGroupCount + group)];
}

void QuadBuckets::coverHeight(int minZ, int maxZ) {
    minZ_ = std::min(minZ_, minZ);
    maxZ_ = std::max(maxZ_, maxZ);
}

RegionMesh QuadBuckets::finishRegion(std::vector<shared::Quad>& quads) {
    RegionMesh region;
    for (int context = 0; context < kContextCount; ++context) {
        for (int group = 0; group < kGroupCount; ++group) {
            const std::span<const shared::Quad> from = bucket(context, group).quads();
            region.groups[context][group] = {static_cast<std::uint32_t>(quads.size()),
                                             static_cast<std::uint32_t>(from.size())};
            quads.insert(quads.end(), from.begin(), from.end());
            bucket(context, group).clear();
        }
    }
    if (minZ_ < maxZ_) {
        region.minZ = minZ_;
        region.maxZ = maxZ_;
    }
    minZ_ = world::kChunkHeight;
    maxZ_ = 0;
    return region;
}

}  // namespace terrane::mesh
