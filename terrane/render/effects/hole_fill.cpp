#include "terrane/render/effects/hole_fill.h"

#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

void copy(const MsaaTexture& from, const MsaaTexture& to, glm::ivec2 size) {
    const GLenum target = from.samples() > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    glCopyImageSubData(from.id(), target, 0, 0, 0, 0, to.id(), target, 0, 0, 0, 0, size.x, size.y, 1);
}

}  // namespace

HoleFill::HoleFill(const gpu::ShaderLoader& shaders) : fill_(shaders, "effects/hole_fill") {}

base::Result<void> HoleFill::configure(const FrameTargets& targets, bool isOn) {
    if (!isOn) {
        surface_ = {};
        depth_ = {};
        return {};
    }
    TERRANE_TRY(fill_.select(defined({{"MSAA_SAMPLES", targets.msaaSamples}})));
    if (this->isOn() && size_ == targets.size && surface_.samples() == targets.msaaSamples) return {};
    surface_ = MsaaTexture(targets.size, GL_RGBA8, targets.msaaSamples, "G-buffer with holes");
    depth_ = MsaaTexture(targets.size, GL_DEPTH_COMPONENT32F, targets.msaaSamples, "depth with holes");
    size_ = targets.size;
    return {};
}

void HoleFill::draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const {
    copy(targets.gbufferColor, surface_, size_);
    copy(targets.depth, depth_, size_);
    surface_.bind(shared::kGBufferUnit);
    depth_.bind(shared::kDepthUnit);
    targets.gbuffer.bind();
    fill_.draw(pipeline, {.depthTest = gpu::DepthTest::Always, .readsSampleId = targets.msaaSamples > 1});
}

}  // namespace terrane::render
