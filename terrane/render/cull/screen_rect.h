// Rectangles of pixels that boxes of the world cover in the image. All functions are pure and all types plain
// values; any thread may use them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace terrane::render {

// Pixels from `min` on, the one at `max` excluded; row 0 is the lowest. Empty if max is not above min.
struct ScreenRect {
    glm::ivec2 min{0}, max{0};

    bool isEmpty() const { return max.x <= min.x || max.y <= min.y; }
    glm::ivec2 size() const { return max - min; }
    bool operator==(const ScreenRect&) const = default;
};

// Returns the smallest rectangle that contains all of them; at least one.
ScreenRect boundsOf(std::span<const ScreenRect> rects);

// Returns the rectangle of all pixels of an image of `size` that a point of the box may cover, with one more
// pixel on each side. `viewProjection`: of ViewMatrices; the box is in the space that it starts from.
ScreenRect screenRectOf(glm::vec3 min, glm::vec3 max, const glm::mat4& viewProjection, glm::ivec2 size);

// Tracks the covered parts of an image: a grid of 32 × 18 cells, 40 pixels wide at 1280 × 720. Finer cells
// would fit more closely but take more draws.
class ScreenGrid {
  public:
    static constexpr int kColumns = 32, kRows = 18;

    explicit ScreenGrid(glm::ivec2 size) : size_(size) {}
    void cover(const ScreenRect& rect);
    bool isFull() const;
    // Returns the rectangles of exactly the covered cells, without overlap.
    std::vector<ScreenRect> rects() const;

  private:
    ScreenRect pixelsOf(glm::ivec2 firstCell, glm::ivec2 endCell) const;

    glm::ivec2 size_;                          // of the image in pixels
    std::array<std::uint32_t, kRows> rows_{};  // a bit a column
};

}  // namespace terrane::render
