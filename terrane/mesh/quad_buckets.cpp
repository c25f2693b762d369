#include "terrane/mesh/quad_buckets.h"

#include <algorithm>
#include <cassert>

namespace terrane::mesh {

std::vector<shared::Quad>& QuadBuckets::bucket(int context, int group) {
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
            std::vector<shared::Quad>& from = bucket(context, group);
            region.groups[context][group] = {static_cast<std::uint32_t>(quads.size()),
                                             static_cast<std::uint32_t>(from.size())};
            quads.insert(quads.end(), from.begin(), from.end());
            from.clear();
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
