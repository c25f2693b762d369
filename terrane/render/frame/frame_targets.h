// The textures that a frame is drawn into. Made by the renderer when the size or the number of samples
// changes.
#pragma once

#include <glm/vec2.hpp>

#include "terrane/gpu/framebuffer.h"
#include "terrane/render/frame/render_options.h"

namespace terrane::render {

// A texture of one or several samples a pixel: one of the two textures exists.
class MsaaTexture {
  public:
    MsaaTexture() = default;
    // Drivers may take more samples than asked for; one sample is a plain texture.
    MsaaTexture(glm::ivec2 size, GLenum format, int samples, std::string_view label);

    void bind(GLuint unit) const { plain_.id() != 0 ? plain_.bind(unit) : sampled_.bind(unit); }
    gpu::Attachment attachment() const {
        return plain_.id() != 0 ? gpu::Attachment(plain_) : gpu::Attachment(sampled_);
    }
    int samples() const { return plain_.id() != 0 ? 1 : sampled_.samples(); }
    GLuint id() const { return plain_.id() != 0 ? plain_.id() : sampled_.id(); }
    std::size_t sizeBytes() const { return plain_.sizeBytes() + sampled_.sizeBytes(); }

  private:
    gpu::Texture2D plain_;
    gpu::Texture2DMultisample sampled_;
};

// A texture with one sample a pixel that a full-screen pass writes and the next one reads.
struct ColorTarget {
    static base::Result<ColorTarget> create(glm::ivec2 size, GLenum format, std::string_view label);

    gpu::Texture2D texture;
    gpu::Framebuffer framebuffer;
};

struct FrameTargets {
    static base::Result<FrameTargets> create(glm::ivec2 size, int samples);

    // Binds the G-buffer for shaders that read it.
    void bindGBuffer() const;
    std::size_t gpuBytes() const;

    glm::ivec2 size{0};
    int requestedMsaaSamples = 0, msaaSamples = 0;  // a pixel; the driver may give more
    MsaaTexture gbufferColor, depth;                // see packed_gbuffer.glsl; reversed depth
    gpu::Texture2D sceneColor, ldrColor, maskDepth;
    gpu::Framebuffer gbuffer;  // the G-buffer
    gpu::Framebuffer scene;    // light, and coverage in alpha; depth: that of the one sample, or the mask
    gpu::Framebuffer mask;     // with several samples a pixel: see shading_pass.h
    gpu::Framebuffer ldr;      // LDR target: as the screen shows it
    gpu::Framebuffer direct;   // with one sample a pixel, the same with the depth: see frame_targets.h
};

// The short path of a frame: if no later pass reads the linear scene, sky, surfaces and layers are drawn
// directly as the screen shows them, without the scene image and the final pass. Pure; any thread.
// `samples`: of a pixel, as the driver has them. With one sample and no clouds surfaces need no sky drawn
// behind them, and layers are shaded together with the surface behind. Reflected shores read the scene image.
constexpr bool isDirectImage(const RenderOptions& o, int samples) {
    return samples == 1 && !o.clouds && !o.godRays && !o.depthOfField && o.occlusion == Occlusion::Off &&
           o.singleTransparencyLayer == 0 && (o.water == Water::Plain || o.transparencyLayers == 0);
}

}  // namespace terrane::render
