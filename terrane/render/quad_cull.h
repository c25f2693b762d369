// Which quads can be seen, on the GPU: those that are in view, cover a sample and are not hidden by what was
// drawn early (cull_pass.h). Most quads of mesh sections in view are hidden: of a landscape four in five.
//
// Two bits of a quad (shared/quad.h) carry the answer to those who list what is drawn (quad_list.h):
// *seen* is what the early pass of the next frame draws, *new* what the late pass of this frame adds. A quad
// that comes from the mesher has neither, so it is tested before it is drawn. As with mesh sections nothing
// that can be seen is missing, in any frame. Used by the renderer on the context's thread.
#pragma once

#include "terrane/gpu/program.h"
#include "terrane/render/quad_resources.h"
#include "terrane/render/quad_store.h"

namespace terrane::render {

class QuadCull {
  public:
    static base::Result<QuadCull> create(const gpu::ShaderLoader& shaders);

    // Makes room for so many mesh sections and empties the list of those to be tested, for cull.comp.glsl.
    void begin(std::uint32_t meshSections);
    // Tests the quads of the mesh sections in the list, with what cull.comp.glsl reads bound. The bits are
    // there for draws that follow.
    void run(const QuadStore& quads, const QuadResources& resources) const;
    std::size_t gpuBytes() const { return list_.sizeBytes(); }

  private:
    gpu::Program program_;
    gpu::Buffer list_;  // shared::TestedMeshSections, then their numbers
};

}  // namespace terrane::render
