#include "terrane/mesh/chunk_mesher.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "terrane/base/result.h"
#include "terrane/mesh/section_faces.h"

namespace terrane::mesh {

namespace {

bool hasSection(const world::Chunk& chunk, int number) {
    return number >= chunk.heights().firstSection() && number < chunk.heights().endSection();
}

SectionView viewSection(const MeshInput& input, int number) {
    static const world::Section kNothing;
    SectionView view;
    view.center = &input.center->section(number);
    for (std::size_t side = 0; side < input.neighbors.size(); ++side) {
        if (!input.neighbors[side]) continue;
        const bool isInNeighbor = hasSection(*input.neighbors[side], number);
        view.neighbors[side] = isInNeighbor ? &input.neighbors[side]->section(number) : &kNothing;
        view.neighborStates[side] = isInNeighbor ? &input.neighbors[side]->blockStates(number) : &kNothing;
    }
    for (const auto& [side, other] :
         {std::pair(world::kFaceNegZ, number - 1), {world::kFacePosZ, number + 1}})
        if (hasSection(*input.center, other)) view.neighbors[side] = &input.center->section(other);
    view.blockState = &input.center->blockStates(number);
    view.blocks = input.blocks;
    view.target.baseZ = number * world::kSectionSize;
    view.target.method = input.options.method;
    return view;
}

// Returns true for sections of one block without faces: most of a high column, so this takes no look at their
// blocks. May be false for some of them.
bool isPlain(const MeshInput& input, int number) {
    const world::Section& section = input.center->section(number);
    if (!section.isUniform()) return false;
    const world::BlockType& type = input.blocks->type(section.uniformValue());
    if (type.shape == world::Shape::None || !type.opaqueCube) return type.shape == world::Shape::None;
    const auto isOpaque = [&](const world::Section& other) {
        return other.isSame(section) ||
               (other.isUniform() && input.blocks->type(other.uniformValue()).opaqueCube);
    };
    const auto hidesSide = [&](const world::Chunk* neighbor) {
        return neighbor && hasSection(*neighbor, number) && isOpaque(neighbor->section(number));
    };
    const world::Chunk& center = *input.center;
    const bool isLowest = !hasSection(center, number - 1), isHighest = !hasSection(center, number + 1);
    return !isHighest && isOpaque(center.section(number + 1)) &&
           (isLowest || isOpaque(center.section(number - 1))) &&
           std::ranges::all_of(input.neighbors, hidesSide);
}

void requireWhole(const MeshInput& input) {
    base::require(input.center && input.blocks, "MeshInput: the chunk or the block registry is null");
    base::require(isMeshSectionHeight(input.options.meshSectionHeight),
                  "MeshInput: the height of mesh sections is a power of two, 8 to 128");
}

// Returns nothing if the mesh section has no quads.
std::optional<MeshSection> build(const MeshInput& input, int bottom, MeshScratch& scratch,
                                 std::vector<shared::Quad>& quads) {
    const world::Heights heights = input.center->heights();
    const int top = bottom + input.options.meshSectionHeight;
    const int step = std::min(top - bottom, world::kSectionSize);  // a section, or half of one
    bool mayHaveQuads = false;
    for (int z = std::max(bottom, heights.bottom); z < std::min(top, heights.top); z += step) {
        if (isPlain(input, z >> 4)) continue;
        SectionView view = viewSection(input, z >> 4);
        const auto layer = static_cast<std::size_t>(z & (world::kSectionSize - 1));
        view.target.layers = {layer, layer + static_cast<std::size_t>(step)};
        addSectionFaces(view, scratch.buckets);
        mayHaveQuads = true;
    }
    if (!mayHaveQuads) return std::nullopt;
    const std::size_t before = quads.size();
    MeshSection made = scratch.buckets.finishMeshSection(quads);
    if (quads.size() == before) return std::nullopt;
    made.bottom = bottom;
    made.top = top;
    return made;
}

}  // namespace

MeshInput meshInput(const MeshBlocks& chunks, const world::BlockRegistry& blocks,
                    const MeshOptions& options) {
    static const world::Chunk kAir;
    const world::Chunk* air = &kAir;
    const auto at = [&](std::size_t k) { return chunks[k] ? chunks[k].get() : air; };
    return {at(0), {at(1), at(2), at(3), at(4)}, &blocks, options};
}

std::optional<MeshSection> buildMeshSection(const MeshInput& input, int bottom, MeshScratch& scratch,
                                            std::vector<shared::Quad>& quads) {
    requireWhole(input);
    const world::Heights heights = input.center->heights();
    const int height = input.options.meshSectionHeight;
    base::require((bottom & (height - 1)) == 0 && bottom < heights.top && bottom + height > heights.bottom,
                  "buildMeshSection: the chunk has no mesh section that begins with this layer");
    return build(input, bottom, scratch, quads);
}

ChunkMesh meshChunk(const MeshInput& input, MeshScratch& scratch) {
    requireWhole(input);
    ChunkMesh mesh;
    scratch.quads.clear();
    forEachMeshSection(input, [&](int bottom, int) {
        if (const auto made = build(input, bottom, scratch, scratch.quads))
            mesh.meshSections.push_back(*made);
    });
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
