// Selects the pixels that a full-screen pass draws, for targets with several samples a pixel. The depth test
// rejects the others before the shader runs, whereas neighboring pixels would run a branch in the shader too.
#pragma once

#include "terrane/render/frame/frame.h"

namespace terrane::render {

struct PixelMask {
    const gpu::Program* program = nullptr;  // null: one sample a pixel, no mask

    static base::Result<PixelMask> make(FrameBuilder& build, MaskOf of);
    // Draws the mask, within the rectangles if there are any, into the depth of the scene: 1 in these pixels
    // and 0 in others; shared::kFarSurfacesDepth and kDistantSurfacesDepth if all surfaces of a pixel are
    // such. `textures`: of layers, for MaskOf::Layers.
    void draw(FrameContext& context, const gpu::TextureSet& textures = {},
              std::span<const ScreenRect> within = {}) const;
};

}  // namespace terrane::render
