// The short path of a frame: if no later pass reads the linear scene, sky, surfaces and layers are drawn
// directly as the screen shows them, without the scene image and the final pass. Pure; any thread.
#pragma once

#include "terrane/render/render_options.h"

namespace terrane::render {

// `samples`: of a pixel, as the driver has them. With one sample and no clouds surfaces need no sky drawn
// behind them, and layers are shaded together with the surface behind. Reflected shores read the scene image.
constexpr bool isDirectImage(const RenderOptions& o, int samples) {
    return samples == 1 && !o.clouds && !o.godRays && !o.depthOfField && o.occlusion == Occlusion::Off &&
           o.singleTransparencyLayer == 0 && (o.water == Water::Plain || o.transparencyLayers == 0);
}

}  // namespace terrane::render
