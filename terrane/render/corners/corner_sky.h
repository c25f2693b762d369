// The sky with Shading::Corners: by day it is computed at the corners of a grid over the screen, and for each
// pixel only around the sun.
#pragma once

#include "terrane/render/frame/frame.h"

namespace terrane::render {

MaybePass makeCornerSky(FrameBuilder& build);

}  // namespace terrane::render
