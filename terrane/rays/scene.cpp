#include "terrane/rays/scene.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <tuple>

namespace terrane::rays {
namespace {

using namespace shared;
using world::ChunkPos;
using Word = std::uint32_t;

constexpr std::uint64_t kAllCells = ~std::uint64_t{0};
constexpr Word kNode = kRayFull + 1;

// --- Building ---

// Four values of 0 or 1 as four bits.
std::uint64_t fourBits(const world::Section::Value* values) {
    static_assert(std::endian::native == std::endian::little);
    std::uint64_t four;
    std::memcpy(&four, values, sizeof four);
    return (four | four >> 15 | four >> 30 | four >> 45) & 15;
}

// The highest layer of a section with a cell that stops rays, 0 … 15.
int highestLayer(const Word* node) {
    const auto layerOf = [](std::uint64_t cells) { return (63 - std::countl_zero(cells)) / 16; };
    const auto both = [&](Word word) { return node[word] | std::uint64_t{node[kRayHalfWords + word]} << 32; };
    const std::uint64_t any = both(kRayAny), partial = both(kRayPartial);
    const int children = layerOf(any);
    int highest = 0, leaf = 0;
    for (int child = 0; child < 64; ++child) {
        const bool isPartial = (partial >> child & 1) != 0;
        if (child / 16 == children && (any >> child & 1) != 0) {
            const Word* at = node + kRayNodeWords + kRayLeafWords * static_cast<Word>(leaf);
            highest = std::max(highest, isPartial ? layerOf(at[0] | std::uint64_t{at[1]} << 32) : 3);
        }
        leaf += isPartial;
    }
    return 4 * children + highest;
}

// --- Words ---

void noteWritten(Scene& scene, std::size_t first, std::size_t count) {
    if (scene.written.size() * kWrittenBlock < scene.words.size())
        scene.written.resize(scene.words.size() / kWrittenBlock + 1);
    for (std::size_t block = first / kWrittenBlock; block <= (first + count - 1) / kWrittenBlock; ++block)
        scene.written[block] = true;
}

std::size_t evenUp(std::size_t count) {
    return (count + 1) & ~std::size_t{1};
}

// Takes words that are free, the rest of a longer piece if none has the size, or new ones at the end.
Word allocate(Scene& scene, std::size_t count) {
    const std::size_t half = evenUp(count) / 2;
    scene.wordsInUse += 2 * half;
    for (std::size_t size = half; size < scene.freeWords.size(); ++size) {
        if (scene.freeWords[size].empty()) continue;
        const Word at = scene.freeWords[size].back();
        scene.freeWords[size].pop_back();
        noteWritten(scene, at, 2 * half);
        if (size > half) scene.freeWords[size - half].push_back(at + static_cast<Word>(2 * half));
        return at;
    }
    const auto at = static_cast<Word>(scene.words.size());
    scene.words.resize(scene.words.size() + 2 * half);
    noteWritten(scene, at, 2 * half);
    return at;
}

void release(Scene& scene, Word at, std::size_t count) {
    const std::size_t half = evenUp(count) / 2;
    scene.wordsInUse -= 2 * half;
    scene.freeWords[half].push_back(at);
}

Word addNode(Scene& scene, const Word* node, std::size_t size) {
    const Word at = allocate(scene, size);
    std::copy_n(node, size, scene.words.begin() + at);
    scene.words[at + kRayLeaves] += at;
    scene.words[at + kRayHalfWords + kRayLeaves] += at;
    return at;
}

std::size_t nodeSize(const Word* node) {
    const int leaves = std::popcount(node[kRayPartial]) + std::popcount(node[kRayHalfWords + kRayPartial]);
    return kRayNodeWords + kRayLeafWords * static_cast<std::size_t>(leaves);
}

void removeNode(Scene& scene, Word state) {
    if (state >= kNode) release(scene, state, nodeSize(&scene.words[state]));
}

// --- Grids ---

Word& header(Scene& scene, int level, Word word) {
    return scene.words[kRayFirstLevel + kRayLevelWords * static_cast<Word>(level) + word];
}

Word entryAt(const Scene& scene, ChunkPos pos) {
    return rayEntryAt(raysThrough(scene), pos.level, pos.x, pos.y);
}

Word* entryOf(Scene& scene, ChunkPos pos) {
    const Word at = pos.level < scene.levels ? entryAt(scene, pos) : 0;
    return at == 0 ? nullptr : &scene.words[at];
}

bool isTile(Word what) {
    return what >= kRayTile;
}

// Sets the top of the scene after that of a tile of the highest level has changed.
void updateTop(Scene& scene, int before, int now) {
    int top = static_cast<int>(scene.words[kRayTop]);
    if (before == top && now < before) {
        top = scene.heights.bottom;
        const Word first = header(scene, scene.levels - 1, kRayGrid);
        for (Word k = 0; k < Word{1} << (2 * scene.sideBits); ++k) {
            const Word* entry = &scene.words[first + kRayEntryWords * k];
            if (entry[0] != kRayNothing) top = std::max(top, rayTopOf(entry[1]));
        }
    }
    scene.words[kRayTop] = static_cast<Word>(std::max(top, now));
    noteWritten(scene, kRayTop, 1);
}

// Sets what is in the place of a tile, and for all tiles of higher levels that cover it whether others divide
// them and how high these reach.
void setEntry(Scene& scene, ChunkPos pos, Word what, Word heights) {
    for (;;) {
        Word* entry = entryOf(scene, pos);
        if (entry[0] == what && entry[1] == heights) return;
        const int before = entry[0] == kRayNothing ? scene.heights.bottom : rayTopOf(entry[1]);
        entry[0] = what;
        entry[1] = heights;
        noteWritten(scene, static_cast<std::size_t>(entry - scene.words.data()), kRayEntryWords);
        if (pos.level == scene.levels - 1) {
            return updateTop(scene, before, what == kRayNothing ? scene.heights.bottom : rayTopOf(heights));
        }
        const int child = pos.level;
        pos = {pos.x >> 1, pos.y >> 1, static_cast<std::uint8_t>(child + 1)};
        assert(!isTile(entryOf(scene, pos)[0]) && "each place is covered by one tile");
        what = kRayNothing;
        int top = scene.heights.bottom;
        for (int k = 0; k < 4; ++k) {
            const Word* part =
                entryOf(scene, {2 * pos.x + k % 2, 2 * pos.y + k / 2, static_cast<std::uint8_t>(child)});
            if (part == nullptr || part[0] == kRayNothing) continue;
            what = kRayDivided;
            top = std::max(top, rayTopOf(part[1]));
        }
        heights = what == kRayNothing ? 0 : packRayHeights(top, 0);
    }
}

// The states of all sections of a tile, from the bottom.
using States = std::array<Word, world::kMostSections>;

States readStates(const Scene& scene, const Word* entry) {
    States states{};
    const int lowest = rayLowestSectionOf(entry[1]), bottom = scene.heights.firstSection();
    const int end = (rayTopOf(entry[1]) + world::kSectionSize - 1) >> 4;
    for (int number = bottom; number < end; ++number)
        states[static_cast<std::size_t>(number - bottom)] =
            scene.words[entry[0] + static_cast<Word>(std::max(number - lowest, 0))];
    return states;
}

std::size_t columnSize(const Word* entry) {
    const int end = (rayTopOf(entry[1]) + world::kSectionSize - 1) >> 4;
    return static_cast<std::size_t>(std::max(end - rayLowestSectionOf(entry[1]), 1));
}

// Writes the column of a tile from the states of its sections.
void writeColumn(Scene& scene, ChunkPos pos, const States& states) {
    const int bottom = scene.heights.firstSection();
    int count = scene.heights.sections(), same = 0;
    while (count > 0 && states[static_cast<std::size_t>(count - 1)] == kRayEmpty) --count;
    while (same + 1 < count && states[static_cast<std::size_t>(same)] < kNode &&
           states[static_cast<std::size_t>(same + 1)] == states[static_cast<std::size_t>(same)])
        ++same;
    int top = scene.heights.bottom;
    if (count > 0) {
        const Word highest = states[static_cast<std::size_t>(count - 1)];
        top += world::kSectionSize * (count - 1);
        top += highest == kRayFull ? world::kSectionSize : highestLayer(&scene.words[highest]) + 1;
    }
    const auto size = static_cast<std::size_t>(std::max(count - same, 1));
    const Word at = allocate(scene, size);
    for (std::size_t k = 0; k < size; ++k) scene.words[at + k] = states[static_cast<std::size_t>(same) + k];
    setEntry(scene, pos, at, packRayHeights(top, bottom + same));
}

}  // namespace

void buildCells(SectionCells& cells, const world::Section& section, const StopTable& stops) {
    using Value = world::Section::Value;
    const auto stopsRays = [&](Value id) { return id < stops.size() ? stops[id] : Value{1}; };
    cells.size = 0;
    if (section.surelyAll([&](Value id) { return stopsRays(id) == 0; })) {
        cells.state = kRayEmpty;
        return;
    }
    if (section.surelyAll([&](Value id) { return stopsRays(id) != 0; })) {
        cells.state = kRayFull;
        return;
    }
    std::array<Value, world::kBlocksPerSection> values;
    if (section.isDense()) {
        section.unpack(values);
        for (Value& value : values) value = stopsRays(value);
    } else {
        std::array<Value, 256> mapped;
        const std::span<const Value> palette = section.palette();
        std::transform(palette.begin(), palette.end(), mapped.begin(), stopsRays);
        section.unpackMapped(std::span(mapped).first(palette.size()), values);
    }
    std::array<std::uint64_t, 64> children{};
    for (std::size_t row = 0; row < 256; ++row) {
        const std::size_t y = row & 15, z = row >> 4;
        std::uint64_t* four = &children[(y >> 2) << 2 | (z >> 2) << 4];
        for (std::size_t x = 0; x < 4; ++x)
            four[x] |= fourBits(&values[16 * row + 4 * x]) << (4 * (y & 3) + 16 * (z & 3));
    }
    std::uint64_t any = 0, full = 0;
    cells.size = kRayNodeWords;
    for (std::size_t child = 0; child < 64; ++child) {
        const std::uint64_t bits = children[child];
        any |= std::uint64_t{bits != 0} << child;
        full |= std::uint64_t{bits == kAllCells} << child;
        if (bits == 0 || bits == kAllCells) continue;
        cells.words[cells.size++] = static_cast<Word>(bits);
        cells.words[cells.size++] = static_cast<Word>(bits >> 32);
    }
    cells.state = any == 0 ? kRayEmpty : full == kAllCells ? kRayFull : kNode;
    if (cells.state != kNode) cells.size = 0;
    const std::uint64_t partial = any & ~full;
    Word leaves = kRayNodeWords;
    for (const Word half : {0u, 1u}) {
        Word* part = &cells.words[half * kRayHalfWords];
        part[kRayAny] = static_cast<Word>(any >> (32 * half));
        part[kRayPartial] = static_cast<Word>(partial >> (32 * half));
        part[kRayLeaves] = leaves;
        leaves += kRayLeafWords * static_cast<Word>(std::popcount(part[kRayPartial]));
    }
}

ColumnCells buildColumn(const world::Chunk& chunk, const StopTable& stops) {
    ColumnCells column;
    column.firstSection = chunk.heights().firstSection();
    SectionCells cells;
    for (int number = column.firstSection; number < chunk.heights().endSection(); ++number) {
        buildCells(cells, chunk.section(number), stops);
        column.sections.push_back(cells.state == kNode ? kNode + static_cast<Word>(column.words.size())
                                                       : cells.state);
        column.words.insert(column.words.end(), cells.words.begin(), cells.words.begin() + cells.size);
    }
    return column;
}

Scene makeScene(world::Heights heights, int levels, int sideBits) {
    static_assert(SectionCells::kMostWords / 2 < std::tuple_size_v<decltype(Scene::freeWords)>);
    assert(levels > 0 && levels <= static_cast<int>(kMaxRayLevels) && sideBits > 1 && sideBits < 12);
    Scene scene;
    scene.heights = heights;
    scene.levels = levels;
    scene.sideBits = sideBits;
    const Word grid = kRayEntryWords << (2 * sideBits);
    scene.words.assign(kRayHeaderWords + grid * static_cast<Word>(levels), 0);
    scene.words[kRayLevelCount] = static_cast<Word>(levels);
    scene.words[kRayBottom] = scene.words[kRayTop] = static_cast<Word>(heights.bottom);
    scene.words[kRaySideBits] = static_cast<Word>(sideBits);
    for (int level = 0; level < levels; ++level) {
        header(scene, level, kRayGrid) = kRayHeaderWords + grid * static_cast<Word>(level);
        header(scene, level, kRayLowX) = header(scene, level, kRayLowY) =
            Word{0} - (Word{1} << (sideBits - 1));
    }
    scene.wordsInUse = scene.words.size();
    noteWritten(scene, 0, scene.words.size());
    return scene;
}

void moveScene(Scene& scene, ChunkPos center) {
    const std::int32_t side = std::int32_t{1} << scene.sideBits;
    for (int level = 0; level < scene.levels; ++level) {
        const std::int32_t lowX = (center.x >> level) - side / 2, lowY = (center.y >> level) - side / 2;
        const auto oldX = static_cast<std::int32_t>(header(scene, level, kRayLowX));
        const auto oldY = static_cast<std::int32_t>(header(scene, level, kRayLowY));
        if (lowX == oldX && lowY == oldY) continue;
        for (std::int32_t y = oldY; y < oldY + side; ++y) {
            const bool isRowInside = y >= lowY && y < lowY + side;
            for (std::int32_t x = oldX; x < oldX + side; ++x) {
                // The part of the row that stays is passed at once.
                if (isRowInside && x >= lowX && x < lowX + side) x = std::min(lowX, oldX) + side;
                if (x < oldX + side) removeTile(scene, {x, y, static_cast<std::uint8_t>(level)});
            }
        }
        noteWritten(scene, 0, kRayHeaderWords);
        header(scene, level, kRayLowX) = static_cast<Word>(lowX);
        header(scene, level, kRayLowY) = static_cast<Word>(lowY);
    }
}

bool isInWindow(const Scene& scene, ChunkPos pos) {
    return pos.level < scene.levels && entryAt(scene, pos) != 0;
}

bool hasTile(const Scene& scene, ChunkPos pos) {
    return isInWindow(scene, pos) && isTile(scene.words[entryAt(scene, pos)]);
}

bool isFree(const Scene& scene, ChunkPos pos) {
    if (!isInWindow(scene, pos) || scene.words[entryAt(scene, pos)] != kRayNothing) return false;
    for (int level = pos.level + 1; level < scene.levels; ++level) {
        const ChunkPos above{pos.x >> (level - pos.level), pos.y >> (level - pos.level),
                             static_cast<std::uint8_t>(level)};
        if (hasTile(scene, above)) return false;
    }
    return true;
}

void removeTile(Scene& scene, ChunkPos pos) {
    if (!hasTile(scene, pos)) return;
    Word* entry = entryOf(scene, pos);
    const States states = readStates(scene, entry);
    for (const Word state : states) removeNode(scene, state);
    release(scene, entry[0], columnSize(entry));
    setEntry(scene, pos, kRayNothing, 0);
}

void setTile(Scene& scene, ChunkPos pos, const ColumnCells& column) {
    assert(isInWindow(scene, pos) && "tiles are inside the window");
    assert(column.sections.size() == static_cast<std::size_t>(scene.heights.sections()) &&
           column.firstSection == scene.heights.firstSection() && "tiles have the heights of the scene");
    removeTile(scene, pos);
    assert(*entryOf(scene, pos) == kRayNothing && "each place is covered by one tile");
    States states{};
    for (std::size_t k = 0; k < column.sections.size(); ++k) {
        const Word state = column.sections[k];
        const Word* node = state < kNode ? nullptr : &column.words[state - kNode];
        states[k] = state < kNode ? state : addNode(scene, node, nodeSize(node));
    }
    writeColumn(scene, pos, states);
}

void setSection(Scene& scene, ChunkPos pos, int number, const SectionCells& cells) {
    assert(hasTile(scene, pos) && "a tile of the scene");
    Word* entry = entryOf(scene, pos);
    States states = readStates(scene, entry);
    Word& state = states[static_cast<std::size_t>(number - scene.heights.firstSection())];
    release(scene, entry[0], columnSize(entry));
    removeNode(scene, state);
    state = cells.state < kNode ? cells.state : addNode(scene, cells.words.data(), cells.size);
    writeColumn(scene, pos, states);
}

}  // namespace terrane::rays
