#include "terrane/render/cull/screen_rect.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "terrane/render/frame/camera.h"

namespace terrane::render {
namespace {

struct Bounds {
    glm::vec2 min{1e9f}, max{-1e9f};

    void add(const glm::vec4& clip) {
        const glm::vec2 point = glm::vec2(clip) / clip.w;
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
};

// Corner k has the upper coordinate along the axes whose bits are set.
std::array<glm::vec4, 8> cornersOf(glm::vec3 min, glm::vec3 max, const glm::mat4& viewProjection) {
    const glm::vec4 first = viewProjection * glm::vec4(min, 1.0f);
    const glm::vec3 extent = max - min;
    std::array<glm::vec4, 8> corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        corners[k] = first;
        for (int axis = 0; axis < 3; ++axis)
            if ((k >> axis & 1) != 0) corners[k] += extent[axis] * viewProjection[axis];
    }
    return corners;
}

// Bounds of the corners in front of the near plane and of the points where edges cross it: the visible part
// is their hull.
Bounds boundsOf(const std::array<glm::vec4, 8>& corners) {
    Bounds bounds;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::vec4& from = corners[k];
        if (from.w >= kNearPlane) bounds.add(from);
        for (std::size_t axis = 1; axis < 8; axis *= 2) {
            const glm::vec4& to = corners[k | axis];
            if ((from.w < kNearPlane) == (to.w < kNearPlane)) continue;
            glm::vec4 crossing = glm::mix(from, to, (kNearPlane - from.w) / (to.w - from.w));
            crossing.w = kNearPlane;
            bounds.add(crossing);
        }
    }
    return bounds;
}

}  // namespace

ScreenRect boundsOf(std::span<const ScreenRect> rects) {
    assert(!rects.empty() && "the bounds of nothing are nowhere");
    ScreenRect all = rects.front();
    for (const ScreenRect& rect : rects) all = {glm::min(all.min, rect.min), glm::max(all.max, rect.max)};
    return all;
}

ScreenRect screenRectOf(glm::vec3 min, glm::vec3 max, const glm::mat4& viewProjection, glm::ivec2 size) {
    const Bounds bounds = boundsOf(cornersOf(min, max, viewProjection));
    if (bounds.min.x > bounds.max.x) return {};
    const glm::vec2 pixels(size);
    // Clamped before conversion to integers, which points near the camera's plane would exceed.
    const glm::vec2 low = glm::clamp(0.5f + 0.5f * bounds.min, -1.0f, 2.0f) * pixels;
    const glm::vec2 high = glm::clamp(0.5f + 0.5f * bounds.max, -1.0f, 2.0f) * pixels;
    const ScreenRect rect{glm::max(glm::ivec2(glm::floor(low)) - 1, glm::ivec2(0)),
                          glm::min(glm::ivec2(glm::ceil(high)) + 1, size)};
    return rect.isEmpty() ? ScreenRect{} : rect;
}

namespace {

constexpr std::uint32_t kAllColumns = UINT32_MAX;
static_assert(ScreenGrid::kColumns == 32);

// Bits first…end − 1.
std::uint32_t columnsBetween(int first, int end) {
    return (end == 32 ? kAllColumns : (1u << end) - 1) & ~((1u << first) - 1);
}

}  // namespace

// Cell k of n begins at pixel k · size / n.
ScreenRect ScreenGrid::pixelsOf(glm::ivec2 firstCell, glm::ivec2 endCell) const {
    const glm::ivec2 cells(kColumns, kRows);
    return {firstCell * size_ / cells, endCell * size_ / cells};
}

void ScreenGrid::cover(const ScreenRect& rect) {
    if (rect.isEmpty()) return;
    const glm::ivec2 cells(kColumns, kRows);
    // The last cell that begins at or before a pixel.
    const glm::ivec2 first = ((rect.min + 1) * cells - 1) / size_, last = (rect.max * cells - 1) / size_;
    for (int row = first.y; row <= last.y; ++row)
        rows_[static_cast<std::size_t>(row)] |= columnsBetween(first.x, last.x + 1);
}

bool ScreenGrid::isFull() const {
    return std::ranges::all_of(rows_, [](std::uint32_t row) { return row == kAllColumns; });
}

// Splits the cells into runs of columns, each as high as all its columns are covered.
std::vector<ScreenRect> ScreenGrid::rects() const {
    std::vector<ScreenRect> rects;
    std::array<std::uint32_t, kRows> left = rows_;
    for (int row = 0; row < kRows; ++row) {
        while (const std::uint32_t columns = left[static_cast<std::size_t>(row)]) {
            const int first = std::countr_zero(columns);
            const int end = std::min(32, first + std::countr_one(columns >> first));
            const std::uint32_t run = columnsBetween(first, end);
            int top = row;
            for (; top < kRows && (left[static_cast<std::size_t>(top)] & run) == run; ++top)
                left[static_cast<std::size_t>(top)] &= ~run;
            const ScreenRect rect = pixelsOf({first, row}, {end, top});
            if (!rect.isEmpty()) rects.push_back(rect);
        }
    }
    return rects;
}

}  // namespace terrane::render
