// Resources that every pass over the chunks' quads binds besides the quads: index pattern, shapes, materials,
// textures. The renderer uses it on the context's thread.
#pragma once

#include "terrane/base/result.h"
#include "terrane/gpu/buffer.h"
#include "terrane/gpu/texture.h"
#include "terrane/gpu/vertex_array.h"
#include "terrane/render/quads/block_textures.h"
#include "terrane/shared/shape_face.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::render {

// The same on the CPU, for culling.
struct QuadTables {
    std::vector<shared::ShapeFace> shapeFaces;
    std::vector<std::uint32_t> isWaving;  // by material
};

class QuadResources {
  public:
    QuadResources() = default;
    // `anisotropy` is the number of samples along the long side of a slanted texel footprint; 1 is none.
    QuadResources(const world::BlockRegistry& blocks, BlockTextures textures, float anisotropy);

    // Replaces the textures, for the same blocks.
    void setTextures(const world::BlockRegistry& blocks, BlockTextures textures);
    bool hasFaceSampling() const { return hasFaceSampling_; }

    // Binds all resources, and the records of the draws to come (shared::DrawRecord). With `isSmooth`
    // textures are filtered.
    void bind(const gpu::Buffer& drawRecords, bool isSmooth);
    // Binds only shapes and materials, or only textures.
    void bindTables() const;
    void bindTextures(bool isSmooth) const;
    const QuadTables& tables() const { return tables_; }
    std::size_t gpuBytes() const;

  private:
    QuadTables tables_;
    BlockTextures textures_;
    gpu::Sampler smooth_, nearest_;
    gpu::Buffer indices_, shapeFaces_, materials_;
    gpu::BufferTexture shapeFaceTexels_, materialTexels_;
    gpu::VertexArray vertexArray_;
    bool hasFaceSampling_ = false;
};

// Returns whether some face samples its texture in its own way, or a texture is smaller than the array. Then
// the shaders of quads need FACE_SAMPLING (block_texture.glsl); without it they are shorter.
bool needsFaceSampling(const world::BlockRegistry& blocks, const BlockTextures& textures);

}  // namespace terrane::render
