// Screen-space ambient occlusion: finds the visibility (1 is open) in targets.occlusion, then blurs it along
// both axes.
#pragma once

#include "terrane/render/frame/frame.h"

namespace terrane::render {

struct OcclusionPrograms {
    const gpu::Program *find, *alongX, *alongY;
    FrameBuilder::Drawn visibility, between;

    // Creates the programs for the nearest layer of blended faces if `isNearestLayer` is set, else for the
    // opaque surfaces. The targets are the same for both.
    static base::Result<OcclusionPrograms> make(FrameBuilder& build, bool isNearestLayer);
    // Draws the occlusion. `textures` are the G-buffer, and the layers for their occlusion.
    void draw(FrameContext& context, const gpu::TextureSet& textures) const;
};

}  // namespace terrane::render
