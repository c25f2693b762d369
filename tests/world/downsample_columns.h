// Columns of land and sea, and the rule of the blocks that come with the program.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "terrane/world/downsample.h"
#include "tests/support/default_heights.h"
#include "tests/world/content_blocks.h"

namespace terrane::world {

using Children = std::array<BlockColumn, 4>;

inline const DownsampleRule& rule() {
    static const DownsampleRule rule = downsampleRule(contentBlocks());
    return rule;
}

inline BlockColumn down(const Children& children, ColumnPos parent) {
    BlockColumn out;
    downsampleColumn(rule(), children, parent, out);
    return out;
}

inline BlockColumn columnOf(BlockId id) {
    return BlockColumn(kChunkHeight, id);
}

inline void fill(BlockColumn& column, int from, int to, std::string_view name) {
    std::fill(column.begin() + from, column.begin() + to, contentBlock(name));
}

// Stone, three dirt, grass at top; air above, or water up to 62.
inline BlockColumn landOf(int top) {
    BlockColumn column = columnOf(kAir);
    fill(column, 0, 63, "water");
    fill(column, 0, top + 1, "stone");
    fill(column, top - 3, top + 1, "dirt");
    fill(column, top, top + 1, "grass");
    return column;
}

inline BlockColumn seaOf(int bottom) {
    BlockColumn column = columnOf(kAir);
    fill(column, 0, 63, "water");
    fill(column, 0, bottom, "sand");
    return column;
}

// Calls use(parent) for some thousand positions about the origin.
inline void forEachParent(std::uint8_t level, auto use) {
    for (int x = -40; x < 40; ++x)
        for (int y = -40; y < 40; ++y) use(ColumnPos{x, y, level});
}

}  // namespace terrane::world
