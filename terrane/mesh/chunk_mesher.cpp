#include "terrane/mesh/chunk_mesher.h"

#include <algorithm>
#include <cassert>

#include "terrane/mesh/section_faces.h"

namespace terrane::mesh {
namespace {

constexpr bool isRegionHeight(int height) {
    return height >= world::kSectionSize && height <= world::kChunkHeight && (height & (height - 1)) == 0;
}

SectionView viewSection(const MeshInput& input, int number) {
    SectionView view;
    view.centre = &input.centre->section(number);
    for (std::size_t side = 0; side < input.neighbours.size(); ++side) {
        view.neighbours[side] = &input.neighbours[side]->section(number);
    }
    if (number > 0) view.neighbours[world::kFaceNegZ] = &input.centre->section(number - 1);
    if (number + 1 < world::kSectionsPerChunk) {
        view.neighbours[world::kFacePosZ] = &input.centre->section(number + 1);
    }
    view.blocks = input.blocks;
    view.baseZ = number * world::kSectionSize;
    return view;
}

}  // namespace

ChunkMesh meshChunk(const MeshInput& input, MeshScratch& scratch) {
    assert(input.centre && input.blocks && "a chunk and what its ids mean");
    assert(std::find(input.neighbours.begin(), input.neighbours.end(), nullptr) == input.neighbours.end() &&
           "a chunk is meshed when its neighbours are known");
    assert(isRegionHeight(input.regionHeight) && "whole sections, a power of two");

    ChunkMesh mesh;
    scratch.quads.clear();
    const int sectionsPerRegion = input.regionHeight / world::kSectionSize;
    for (int number = 0; number < world::kSectionsPerChunk; ++number) {
        addSectionFaces(viewSection(input, number), scratch.buckets);
        if ((number + 1) % sectionsPerRegion == 0) {
            mesh.regions.push_back(scratch.buckets.finishRegion(scratch.quads));
        }
    }
    mesh.quads.assign(scratch.quads.begin(), scratch.quads.end());  // no larger than needed
    return mesh;
}

}  // namespace terrane::mesh
