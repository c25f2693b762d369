// Draws the chunks' quads: opaque, alpha-tested, blended. Used by the renderer on the context's thread.
#pragma once

#include "terrane/base/result.h"
#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/program.h"
#include "terrane/gpu/sampler.h"
#include "terrane/gpu/texture.h"
#include "terrane/gpu/vertex_array.h"
#include "terrane/render/draw_list.h"
#include "terrane/world/block_registry.h"

namespace terrane::render {

class TerrainPass {
  public:
    // `anisotropy`: samples along the long side of a slanted texel footprint; 1 is none.
    static base::Result<TerrainPass> create(const gpu::ShaderLoader& shaders,
                                            const world::BlockRegistry& blocks, gpu::Texture2DArray textures,
                                            float anisotropy);

    // Into the bound framebuffer, with the frame's uniforms bound. Uploads the list into `ring`.
    void draw(const DrawList& list, const QuadStore& quads, gpu::MappedRing& ring);

  private:
    void drawContext(const DrawList& list, int context, gpu::MappedRing& ring);

    std::array<gpu::Program, 3> programs_;  // by alpha class
    gpu::Texture2DArray textures_;
    gpu::Sampler sampler_;
    gpu::Buffer indices_, shapeFaces_, materials_;
    gpu::VertexArray vertexArray_;
};

}  // namespace terrane::render
