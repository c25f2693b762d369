// Reads values in the tables of a path file: numbers, positions, and values of command line flags.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/world/content_table.h"
#include "terrane/world/coords.h"

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
