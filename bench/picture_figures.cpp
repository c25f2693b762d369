#include "bench/picture_figures.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>

namespace terrane::bench {
namespace {

constexpr int kSquare = 16;

// IEC 61966-2-1.
double linear(std::uint8_t srgb) {
    const double value = srgb / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

const std::array<double, 256>& linearValues() {
    static const std::array<double, 256> values = [] {
        std::array<double, 256> made{};
        for (std::size_t k = 0; k < made.size(); ++k) made[k] = linear(static_cast<std::uint8_t>(k));
        return made;
    }();
    return values;
}

std::size_t offsetOf(const base::Image& image, int x, int y) {
    return 4 * (static_cast<std::size_t>(x) +
                static_cast<std::size_t>(image.width) * static_cast<std::size_t>(y));
}

// Sums over a square.
std::array<double, 3> sumOf(const base::Image& image, int x0, int y0) {
    std::array<double, 3> sum{};
    for (int y = y0; y < std::min(y0 + kSquare, image.height); ++y) {
        for (int x = x0; x < std::min(x0 + kSquare, image.width); ++x) {
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] += linearValues()[image.rgba[offsetOf(image, x, y) + c]];
        }
    }
    return sum;
}

void compareColors(PictureFigures& figures, const base::Image& chunks, const base::Image& tiles) {
    std::vector<double> differences;
    double inChunks = 0, inTiles = 0;
    for (int y = 0; y < chunks.height; y += kSquare) {
        for (int x = 0; x < chunks.width; x += kSquare) {
            const int pixels = std::min(kSquare, chunks.width - x) * std::min(kSquare, chunks.height - y);
            const auto a = sumOf(chunks, x, y), b = sumOf(tiles, x, y);
            double largest = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                largest = std::max(largest, std::abs(a[c] - b[c]) / pixels * 255);
                inChunks += a[c];
                inTiles += b[c];
            }
            differences.push_back(largest);
            figures.meanDifference += largest;
        }
    }
    figures.meanDifference /= static_cast<double>(differences.size());
    const auto rank = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(differences.size() - 1));
    std::nth_element(differences.begin(), differences.begin() + rank, differences.end());
    figures.percentile99 = differences[static_cast<std::size_t>(rank)];
    figures.brightness = inChunks > 0 ? inTiles / inChunks : 1;
}

bool isWater(const Pictures& pictures, std::size_t at) {
    return !std::equal(&pictures.color.rgba[at], &pictures.color.rgba[at] + 3, &pictures.dry.rgba[at]);
}

// The first row that shows something, or the image's height.
int skylineOf(const Pictures& pictures, int x) {
    for (int y = 0; y < pictures.normal.height; ++y) {
        const std::size_t at = offsetOf(pictures.normal, x, y);
        const std::uint8_t* pixel = &pictures.normal.rgba[at];
        if (pixel[0] + pixel[1] + pixel[2] > 0 || isWater(pictures, at)) return y;
    }
    return pictures.normal.height;
}

}  // namespace

PictureFigures comparePictures(const Pictures& chunks, const Pictures& tiles, double cell) {
    assert(chunks.color.rgba.size() == tiles.color.rgba.size() && "of the same size");
    PictureFigures figures;
    compareColors(figures, chunks.color, tiles.color);
    for (std::size_t at = 0; at < chunks.color.rgba.size(); at += 4) {
        const bool a = isWater(chunks, at), b = isWater(tiles, at);
        figures.waterInBoth += a && b;
        figures.waterInAny += a || b;
    }
    for (int x = 0; x < chunks.color.width; ++x) {
        const int difference = std::abs(skylineOf(chunks, x) - skylineOf(tiles, x));
        figures.skyline += difference;
        figures.skylineBeyondCell += difference > cell;
    }
    figures.skyline /= chunks.color.width;
    figures.skylineBeyondCell /= chunks.color.width;
    return figures;
}

base::Image above(const base::Image& top, const base::Image& bottom) {
    assert(top.width == bottom.width);
    base::Image both = top;
    both.height += bottom.height;
    both.rgba.insert(both.rgba.end(), bottom.rgba.begin(), bottom.rgba.end());
    return both;
}

}  // namespace terrane::bench
