// The picture of a world in the list of worlds. Any thread.
#pragma once

#include "terrane/base/image.h"

namespace terrane::app {

constexpr int kThumbnailWidth = 320, kThumbnailHeight = 180;

// The middle of an image with the sides of a thumbnail, made as small: each pixel is the mean of those that
// it covers. Smaller images stay as small.
base::Image thumbnailFrom(const base::Image& image);

}  // namespace terrane::app
