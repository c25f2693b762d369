#include "terrane/render/gbuffer_pass.h"

#include "terrane/gpu/debug.h"

namespace terrane::render {
GBufferPass::GBufferPass(const gpu::ShaderLoader& shaders)
    : opaque_(quadShaders(shaders, "gbuffer", "opaque quads")),
      tested_(quadShaders(shaders, "gbuffer", "tested quads")) {}

base::Result<void> GBufferPass::select(int alphaSamples, bool isSmooth) {
    auto selected =
        opaque_.select(defined({{"PASS", 0}, {"ALPHA_CLASS", 0}, {"SAMPLES", 1}, {"SMOOTH", isSmooth}}));
    if (!selected) return selected;
    return tested_.select(
        defined({{"PASS", 0}, {"ALPHA_CLASS", 1}, {"SAMPLES", alphaSamples}, {"SMOOTH", isSmooth}}));
}

void GBufferPass::draw(const CullPass& culled) const {
    const gpu::DebugGroup group("G-buffer");
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GREATER);
    opaque_.use();
    culled.drawContexts(mesh::AlphaClass::Opaque, false);
    tested_.use();
    culled.drawContexts(mesh::AlphaClass::Tested, false);
}

}  // namespace terrane::render
