#include "terrane/base/shrunk_image.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace terrane::base {
namespace {

// From which to which pixel, end excluded, one of `count` stands for of `size`.
struct Span {
    int begin = 0, end = 0;
};

Span spanOf(int index, int count, int size) {
    const auto edge = [&](int k) { return static_cast<int>(std::int64_t{k} * size / count); };
    return {edge(index), std::max(edge(index + 1), edge(index) + 1)};
}

std::array<std::uint8_t, 4> meanOf(const Image& image, Span x, Span y) {
    std::array<std::uint64_t, 4> sums{};
    for (int row = y.begin; row < y.end; ++row)
        for (int column = x.begin; column < x.end; ++column)
            for (std::size_t c = 0; c < 4; ++c)
                sums[c] += image.rgba[(static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                                       static_cast<std::size_t>(column)) *
                                          4 +
                                      c];
    const auto count = static_cast<std::uint64_t>((x.end - x.begin) * (y.end - y.begin));
    std::array<std::uint8_t, 4> mean{};
    for (std::size_t c = 0; c < 4; ++c) mean[c] = static_cast<std::uint8_t>((sums[c] + count / 2) / count);
    return mean;
}

}  // namespace

Image shrunk(const Image& image, int maxWidth, int maxHeight) {
    assert(image.width > 0 && image.height > 0 && maxWidth > 0 && maxHeight > 0 && "there are pixels");
    const double share = std::min(
        {1.0, static_cast<double>(maxWidth) / image.width, static_cast<double>(maxHeight) / image.height});
    Image small{.width = std::max(1, static_cast<int>(std::lround(image.width * share))),
                .height = std::max(1, static_cast<int>(std::lround(image.height * share))),
                .rgba = {}};
    small.rgba.reserve(static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height) * 4);
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x) {
            const auto mean =
                meanOf(image, spanOf(x, small.width, image.width), spanOf(y, small.height, image.height));
            small.rgba.insert(small.rgba.end(), mean.begin(), mean.end());
        }
    return small;
}

}  // namespace terrane::base
