#include "terrane/render/frame/frame_targets.h"

#include <cassert>

#include "terrane/shared/bindings.h"

namespace terrane::render {

// One sample is not a multisampled texture: drivers may take the next number they have, Mesa's software
// renderer four.
MsaaTexture::MsaaTexture(glm::ivec2 size, GLenum format, int samples, std::string_view label) {
    if (samples == 1) {
        plain_ = gpu::Texture2D(size, format, 1, label);
    } else {
        sampled_ = gpu::Texture2DMultisample(size, format, samples, label);
    }
}

base::Result<ColorTarget> ColorTarget::create(glm::ivec2 size, GLenum format, std::string_view label) {
    ColorTarget target;
    target.texture = gpu::Texture2D(size, format, 1, label);
    auto framebuffer = TERRANE_TRY(gpu::Framebuffer::create({{target.texture}, {}}, label));
    target.framebuffer = std::move(framebuffer);
    return target;
}

base::Result<FrameTargets> FrameTargets::create(glm::ivec2 size, int samples) {
    assert(size.x > 0 && size.y > 0 && "an image has pixels");
    FrameTargets t;
    t.size = size;
    t.requestedMsaaSamples = samples;
    t.gbufferColor = MsaaTexture(size, GL_RGBA8, samples, "G-buffer");
    t.depth = MsaaTexture(size, GL_DEPTH_COMPONENT32F, samples, "depth");
    t.msaaSamples = t.gbufferColor.samples();
    t.sceneColor = gpu::Texture2D(size, GL_RGBA16F, 1, "scene");
    t.ldrColor = gpu::Texture2D(size, GL_RGBA8, 1, "LDR");
    auto gbuffer = TERRANE_TRY(
        gpu::Framebuffer::create({{t.gbufferColor.attachment()}, t.depth.attachment()}, "G-buffer"));
    gpu::FramebufferOptions sceneOptions{{t.sceneColor}, t.depth.attachment()};
    if (t.msaaSamples > 1) {
        t.maskDepth = gpu::Texture2D(size, GL_DEPTH_COMPONENT16, 1, "mask");
        auto mask = TERRANE_TRY(gpu::Framebuffer::create({{}, t.maskDepth}, "mask"));
        t.mask = std::move(mask);
        sceneOptions.depth = t.maskDepth;
    }
    auto scene = TERRANE_TRY(gpu::Framebuffer::create(sceneOptions, "scene"));
    auto ldr = TERRANE_TRY(gpu::Framebuffer::create({{t.ldrColor}, {}}, "LDR"));
    if (t.msaaSamples == 1) {
        auto direct =
            TERRANE_TRY(gpu::Framebuffer::create({{t.ldrColor}, t.depth.attachment()}, "direct image"));
        t.direct = std::move(direct);
    }
    // No sky is drawn behind near surfaces. The scene is blended there with 0 of its previous color, which
    // must be a number.
    scene.clearColor(0, glm::vec4(0));
    t.gbuffer = std::move(gbuffer);
    t.scene = std::move(scene);
    t.ldr = std::move(ldr);
    return t;
}

void FrameTargets::bindGBuffer() const {
    gbufferColor.bind(shared::kGBufferUnit);
    depth.bind(shared::kDepthUnit);
}

std::size_t FrameTargets::gpuBytes() const {
    return gbufferColor.sizeBytes() + depth.sizeBytes() + sceneColor.sizeBytes() + ldrColor.sizeBytes() +
           maskDepth.sizeBytes();
}

}  // namespace terrane::render
