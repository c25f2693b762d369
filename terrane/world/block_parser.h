// Reads a content file of block types (TOML, see assets/blocks.toml) into descriptions that name textures and
// carry no ids yet. Called by block_registry.cpp on the thread that starts a session.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/block_behavior.h"
#include "terrane/world/block_description.h"

namespace terrane::world {

// Ids are 16 bits; air takes the first and "missing" the one after the file's.
constexpr std::size_t kMaxDescribedBlocks = 65536 - 2;
constexpr std::size_t kMaxGrowthStages = 15;
constexpr int kMaxSlots = 256;

// The blocks and shapes of a file in its order; their names are unique.
struct BlockFile {
    std::vector<BlockDescription> blocks;
    std::vector<ShapePtr> shapes;
};

// Errors read "file:line: key: what is wrong", always one line. Blocks may name `behaviors` and, beside the
// file's own, `shapes`.
[[nodiscard]] base::Result<BlockFile> parseBlocks(std::string_view toml, std::string_view file,
                                                  const BehaviorTable& behaviors = builtInBehaviors(),
                                                  std::span<const ShapePtr> shapes = {});

}  // namespace terrane::world
