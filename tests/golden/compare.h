// Measures the difference between images, with the tolerance of golden images.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>

#include "terrane/base/image.h"

namespace terrane::golden {

// In 8-bit steps, of the worst of the channels red, green and blue.
struct Difference {
    // Over the means of 4×4 pixels: other drivers move the edge of a face or of a leaf's hole by one pixel,
    // which is allowed, but never change sixteen pixels at once.
    double max = 0;
    double mean = 0;  // over all pixels
};

// Mesa's software renderer gives the same bytes with every vector width. A face of the gallery covers several
// tiles: a wrong or missing texture changes some of them by more (golden_proof_test.cpp).
constexpr Difference kTolerance{.max = 14, .mean = 0.75};

constexpr int kTile = 4;  // pixels

inline int channelAt(const base::Image& image, int x, int y, int channel) {
    return image.rgba[static_cast<std::size_t>(4 * (x + y * image.width) + channel)];
}

// The mean of a tile; tiles at the right and lower border may be smaller.
inline double tileMean(const base::Image& image, int tileX, int tileY, int channel) {
    int sum = 0, count = 0;
    for (int y = tileY; y < std::min(tileY + kTile, image.height); ++y) {
        for (int x = tileX; x < std::min(tileX + kTile, image.width); ++x, ++count) {
            sum += channelAt(image, x, y, channel);
        }
    }
    return static_cast<double>(sum) / count;
}

// Both images have the same size.
inline Difference difference(const base::Image& a, const base::Image& b) {
    Difference worst;
    for (int channel = 0; channel < 3; ++channel) {
        std::int64_t sum = 0;
        for (int y = 0; y < a.height; ++y) {
            for (int x = 0; x < a.width; ++x)
                sum += std::abs(channelAt(a, x, y, channel) - channelAt(b, x, y, channel));
        }
        worst.mean = std::max(worst.mean, static_cast<double>(sum) / (a.width * a.height));
        for (int y = 0; y < a.height; y += kTile) {
            for (int x = 0; x < a.width; x += kTile) {
                worst.max =
                    std::max(worst.max, std::abs(tileMean(a, x, y, channel) - tileMean(b, x, y, channel)));
            }
        }
    }
    return worst;
}

inline bool isSame(const base::Image& a, const base::Image& b) {
    if (a.width != b.width || a.height != b.height) return false;
    const Difference d = difference(a, b);
    return d.max <= kTolerance.max && d.mean <= kTolerance.mean;
}

// True if no channel spans more than a few steps: nothing was drawn.
inline bool isFlat(const base::Image& image) {
    constexpr int kSpan = 8;
    for (int channel = 0; channel < 3; ++channel) {
        int low = 255, high = 0;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                low = std::min(low, channelAt(image, x, y, channel));
                high = std::max(high, channelAt(image, x, y, channel));
            }
        }
        if (high - low > kSpan) return false;
    }
    return true;
}

// Gray for equal pixels; differences are scaled by eight, brighter where `a` is brighter.
inline base::Image differenceImage(const base::Image& a, const base::Image& b) {
    base::Image result = a;
    for (std::size_t k = 0; k < a.rgba.size(); ++k) {
        const int off = 128 + 8 * (int{a.rgba[k]} - int{b.rgba[k]});
        result.rgba[k] = k % 4 == 3 ? 255 : static_cast<std::uint8_t>(std::clamp(off, 0, 255));
    }
    return result;
}

}  // namespace terrane::golden
