// Surfaces of any part of a world: from the generator, from a cache on the disk, and from edited chunks. Any
// number of threads may use it at a time.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <unordered_set>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gen/level_generators.h"
#include "terrane/map/surface.h"
#include "terrane/map/surface_cache.h"
#include "terrane/store/chunk_store.h"
#include "terrane/world/coords.h"

namespace terrane::map {

// A rectangle of columns of one level: x0 … x0 + width - 1, in columns of the level.
struct ColumnRect {
    int level = 0;
    std::int64_t x0 = 0, y0 = 0;
    int width = 0, height = 0;
};

// Returns the columns of chunks of a level.
ColumnRect columnsOf(const world::ChunkArea& chunks, int level);

// Returns the chunk with these coordinates; a position outside the world if they are too large.
world::ChunkPos chunkAt(std::int64_t x, std::int64_t y, int level);

// Returns the chunks that a rectangle touches, row by row; they may lie outside the world.
std::vector<world::ChunkPos> chunksTouching(const ColumnRect& rect);

// Copies a chunk's columns, x + 16 y, to their places in a rectangle, x + width · y; columns outside of it
// are left out.
template <class Column>
void copyChunk(const ColumnRect& rect, world::ChunkPos chunk,
               const std::array<Column, kSurfaceColumns>& columns, std::vector<Column>& target) {
    const std::int64_t left = std::int64_t{chunk.x} * world::kChunkSize,
                       bottom = std::int64_t{chunk.y} * world::kChunkSize;
    const std::int64_t x0 = std::max(left, rect.x0),
                       x1 = std::min(left + world::kChunkSize, rect.x0 + rect.width);
    for (int row = 0; row < world::kChunkSize; ++row) {
        const std::int64_t y = bottom + row - rect.y0;
        if (y < 0 || y >= rect.height) continue;
        std::copy_n(columns.begin() + row * world::kChunkSize + (x0 - left), x1 - x0,
                    target.begin() + y * rect.width + (x0 - rect.x0));
    }
}

struct SurfaceArea {
    ColumnRect rect;
    std::vector<SurfaceColumn> columns;  // x + width · y; without blocks outside the world

    // Returns a column; x and y count from the rectangle's corner.
    const SurfaceColumn& at(int x, int y) const {
        return columns[static_cast<std::size_t>(y) * static_cast<std::size_t>(rect.width) +
                       static_cast<std::size_t>(x)];
    }
};

using SurfacePtr = std::shared_ptr<const Surface>;

// A chunk or tile that differs from the generated one.
struct EditedChunk {
    world::ChunkPos pos;
    world::ChunkPtr chunk;  // null: read from the store, or generated if it has none
};

class SurfaceSource {
  public:
    struct Parts {
        const gen::LevelGenerators& generators;
        const SurfaceKinds& kinds;
        store::ReadableStore* store = nullptr;  // null: all edited chunks are passed in
        SurfaceCache* cache = nullptr;          // null: nothing is kept on the disk
    };
    // All parts outlive this.
    explicit SurfaceSource(const Parts& parts);
    ~SurfaceSource();

    // Returns the surfaces of chunks of one level, in the order of `chunks`; without blocks outside the
    // world. `edited`: the edited ones of them, in any order. Takes about 0.1 ms for each chunk that neither
    // memory nor the disk has. Fails if the level has no generator, or if the store cannot read a chunk.
    [[nodiscard]] base::Result<std::vector<SurfacePtr>> surfaces(std::span<const world::ChunkPos> chunks,
                                                                 std::span<const EditedChunk> edited);
    // Does the same for a rectangle.
    [[nodiscard]] base::Result<SurfaceArea> area(const ColumnRect& rect, std::span<const EditedChunk> edited);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// The edited chunks of a world, and so the tiles above them that may be edited. add() on one thread; reading
// on any thread while nothing is added.
class EditedPositions {
  public:
    // Adds a chunk of level 0. Returns false if it was there.
    bool add(world::ChunkPos chunk);
    std::size_t count() const { return positions_.front().size(); }  // of level 0
    // Returns whether this is an edited chunk of level 0, or a tile with an edited chunk beneath it.
    bool contains(world::ChunkPos chunk) const;

    // Returns the edited ones of these chunks, to be read from the store.
    std::vector<EditedChunk> among(std::span<const world::ChunkPos> chunks) const;

  private:
    std::array<std::unordered_set<world::ChunkPos, world::ChunkPosHash>, world::kMaxLevel + 1>
        positions_;  // by level
};

}  // namespace terrane::map
