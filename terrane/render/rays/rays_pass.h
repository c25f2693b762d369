// What the camera sees, found by rays: in place of the quads of the pass of surfaces (quads/gbuffer_pass.cpp)
// and of the one that separates layers (shading/transparency_pass.cpp).
#pragma once

#include "terrane/render/frame/frame.h"

namespace terrane::render {

MaybePass makeRaySurfaces(FrameBuilder& build);

// Binds what shaders with ray_surfaces.glsl read. `isBlended`: see RayStore::bind().
void bindRays(FrameContext& context, bool isBlended);

struct RayLayerPrograms {
    const gpu::Program *first = nullptr, *next = nullptr;  // null: not by rays

    static base::Result<RayLayerPrograms> make(FrameBuilder& build);
    // Draws a layer into the bound target, whose depth is that of the opaque surfaces. `before`: the depth of
    // the layer before it, or null.
    void draw(FrameContext& context, const Target* before) const;
};

}  // namespace terrane::render
