// The short way of a frame: where nothing reads the image's light any more, sky, surfaces and layers are
// drawn as the screen shows them, so that there is no image of light and no pass from it to the screen. Pure;
// any thread.
#pragma once

#include "terrane/render/render_options.h"

namespace terrane::render {

// `samples`: of a pixel, as the driver has them. Then surfaces do not fade over a sky that was drawn behind
// them, and layers are shaded together with what is behind. Mirrored shores read the image's light.
constexpr bool isDirectImage(const RenderOptions& o, int samples) {
    return samples == 1 && !o.clouds && !o.godRays && !o.depthOfField && o.occlusion == Occlusion::Off &&
           o.singleTransparencyLayer == 0 && (o.water == Water::Plain || o.transparencyLayers == 0);
}

}  // namespace terrane::render
