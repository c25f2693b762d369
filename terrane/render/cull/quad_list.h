// Lists the quads that a pass draws, on the GPU: for each draw command the quads with a bit that cull_pass.h
// sets. The command then draws the list, in the order of the quads, so the vertex shader runs for these only:
// a third of the quads of mesh sections in view. The renderer uses it on the context's thread.
#pragma once

#include <vector>

#include "terrane/gpu/buffer.h"
#include "terrane/gpu/program.h"
#include "terrane/render/quads/quad_store.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

class QuadList {
  public:
    static base::Result<QuadList> create(const gpu::ShaderLoader& shaders, const DrawLimits& limits);

    // Changes the commands of opaque and tested faces from compact.comp.glsl, with its inputs bound: they
    // draw the quads with `bit` in word 1. A command without room in the list stays as it is, and draws more.
    void run(const QuadStore& quads, shared::uint bit);
    // Binds the list for quad.vert.glsl.
    void bind() const { texels_.bind(shared::kListedQuadsUnit); }
    std::size_t gpuBytes() const { return list_.sizeBytes(); }

  private:
    void reserve(std::size_t quads);

    gpu::Program program_;
    gpu::Buffer list_;  // number of words in use, this one included, then numbers of quads
    gpu::BufferTexture texels_;
    std::size_t maxQuads_ = 0;
};

}  // namespace terrane::render
