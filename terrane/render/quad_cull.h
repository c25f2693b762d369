// Finds the visible quads on the GPU: those in view that cover a sample and are not hidden by the depth of
// the early pass (cull_pass.h). Most quads of mesh sections in view are hidden: in a landscape four in five.
//
// Two bits of a quad (shared/quad.h) hold the result for quad_list.h: *seen* quads are drawn by the early
// pass of the next frame, *new* ones are added by the late pass of this frame. A quad from the mesher has
// neither, so it is tested before it is drawn. As with mesh sections, no visible quad is missing in any
// frame. Used by the renderer on the context's thread.
#pragma once

#include "terrane/gpu/program.h"
#include "terrane/render/quad_resources.h"
#include "terrane/render/quad_store.h"

namespace terrane::render {

class QuadCull {
  public:
    static base::Result<QuadCull> create(const gpu::ShaderLoader& shaders);

    // Makes room for this many mesh sections and clears the list of those to test, for cull.comp.glsl.
    void begin(std::uint32_t meshSections);
    // Tests the quads of the mesh sections in the list, with the inputs of cull.comp.glsl bound. Later draws
    // see the bits.
    void run(const QuadStore& quads, const QuadResources& resources) const;
    std::size_t gpuBytes() const { return list_.sizeBytes(); }

  private:
    gpu::Program program_;
    gpu::Buffer list_;  // shared::TestedMeshSections, then their numbers
};

}  // namespace terrane::render
