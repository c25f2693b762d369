// Screen-space ambient occlusion: finds the visibility (1 is open) in targets.occlusion, then blurs it along
// both axes.
#pragma once

#include "terrane/render/frame/frame.h"

namespace terrane::render {

struct OcclusionPrograms {
    const gpu::Program *find, *alongX, *alongY;
    FrameBuilder::Drawn visibility, between;

    // `isNearestLayer`: of blended faces, instead of the opaque surfaces. The targets are the same for both.
    static base::Result<OcclusionPrograms> make(FrameBuilder& build, bool isNearestLayer);
    // `textures`: the G-buffer, and layers where it is of these.
    void draw(FrameContext& context, const gpu::TextureSet& textures) const;
};

}  // namespace terrane::render
