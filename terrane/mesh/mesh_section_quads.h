// The quads of a chunk's mesh by mesh section: the ranges of a mesh section follow each other from the first
// on. All functions are pure; any thread may call them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrane/mesh/draw_bucket.h"
#include "terrane/shared/mesh_section.h"
#include "terrane/shared/quad.h"

namespace terrane::mesh {

// The mesh of a chunk: its quads, sorted for drawing. A plain value; passed from the mesher to the renderer.
struct QuadRange {
    std::uint32_t first = 0, count = 0;  // in ChunkMesh::quads

    bool operator==(const QuadRange&) const = default;
};

// The vertical unit of culling and drawing. Its quads are contiguous: by draw bucket, then face direction.
struct MeshSection {
    QuadRange ranges[kDrawBucketCount][kFaceDirectionCount];
    int bottom = 0, top = 0;  // its layers are bottom … top − 1; bottom is a multiple of their number
    int minZ = 0, maxZ = 0;   // the quads lie in blocks minZ … maxZ − 1; both 0 if there are none

    bool operator==(const MeshSection&) const = default;
};

struct ChunkMesh {
    std::vector<shared::Quad> quads;
    std::vector<MeshSection> meshSections;  // those with quads, lowest first

    bool operator==(const ChunkMesh&) const = default;
};

inline std::uint32_t firstQuad(const MeshSection& meshSection) {
    return meshSection.ranges[0][0].first;
}

inline std::uint32_t quadCount(const MeshSection& meshSection) {
    std::uint32_t count = 0;
    for (const auto& bucket : meshSection.ranges) {
        for (const QuadRange range : bucket) count += range.count;
    }
    return count;
}

// Returns the z that those of the mesh section's quads count from (shared/quad.h).
inline int quadBase(const MeshSection& meshSection) {
    return shared::quadSlab(meshSection.bottom) * static_cast<int>(shared::kQuadSlab);
}

// Returns the ranges in the order of a GPU record: two-sided buckets have faces of the last direction only.
inline std::array<QuadRange, shared::kRangesPerMeshSection> rangesOf(const MeshSection& meshSection) {
    std::array<QuadRange, shared::kRangesPerMeshSection> ranges;
    std::size_t next = 0;
    for (int bucket = 0; bucket < kDrawBucketCount; ++bucket) {
        const int first = bucketTwoSided(bucket) ? kAnyDirection : 0;
        for (int direction = first; direction < kFaceDirectionCount; ++direction) {
            ranges[next++] = meshSection.ranges[bucket][direction];
        }
    }
    return ranges;
}

// Returns the same mesh section with its quads from `first` on.
inline MeshSection movedTo(std::uint32_t first, MeshSection meshSection) {
    const std::uint32_t by = first - firstQuad(meshSection);  // modulo 2³²: it may be negative
    for (auto& bucket : meshSection.ranges) {
        for (QuadRange& range : bucket) range.first += by;
    }
    return meshSection;
}

}  // namespace terrane::mesh
