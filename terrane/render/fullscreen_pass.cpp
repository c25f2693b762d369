#include "terrane/render/fullscreen_pass.h"

#include "terrane/gpu/debug.h"

namespace terrane::render {

base::Result<FullscreenPass> FullscreenPass::create(const gpu::ShaderLoader& shaders,
                                                    std::string_view fragmentName, std::string_view label) {
    auto program =
        gpu::Program::graphics(shaders, "terrane/render/fullscreen.vert.glsl", fragmentName, {}, label);
    if (!program) return tl::unexpected(program.error());
    FullscreenPass pass;
    pass.label_ = label;
    pass.program_ = std::move(*program);
    pass.vertexArray_ = gpu::VertexArray(label);
    return pass;
}

void FullscreenPass::draw() const {
    const gpu::DebugGroup group(label_);
    program_.use();
    vertexArray_.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace terrane::render
