// The image of a world in the list of worlds. Any thread.
#pragma once

#include "terrane/base/image.h"

namespace terrane::app {

constexpr int kThumbnailWidth = 320, kThumbnailHeight = 180;

// The middle of an image, cropped to the aspect of a thumbnail and reduced: each pixel is the mean of those
// that it covers. Smaller images are not enlarged.
base::Image thumbnailFrom(const base::Image& image);

}  // namespace terrane::app
