// Loads an area of a world square by square, each with a border of one chunk, which light and meshes need.
// One thread.
#pragma once

#include <vector>

#include "terrane/stream/area_chunks.h"

namespace terrane::io {

// 32² chunks, 34² with the border: about 10 MiB of blocks, whatever the area's size.
constexpr int kSquareChunks = 32;

// The squares of an area, ordered by y, then x; the last ones in each direction may be smaller.
std::int64_t squareCount(const world::ChunkArea& area);
world::ChunkArea squareOf(const world::ChunkArea& area, std::int64_t number);

class LoadedSquare {
  public:
    explicit LoadedSquare(const world::ChunkArea& area)
        : area_(area), width_(area.x1 - area.x0 + 2), height_(area.y1 - area.y0 + 2) {}

    // Loads chunks from the save, if there is one, else generates them.
    base::Result<void> load(store::ChunkStore* save, const gen::Generator& generator, base::JobSystem& jobs);

    // x and y count from the square's first chunk; the border is at -1 and at the size.
    const world::Chunk& chunk(int x, int y) const {
        return chunks_[static_cast<std::size_t>(x + 1 + (y + 1) * width_)];
    }
    const world::ChunkArea& area() const { return area_; }
    int chunksX() const { return width_ - 2; }
    int chunksY() const { return height_ - 2; }

  private:
    world::ChunkArea area_;
    int width_, height_;
    std::vector<world::Chunk> chunks_;
};

}  // namespace terrane::io
