// Where the quads of a region lie: its ranges follow each other from the first on. Pure functions; any
// thread.
#pragma once

#include <array>
#include <cstdint>

#include "terrane/mesh/chunk_mesh.h"
#include "terrane/shared/region.h"

namespace terrane::mesh {

inline std::uint32_t firstQuad(const RegionMesh& region) {
    return region.groups[0][0].first;
}

inline std::uint32_t quadCount(const RegionMesh& region) {
    std::uint32_t count = 0;
    for (const auto& context : region.groups) {
        for (const QuadRange range : context) count += range.count;
    }
    return count;
}

// In the order of a record for the GPU: two-sided contexts have faces of the last group only.
inline std::array<QuadRange, shared::kRangesOfRegion> rangesOf(const RegionMesh& region) {
    std::array<QuadRange, shared::kRangesOfRegion> ranges;
    std::size_t next = 0;
    for (int context = 0; context < kContextCount; ++context) {
        for (int g = contextTwoSided(context) ? kGroupAlways : 0; g < kGroupCount; ++g) {
            ranges[next++] = region.groups[context][g];
        }
    }
    return ranges;
}

// The same region with its quads from `first` on.
inline RegionMesh movedTo(std::uint32_t first, RegionMesh region) {
    const std::uint32_t by = first - firstQuad(region);  // modulo 2³² also where it moves down
    for (auto& context : region.groups) {
        for (QuadRange& range : context) range.first += by;
    }
    return region;
}

}  // namespace terrane::mesh
