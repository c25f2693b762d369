#include "terrane/mesh/chunk_mesher.h"

#include <algorithm>

#include "terrane/base/result.h"
#include "terrane/mesh/section_faces.h"

namespace terrane::mesh {

namespace {

SectionView viewSection(const MeshInput& input, int number) {
    SectionView view;
    view.center = &input.center->section(number);
    for (std::size_t side = 0; side < input.neighbors.size(); ++side) {
        if (!input.neighbors[side]) continue;
        view.neighbors[side] = &input.neighbors[side]->section(number);
        view.neighborStates[side] = &input.neighbors[side]->blockStates(number);
    }
    if (number > 0) view.neighbors[world::kFaceNegZ] = &input.center->section(number - 1);
    if (number + 1 < world::kSectionsPerChunk) {
        view.neighbors[world::kFacePosZ] = &input.center->section(number + 1);
    }
    view.blockState = &input.center->blockStates(number);
    view.blocks = input.blocks;
    view.target.baseZ = number * world::kSectionSize;
    view.target.method = input.options.method;
    return view;
}

void requireWhole(const MeshInput& input) {
    base::require(input.center && input.blocks, "MeshInput: the chunk or the block registry is null");
    base::require(isMeshSectionHeight(input.options.meshSectionHeight),
                  "MeshInput: the height of mesh sections is a power of two, 8 to 128");
}

}  // namespace

MeshInput meshInput(const MeshBlocks& chunks, const world::BlockRegistry& blocks,
                    const MeshOptions& options) {
    static const world::Chunk kAir;
    const auto at = [&](std::size_t k) { return chunks[k] ? chunks[k].get() : &kAir; };
    return {at(0), {at(1), at(2), at(3), at(4)}, &blocks, options};
}

MeshSection buildMeshSection(const MeshInput& input, int meshSection, MeshScratch& scratch,
                             std::vector<shared::Quad>& quads) {
    requireWhole(input);
    const int height = input.options.meshSectionHeight;
    base::require(meshSection >= 0 && meshSection < world::kChunkHeight / height,
                  "buildMeshSection: the chunk has no mesh section of this number");
    const int step = std::min(height, world::kSectionSize);  // a section, or half of one
    for (int z = meshSection * height; z < (meshSection + 1) * height; z += step) {
        SectionView view = viewSection(input, z / world::kSectionSize);
        const auto layer = static_cast<std::size_t>(z % world::kSectionSize);
        view.target.layers = {layer, layer + static_cast<std::size_t>(step)};
        addSectionFaces(view, scratch.buckets);
    }
    return scratch.buckets.finishMeshSection(quads);
}

ChunkMesh meshChunk(const MeshInput& input, MeshScratch& scratch) {
    requireWhole(input);
    ChunkMesh mesh;
    scratch.quads.clear();
    for (int meshSection = 0; meshSection < world::kChunkHeight / input.options.meshSectionHeight;
         ++meshSection) {
        mesh.meshSections.push_back(buildMeshSection(input, meshSection, scratch, scratch.quads));
    }
    mesh.quads.assign(scratch.quads.begin(), scratch.quads.end());  // no larger than needed
    return mesh;
}

ChunkMesh meshTile(const world::Chunk& chunk, const world::BlockRegistry& blocks, const MeshOptions& options,
                   MeshScratch& scratch) {
    return meshChunk({&chunk, {}, &blocks, options}, scratch);
}

ChunkMesh meshAlone(const world::Chunk& chunk, const world::BlockRegistry& blocks) {
    const world::Chunk air;
    MeshScratch scratch;
    return meshChunk({&chunk, {&air, &air, &air, &air}, &blocks, {}}, scratch);
}

namespace {

class CpuMesher : public BatchMesher {
  public:
    std::vector<ChunkMesh> mesh(std::span<const MeshInput> chunks) override {
        std::vector<ChunkMesh> meshes;
        meshes.reserve(chunks.size());
        for (const MeshInput& chunk : chunks) meshes.push_back(meshChunk(chunk, scratch_));
        return meshes;
    }
    std::string_view backend() const override { return "cpu"; }

  private:
    MeshScratch scratch_;
};

}  // namespace

std::unique_ptr<BatchMesher> makeCpuMesher() {
    return std::make_unique<CpuMesher>();
}

}  // namespace terrane::mesh
