// Reads a content file of block types (TOML, see assets/blocks.toml) into descriptions that name textures and
// carry no ids yet. block_registry.cpp calls it on the thread that starts a session.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/blocks/block_behavior.h"
#include "terrane/world/blocks/block_description.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/block_type.h"
#include "terrane/world/blocks/content_table.h"

namespace terrane::world {

// Ids are 16 bits; air takes the first and "missing" the one after the file's.
constexpr std::size_t kMaxDescribedBlocks = 65536 - 2;
constexpr std::size_t kMaxGrowthStages = 15;
constexpr int kMaxSlots = 256;
constexpr double kMaxHardness = 60;  // seconds
constexpr int kMaxToolLevel = 9;

// Names of kinds of tools in content files.
constexpr std::array<EnumName<ToolKind>, 5> kToolKinds{{{"none", ToolKind::None},
                                                        {"pick", ToolKind::Pick},
                                                        {"axe", ToolKind::Axe},
                                                        {"shovel", ToolKind::Shovel},
                                                        {"sword", ToolKind::Sword}}};

// The blocks and shapes of a file in its order; their names are unique.
struct BlockFile {
    std::vector<BlockDescription> blocks;
    std::vector<ShapePtr> shapes;
};

// Parses a file. Errors read "file:line: key: what is wrong", always in one line. Blocks may name `behaviors`
// and, beside the file's own, `shapes`.
[[nodiscard]] base::Result<BlockFile> parseBlocks(std::string_view toml, std::string_view file,
                                                  const BehaviorTable& behaviors = builtInBehaviors(),
                                                  std::span<const ShapePtr> shapes = {});

// Reads the behaviors of a block of a content file. block_parser.cpp calls it. Behaviors that other keys
// imply come first: the block's shape, growth and slots must be read before. Errors go to the table.
void readBehaviors(ContentTable& table, BlockDescription& block, const BehaviorTable& behaviors);

// Reads the shapes of a content file ([[shape]] tables, see assets/blocks.toml). block_parser.cpp calls it.
// `tables` may be null. Names must not be among `taken`. Errors go to `error`.
std::vector<ShapePtr> readShapes(const toml::array* tables, std::span<const std::string_view> taken,
                                 std::string_view file, std::optional<std::string>& error);

// Reads the key `sound` of a block in a content file. The default is water for liquids, grass for plants,
// else stone.
SoundMaterial readSound(ContentTable& table, Shape shape);

}  // namespace terrane::world
