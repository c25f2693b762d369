// Compares the image of tiles with the image of the chunks that they replace. Pure functions.
#pragma once

#include "terrane/base/image.h"

namespace terrane::bench {

// One view. All of the same size.
struct Pictures {
    base::Image color;
    base::Image dry;     // without water and what else is blended
    base::Image normal;  // render::View::Normal: black where there is nothing
};

struct PictureFigures {
    // Differences between the mean colors of squares of 16×16 pixels, linear, in 255ths, for the component
    // that differs most.
    double meanDifference = 0, percentile99 = 0;
    double brightness = 1;                   // mean linear value, as a ratio
    double waterInBoth = 0, waterInAny = 0;  // pixels that water changes
    // Difference between the skylines, pixels: the mean over all columns of the image, and the share of
    // columns where it is more than `cell`.
    double skyline = 0, skylineBeyondCell = 0;
};

// `cell`: height in pixels that counts as equal for the skyline.
PictureFigures comparePictures(const Pictures& chunks, const Pictures& tiles, double cell);

// Both images, one above the other.
base::Image above(const base::Image& top, const base::Image& bottom);

}  // namespace terrane::bench
