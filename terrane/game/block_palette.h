// The blocks that a player can choose to build, filtered by group and search text. Plain functions.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/world/block_registry.h"

namespace terrane::game {

// The groups of the blocks, in order of their first block in the registry.
std::vector<std::string> paletteGroups(const world::BlockRegistry& blocks);

struct PaletteFilter {
    std::string_view group;   // empty: all
    std::string_view search;  // each word is in the shown name or in the type's name; case is ignored
    std::function<std::string(world::BlockId)> shownName;
};
// In the order of the registry; blocks whose shown name begins with the first searched word come first.
std::vector<world::BlockId> paletteBlocks(const world::BlockRegistry& blocks, const PaletteFilter& filter);

}  // namespace terrane::game
