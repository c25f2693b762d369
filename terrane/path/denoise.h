// Removes noise from the image of a path tracer. The result is biased: it is no truth to compare with.
#pragma once

#include "terrane/path/film.h"

namespace terrane::path {

// Replaces the radiance by means over neighbors that look alike: light and albedo are parted, and light is
// filtered five times by a kernel of 5 × 5 pixels, 1, 2, 4, 8 and 16 apart (H. Dammertz et al.,
// Edge-Avoiding À-Trous Wavelet Transform for fast Global Illumination Filtering, 2010). Neighbors count
// less the more their normal, their depth, and, by its variance, their light differ.
void denoise(Means& means, base::JobSystem& jobs);

}  // namespace terrane::path
