// A texture that passes draw into and read. It is used on the thread of the OpenGL context.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string_view>

#include "terrane/gpu/framebuffer.h"
#include "terrane/gpu/texture.h"
#include "terrane/render/frame/render_options.h"

namespace terrane::render {

struct TargetShape {
    std::string_view label;  // a literal
    GLenum format = GL_RGBA8;
    glm::ivec2 size{1};
    int samples = 1;  // a pixel
    int levels = 1;   // with one sample
    // Level 0 of a target that is not drawn into: see HiZ.
    bool operator==(const TargetShape&) const = default;
};

// One of the two textures exists: one sample is not a multisampled texture, for which drivers may take the
// next number they have.
class Target {
  public:
    explicit Target(const TargetShape& shape);

    const TargetShape& shape() const { return shape_; }
    int samples() const { return plain_.id() != 0 ? 1 : sampled_.samples(); }  // may be more than asked for
    GLuint id() const { return plain_.id() != 0 ? plain_.id() : sampled_.id(); }
    const gpu::Texture2D& plain() const { return plain_; }
    gpu::Attachment attachment() const;
    std::size_t sizeBytes() const { return plain_.sizeBytes() + sampled_.sizeBytes(); }

  private:
    TargetShape shape_;
    gpu::Texture2D plain_;
    gpu::Texture2DMultisample sampled_;
};
using TargetRef = std::shared_ptr<const Target>;

// Copies a rectangle; both have the same format and samples.
void copyTarget(const Target& from, const Target& to, glm::ivec2 corner, glm::ivec2 size);

// Returns whether a frame takes the short path: if no later pass reads the linear scene, sky, surfaces and
// layers are drawn directly as the screen shows them, without the scene and the final pass. `samples` are
// those of a pixel, as the driver has them. With one sample and no clouds surfaces need no sky drawn behind
// them, and layers are shaded together with the surface behind. Reflected shores read the scene, and so do
// layers that are not drawn as quads.
constexpr bool isDirectImage(const RenderOptions& o, int samples) {
    const bool drawsLayers = o.surfaces == SurfaceMethod::Rays && o.transparencyLayers > 0;
    return samples == 1 && !drawsLayers && !o.clouds && !o.godRays && !o.bloom && !o.depthOfField &&
           o.occlusion == Occlusion::Off && o.singleTransparencyLayer == 0 &&
           (o.water == Water::Plain || o.transparencyLayers == 0);
}

}  // namespace terrane::render
