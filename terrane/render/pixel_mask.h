// Selects the pixels that a full-screen pass draws, for targets with several samples a pixel. The depth test
// rejects the others before the shader runs, whereas neighboring pixels would run a branch in the shader too.
// Used by passes on the context's thread.
#pragma once

#include "terrane/render/frame_targets.h"
#include "terrane/render/fullscreen_pass.h"

namespace terrane::render {

class PixelMask {
  public:
    // Pixels in which any sample has a surface; shows the sky or may fade into it; has a layer.
    enum class Of { Surfaces, Sky, Layers };

    PixelMask() = default;
    PixelMask(const gpu::ShaderLoader& shaders, Of of) : pass_(shaders, "pixel_mask"), of_(of) {}

    base::Result<void> select(int samples);
    // Draws the mask into the depth of the scene, with the textures of layers bound for Of::Layers: 1 in
    // these pixels and 0 in others; shared::kFarSurfacesDepth and kDistantSurfacesDepth if all surfaces of a
    // pixel are such.
    void draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const;

  private:
    FullscreenPass pass_;
    Of of_ = Of::Surfaces;
};

}  // namespace terrane::render
