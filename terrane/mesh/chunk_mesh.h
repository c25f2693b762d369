// The mesh of a chunk: its quads, sorted for drawing. A plain value; passed from the mesher to the renderer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrane/mesh/draw_bucket.h"
#include "terrane/shared/quad.h"

namespace terrane::mesh {

struct QuadRange {
    std::uint32_t first = 0, count = 0;  // in ChunkMesh::quads

    bool operator==(const QuadRange&) const = default;
};

// The vertical unit of culling and drawing. Its quads are contiguous: by draw bucket, then face direction.
struct MeshSection {
    QuadRange ranges[kDrawBucketCount][kFaceDirectionCount];
    int minZ = 0, maxZ = 0;  // the quads lie in blocks minZ … maxZ − 1; both 0 if there are none

    bool operator==(const MeshSection&) const = default;
};

struct ChunkMesh {
    std::vector<shared::Quad> quads;
    std::vector<MeshSection> meshSections;  // lowest first, kChunkHeight / meshSectionHeight of them

    bool operator==(const ChunkMesh&) const = default;
};

}  // namespace terrane::mesh
