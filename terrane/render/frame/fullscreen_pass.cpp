#include "terrane/render/frame/fullscreen_pass.h"

#include <fmt/format.h>

#include "terrane/gpu/debug.h"

namespace terrane::render {

FullscreenPass::FullscreenPass(const gpu::ShaderLoader& shaders, std::string_view name)
    : variants_(shaders, "terrane/render/frame/fullscreen.vert.glsl",
                fmt::format("terrane/render/{}.frag.glsl", name), std::string(name.substr(name.rfind('/') + 1))),
      vertexArray_(name) {}

void FullscreenPass::draw(gpu::Pipeline& pipeline, const gpu::PipelineState& state) const {
    const gpu::DebugGroup group(variants_.label());
    pipeline.set(state);
    variants_.use();
    vertexArray_.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace terrane::render
