// Screen-space ambient occlusion of the opaque surfaces, then of the nearest blended ones. Used by the
// renderer on the context's thread.
#pragma once

#include "terrane/render/frame/frame_targets.h"
#include "terrane/render/frame/fullscreen_pass.h"

namespace terrane::render {

class AmbientOcclusion {
  public:
    AmbientOcclusion() = default;
    explicit AmbientOcclusion(const gpu::ShaderLoader& shaders);

    // `hasLayers`: drawNearestLayer() is used too.
    base::Result<void> configure(const FrameTargets& targets, bool isOn, bool hasLayers);
    // Draws the occlusion of the opaque surfaces.
    void draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const;
    // Draws the occlusion of the nearest blended layer, whose textures are bound: replaces the result where
    // the layer has faces.
    void drawNearestLayer(gpu::Pipeline& pipeline, const FrameTargets& targets) const;
    bool isOn() const { return size_.x > 0; }
    const gpu::Texture2D& result() const { return visibility_.texture; }  // visibility: 1 is open
    std::size_t gpuBytes() const { return visibility_.texture.sizeBytes() + between_.texture.sizeBytes(); }

  private:
    // Finds the visibility, then blurs it along both axes.
    struct Passes {
        FullscreenPass find, alongX, alongY;
    };
    static Passes makePasses(const gpu::ShaderLoader& shaders);
    static base::Result<void> select(Passes& passes, int samples, bool nearestLayer);
    void run(gpu::Pipeline& pipeline, const FrameTargets& targets, const Passes& passes) const;

    Passes opaque_, nearestLayer_;
    ColorTarget visibility_, between_;
    glm::ivec2 size_{0};
};

}  // namespace terrane::render
