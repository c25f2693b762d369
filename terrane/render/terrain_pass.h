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

// How light is sampled between blocks: docs/light.md.
enum class LightSampling : std::uint8_t { Classic, Smooth };

class TerrainPass {
  public:
    // `anisotropy`: samples along the long side of a slanted texel footprint; 1 is none.
    static base::Result<TerrainPass> create(const gpu::ShaderLoader& shaders,
                                            const world::BlockRegistry& blocks, gpu::Texture2DArray textures,
                                            float anisotropy);

    // Into the bound framebuffer, with the frame's uniforms bound. Uploads the list into `ring`.
    void draw(const DrawList& list, const QuadStore& quads, gpu::MappedRing& ring, LightSampling light);

  private:
    using Programs = std::array<gpu::Program, 3>;  // by alpha class
    void drawContext(const DrawList& list, int context, gpu::MappedRing& ring, const Programs& programs);

    std::array<Programs, 2> programs_;  // by LightSampling
    gpu::Texture2DArray textures_;
    gpu::Sampler sampler_;
    gpu::Buffer indices_, shapeFaces_, materials_;
    gpu::VertexArray vertexArray_;
};

}  // namespace terrane::render
