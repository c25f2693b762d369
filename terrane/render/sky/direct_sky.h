// The sky of frames that draw straight into the image (isDirectImage()): by day it is computed at the points
// of a grid, and for each pixel only around the sun.
#pragma once

#include "terrane/render/frame/frame.h"

namespace terrane::render {

MaybePass makeDirectSky(FrameBuilder& build);

}  // namespace terrane::render
