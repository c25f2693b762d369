// Smaller copies of images: thumbnails. Any thread.
#pragma once

#include "terrane/base/image.h"

namespace terrane::base {

// The image in the largest size of the same shape within these pixels; as it is where it fits. Each pixel is
// the mean of those that it stands for.
[[nodiscard]] Image shrunk(const Image& image, int maxWidth, int maxHeight);

}  // namespace terrane::base
