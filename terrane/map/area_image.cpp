#include "terrane/map/area_image.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

namespace terrane::map {
namespace {

// The size in pixels of a piece, which one thread paints.
constexpr int kPieceWidth = 256, kStripHeight = 64;

void copyInto(base::Image& image, const base::Image& piece, int left, int top) {
    const std::size_t rowBytes = static_cast<std::size_t>(piece.width) * 4;
    for (int y = 0; y < piece.height; ++y) {
        const std::size_t to = static_cast<std::size_t>(top + y) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(left);
        std::memcpy(image.rgba.data() + to * 4, piece.rgba.data() + static_cast<std::size_t>(y) * rowBytes,
                    rowBytes);
    }
}

}  // namespace

base::Result<base::Image> drawArea(MapPainter& painter, const ColumnRect& rect, const EditedPositions& edited,
                                   base::JobSystem& jobs,
                                   const std::function<bool(int rows)>& shouldContinue) {
    base::Image image{rect.width, rect.height, {}};
    image.rgba.resize(static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height) * 4);
    const int count = (rect.width + kPieceWidth - 1) / kPieceWidth;
    for (int top = 0; top < rect.height; top += kStripHeight) {
        const int height = std::min(kStripHeight, rect.height - top);
        std::vector<base::Result<void>> results(static_cast<std::size_t>(count));
        TERRANE_TRY(base::parallelFor(jobs, results.size(), [&](std::size_t k) {
            // East, which is -x, is to the right.
            const int right = static_cast<int>(k) * kPieceWidth,
                      width = std::min(kPieceWidth, rect.width - right);
            const auto piece =
                painter.paintArea({rect.level, rect.x0 + right, rect.y0 + top, width, height}, edited);
            if (piece)
                copyInto(image, *piece, rect.width - right - width, top);
            else
                results[k] = tl::unexpected(piece.error());
        }));
        for (const base::Result<void>& result : results)
            if (!result) return tl::unexpected(result.error());
        if (!shouldContinue(top + height)) return base::fail("the image is not wanted any more");
    }
    return image;
}

}  // namespace terrane::map
