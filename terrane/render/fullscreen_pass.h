// A pass that covers the screen with one triangle: the sky, the final picture. Used by the renderer on the
// context's thread.
#pragma once

#include <string_view>

#include "terrane/base/result.h"
#include "terrane/gpu/program.h"
#include "terrane/gpu/vertex_array.h"

namespace terrane::render {

class FullscreenPass {
  public:
    static base::Result<FullscreenPass> create(const gpu::ShaderLoader& shaders,
                                               std::string_view fragmentName, std::string_view label);

    // Into the bound framebuffer, at depth 0 (farthest); the depth test is the caller's.
    void draw() const;

  private:
    std::string label_;
    gpu::Program program_;
    gpu::VertexArray vertexArray_;
};

}  // namespace terrane::render
