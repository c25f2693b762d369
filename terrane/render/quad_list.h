// Lists the quads that a pass draws, on the GPU: of each draw command those with a bit that quad_cull.h sets.
// The command then draws the list, in the order of the quads, so the vertex shader runs for these alone: a
// third of the quads of mesh sections in view. Used by the renderer on the context's thread.
#pragma once

#include <vector>

#include "terrane/gpu/buffer_texture.h"
#include "terrane/gpu/program.h"
#include "terrane/render/quad_store.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

class QuadList {
  public:
    static base::Result<QuadList> create(const gpu::ShaderLoader& shaders);

    // Changes the commands of opaque and tested faces that compact.comp.glsl wrote, with what that reads
    // bound: they draw the quads with `bit` in word 1. A command for which there is no room stays as it is,
    // and draws more.
    void run(const QuadStore& quads, shared::uint bit);
    // For quad.vert.glsl.
    void bind() const { texels_.bind(shared::kListedQuadsUnit); }
    std::size_t gpuBytes() const { return list_.sizeBytes(); }

  private:
    void reserve(std::size_t quads);

    gpu::Program program_;
    gpu::Buffer list_;  // how many numbers are in it, itself included, then those
    gpu::BufferTexture texels_;
};

}  // namespace terrane::render
