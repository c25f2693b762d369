// Where a pixel has several samples: which pixels a full-screen pass is to draw. The others are left out by
// the depth test, before its shader runs; a branch in it would be run by all pixels beside, too. Used by
// passes on the context's thread.
#pragma once

#include "terrane/render/frame_targets.h"
#include "terrane/render/fullscreen_pass.h"

namespace terrane::render {

class PixelMask {
  public:
    // Pixels of which any sample has a surface; what the sky may show through, or behind; a layer.
    enum class Of { Surfaces, Sky, Layers };

    PixelMask() = default;
    PixelMask(const gpu::ShaderLoader& shaders, Of of) : pass_(shaders, "pixel_mask"), of_(of) {}

    base::Result<void> select(int samples);
    // With the textures of layers bound, where it is of these. Then the scene has depth 1 in these pixels and
    // 0 in others; shared::kFarSurfacesDepth and kDistantSurfacesDepth where all surfaces of a pixel are
    // such.
    void draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const;

  private:
    FullscreenPass pass_;
    Of of_ = Of::Surfaces;
};

}  // namespace terrane::render
