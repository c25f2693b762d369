#include "terrane/mesh/chunk_mesher.h"

#include <algorithm>
#include <cassert>

#include "terrane/mesh/section_faces.h"

namespace terrane::mesh {
namespace {

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
    view.smallData = &input.centre->smallDataSection(number);
    view.blocks = input.blocks;
    view.target.baseZ = number * world::kSectionSize;
    view.target.method = input.options.method;
    return view;
}

void checkInput([[maybe_unused]] const MeshInput& input) {
    assert(input.centre && input.blocks && "a chunk and what its ids mean");
    assert(std::find(input.neighbours.begin(), input.neighbours.end(), nullptr) == input.neighbours.end() &&
           "a chunk is meshed when its neighbours are known");
    assert(isRegionHeight(input.options.regionHeight) && "a power of two, 8 to 128");
}

}  // namespace

MeshInput meshInput(const MeshBlocks& chunks, const world::BlockRegistry& blocks,
                    const MeshOptions& options) {
    static const world::Chunk kAir;
    const auto at = [&](std::size_t k) { return chunks[k] ? chunks[k].get() : &kAir; };
    return {at(0), {at(1), at(2), at(3), at(4)}, &blocks, options};
}

RegionMesh meshRegion(const MeshInput& input, int region, MeshScratch& scratch,
                      std::vector<shared::Quad>& quads) {
    checkInput(input);
    const int height = input.options.regionHeight;
    assert(region >= 0 && region < world::kChunkHeight / height && "number of a region");
    const int step = std::min(height, world::kSectionSize);  // a section, or half of one
    for (int z = region * height; z < (region + 1) * height; z += step) {
        SectionView view = viewSection(input, z / world::kSectionSize);
        const auto layer = static_cast<std::size_t>(z % world::kSectionSize);
        view.target.layers = {layer, layer + static_cast<std::size_t>(step)};
        addSectionFaces(view, scratch.buckets);
    }
    return scratch.buckets.finishRegion(quads);
}

ChunkMesh meshChunk(const MeshInput& input, MeshScratch& scratch) {
    checkInput(input);
    ChunkMesh mesh;
    scratch.quads.clear();
    for (int region = 0; region < world::kChunkHeight / input.options.regionHeight; ++region) {
        mesh.regions.push_back(meshRegion(input, region, scratch, scratch.quads));
    }
    mesh.quads.assign(scratch.quads.begin(), scratch.quads.end());  // no larger than needed
    return mesh;
}

ChunkMesh meshAlone(const world::Chunk& chunk, const world::BlockRegistry& blocks) {
    const world::Chunk air;
    MeshScratch scratch;
    return meshChunk({&chunk, {&air, &air, &air, &air}, &blocks, {}}, scratch);
}

}  // namespace terrane::mesh
