// The cells that stop rays, of chunks and tiles around the camera, in the form that shared/ray_cast.h reads
// (shared/ray_scene.h describes its words). Whoever shows a world keeps one: it adds tiles when they are
// shown, removes them when they are hidden, and updates sections after edits.
//
// Columns are built by any thread; the scene belongs to one. Any number of threads may cast rays through it
// while nobody changes it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrane/shared/ray_cast.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/chunk.h"

namespace terrane::rays {

// Whether blocks stop rays, by id: 0 or 1. Ids beyond are of unknown blocks, which do.
using StopTable = std::vector<world::Section::Value>;

// Returns the table for a rule of block types.
template <class Rule>
StopTable stopTable(const world::BlockRegistry& blocks, const Rule& stops) {
    StopTable table;
    for (const world::BlockType& type : blocks.types()) table.push_back(stops(type) ? 1 : 0);
    return table;
}

// The cells of a section: kRayEmpty, kRayFull, or a node of six words and the leaves after it. The node
// counts words from its own beginning.
struct SectionCells {
    static constexpr std::size_t kMostWords = shared::kRayNodeWords + 64 * shared::kRayLeafWords;

    std::uint32_t state = shared::kRayEmpty;  // kRayFull + 1: a node
    std::uint32_t size = 0;                   // words
    std::array<std::uint32_t, kMostWords> words;
};
void buildCells(SectionCells& cells, const world::Section& section, const StopTable& stops);

// The cells of a chunk or tile: for each section from the bottom, kRayEmpty, kRayFull, or the place of its
// node in `words`, plus 2.
struct ColumnCells {
    int firstSection = 0;
    std::vector<std::uint32_t> sections, words;
};
ColumnCells buildColumn(const world::Chunk& chunk, const StopTable& stops);

struct Scene {
    world::Heights heights;
    int levels = 1, sideBits = 0;
    std::vector<std::uint32_t> words;
    // Free words, by half their number: nodes and columns take an even number of words.
    std::array<std::vector<std::uint32_t>, 1 + world::kMostSections / 2> freeWords;
    std::size_t wordsInUse = 0;
    std::vector<bool> written;  // blocks of kWrittenBlock words that changed since takeWritten()
};

// Calls use(first, count) for the words that changed since the last call, in ascending order; at first for
// all. For a copy of the words elsewhere.
constexpr std::size_t kWrittenBlock = 256;
template <class Use>
void takeWritten(Scene& scene, const Use& use) {
    const auto end = scene.written.end();
    for (auto from = std::find(scene.written.begin(), end, true); from != end;
         from = std::find(from, end, true)) {
        const auto to = std::find(from, end, false);
        const auto first = static_cast<std::size_t>(from - scene.written.begin()) * kWrittenBlock;
        const auto last = static_cast<std::size_t>(to - scene.written.begin()) * kWrittenBlock;
        use(first, std::min(last, scene.words.size()) - first);
        std::fill(from, to, false);
        from = to;
    }
}

// Makes an empty scene for tiles of levels 0 … levels − 1 that are less than half of 2^sideBits from the
// center: sideBits of 6 for view distances to 30, of 7 to 62, of 8 to 126 and details likewise.
Scene makeScene(world::Heights heights, int levels, int sideBits);

// Moves the windows of all levels. Tiles that are now outside are removed.
void moveScene(Scene& scene, world::ChunkPos center);

// Returns whether the tile is inside the window of its level.
bool isInWindow(const Scene& scene, world::ChunkPos pos);

// Adds the column of a chunk or tile, or replaces it. It is in the window and has the heights of the scene,
// and no other tile covers a part of it.
void setTile(Scene& scene, world::ChunkPos pos, const ColumnCells& column);
// Does nothing if the scene does not have it.
void removeTile(Scene& scene, world::ChunkPos pos);
bool hasTile(const Scene& scene, world::ChunkPos pos);
// Returns whether the tile is inside the window and no tile covers a part of its place.
bool isFree(const Scene& scene, world::ChunkPos pos);

// Replaces one section of a tile that the scene has, after an edit.
void setSection(Scene& scene, world::ChunkPos pos, int number, const SectionCells& cells);

inline std::size_t memoryBytes(const Scene& scene) {
    return scene.words.size() * sizeof(std::uint32_t);
}

inline shared::RayWords raysThrough(const Scene& scene) {
    return scene.words.data();
}

}  // namespace terrane::rays
