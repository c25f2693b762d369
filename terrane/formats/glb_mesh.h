// Converts meshes of chunks to a glTF model: one part for each material, whose texture repeats over merged
// quads. `terrane export` calls it. One thread uses it.
//
// Our x, y, z are x, -z, y of the file: z is up here and y there, a block is a meter, and nothing is
// mirrored.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/formats/glb_file.h"
#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::formats {

// 4 vertices × 32 bytes + 6 indices × 4 bytes a quad: 608 MB, and as much again while a file is made.
constexpr std::size_t kMaxGlbQuads = 4'000'000;

// Variants of a texture as an image, by the use of its alpha.
enum class GlbImageUse : std::uint8_t { Opaque, Alpha, Holes, Glow, GlowAboveHoles };

class GlbMesh {
  public:
    // Both arguments outlive this.
    GlbMesh(const world::BlockRegistry& blocks, const world::TextureSource& textures);

    // Adds a chunk. `corner` is the position of the chunk's lowest block in the model, in blocks along our
    // axes. Returns OutOfResources if there are too many quads.
    [[nodiscard]] base::Result<void> add(const mesh::ChunkMesh& mesh, glm::ivec3 corner);

    std::size_t quadCount() const { return quads_; }
    // Returns the model with its textures; an error if it is empty or a texture is missing. It is called
    // once.
    [[nodiscard]] base::Result<GlbModel> finish(std::string name);

  private:
    void addQuad(shared::Quad quad, glm::ivec3 corner);
    base::Result<std::size_t> imageOf(const world::Material& material, bool isGlow, GlbModel& model);

    const world::BlockRegistry& blocks_;
    const world::TextureSource& textures_;
    std::vector<shared::ShapeFace> faces_;
    std::map<std::pair<shared::uint, bool>, GlbPart> parts_;  // by material and whether the face is two-sided
    std::map<std::pair<std::string, GlbImageUse>, std::size_t> imageNumbers_;  // index in the model
    std::size_t quads_ = 0;
};

}  // namespace terrane::formats
