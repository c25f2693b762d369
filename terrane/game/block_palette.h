// Which blocks a player chooses from: all that are built, by group and by a searched text. Plain functions.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/world/block_registry.h"

namespace terrane::game {

// The groups of the blocks, in the order in which the registry first has them.
std::vector<std::string> paletteGroups(const world::BlockRegistry& blocks);

struct PaletteFilter {
    std::string_view group;   // empty: all
    std::string_view search;  // words that each are in the shown name or in the type's name; case is ignored
    std::function<std::string(world::BlockId)> shownName;
};
// In the order of the registry; with a search those first whose name begins with it.
std::vector<world::BlockId> paletteBlocks(const world::BlockRegistry& blocks, const PaletteFilter& filter);

}  // namespace terrane::game
