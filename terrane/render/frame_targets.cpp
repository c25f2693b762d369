#include "terrane/render/frame_targets.h"

#include <cassert>

#include "terrane/shared/bindings.h"

namespace terrane::render {

// Not a multisampled texture of one sample: drivers may take the next number they have, Mesa's software
// renderer four.
SampledTexture::SampledTexture(glm::ivec2 size, GLenum format, int samples, std::string_view label) {
    if (samples == 1) {
        plain_ = gpu::Texture2D(size, format, 1, label);
    } else {
        sampled_ = gpu::Texture2DMultisample(size, format, samples, label);
    }
}

base::Result<ColorTarget> ColorTarget::create(glm::ivec2 size, GLenum format, std::string_view label) {
    ColorTarget target;
    target.texture = gpu::Texture2D(size, format, 1, label);
    auto framebuffer = gpu::Framebuffer::create({{target.texture}, {}}, label);
    if (!framebuffer) return tl::unexpected(framebuffer.error());
    target.framebuffer = std::move(*framebuffer);
    return target;
}

base::Result<FrameTargets> FrameTargets::create(glm::ivec2 size, int samples) {
    assert(size.x > 0 && size.y > 0 && "a picture has pixels");
    FrameTargets t;
    t.size = size;
    t.wantedSamples = samples;
    t.surface = SampledTexture(size, GL_RGBA8, samples, "surfaces");
    t.depth = SampledTexture(size, GL_DEPTH_COMPONENT32F, samples, "depth");
    t.samples = t.surface.samples();
    t.sceneColor = gpu::Texture2D(size, GL_RGBA16F, 1, "scene");
    t.pictureColor = gpu::Texture2D(size, GL_RGBA8, 1, "picture");
    auto surfaces = gpu::Framebuffer::create({{t.surface.attachment()}, t.depth.attachment()}, "surfaces");
    if (!surfaces) return tl::unexpected(surfaces.error());
    gpu::FramebufferOptions sceneOptions{{t.sceneColor}, t.depth.attachment()};
    if (t.samples > 1) {
        t.maskDepth = gpu::Texture2D(size, GL_DEPTH_COMPONENT16, 1, "mask");
        auto mask = gpu::Framebuffer::create({{}, t.maskDepth}, "mask");
        if (!mask) return tl::unexpected(mask.error());
        t.mask = std::move(*mask);
        sceneOptions.depth = t.maskDepth;
    }
    auto scene = gpu::Framebuffer::create(sceneOptions, "scene");
    if (!scene) return tl::unexpected(scene.error());
    auto picture = gpu::Framebuffer::create({{t.pictureColor}, {}}, "picture");
    if (!picture) return tl::unexpected(picture.error());
    // No sky is drawn behind what is near; there the scene is blended with a share of 0 of what was before,
    // which must be a number.
    scene->clearColor(0, glm::vec4(0));
    t.surfaces = std::move(*surfaces);
    t.scene = std::move(*scene);
    t.picture = std::move(*picture);
    return t;
}

void FrameTargets::bindSurfaces() const {
    surface.bind(shared::kSurfaceUnit);
    depth.bind(shared::kDepthUnit);
}

}  // namespace terrane::render
