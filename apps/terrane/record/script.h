// Reads path files of videos (docs/video.md) into plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/terrane/graphics_options.h"
#include "terrane/base/result.h"
#include "terrane/view/shots.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/blocks/block_type.h"
#include "terrane/world/blocks/content_table.h"
#include "terrane/world/coords.h"

namespace terrane::app {

// A video: the world and its shots.
struct Script {
    io::WorldOptions world;
    std::vector<view::Shot> shots;  // at least one
    double seconds() const { return shots.back().start + shots.back().seconds; }
};

}  // namespace terrane::app

// Reads values in the tables of a path file: numbers, positions, and values of command line flags.
namespace CLI {
class App;
}

namespace terrane::app {

using Names = std::vector<std::string>;

// Errors are stored in the table; `fallback` is then returned.

double numberOf(world::ContentTable& table, std::string_view key, double fallback, double min, double max);
// `form` names the expected form in errors.
std::optional<std::vector<double>> numbersOf(world::ContentTable& table, std::string_view key,
                                             std::size_t count, std::string_view form);
std::optional<world::BlockPos> blockPosOf(world::ContentTable& table, std::string_view key);

// Sets flags from keys of the same names, in the order of `names`, except those in `given`.
void applyFlags(world::ContentTable& table, CLI::App& flags, const Names& names, const Names& given);

}  // namespace terrane::app

namespace terrane::app {

// Options of the command line; they take precedence over the file.
struct ScriptDefaults {
    io::WorldOptions world;
    GraphicsOptions graphics;
    // Given flags without dashes: the file's options of these names are ignored; with a preset, all options
    // that it sets.
    std::vector<std::string> given;
};

// `name` stands for the file in errors, which also name the line and the key.
base::Result<Script> parseScript(std::string_view toml, std::string_view name, const ScriptDefaults& defaults,
                                 const world::BlockRegistry& blocks);

}  // namespace terrane::app
