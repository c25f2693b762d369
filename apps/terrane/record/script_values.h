// Values in the tables of a path file: numbers, positions, and what flags of the command line take.
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

// What is wrong goes to the table's error, and something harmless is returned.

double numberOf(world::ContentTable& table, std::string_view key, double fallback, double min, double max);
// `form` says in errors what is expected.
std::optional<std::vector<double>> numbersOf(world::ContentTable& table, std::string_view key,
                                             std::size_t count, std::string_view form);
std::optional<world::BlockPos> blockPosOf(world::ContentTable& table, std::string_view key);

// Gives flags the values of keys by the same names, in the order of `names`, but for those in `given`.
void applyFlags(world::ContentTable& table, CLI::App& flags, const Names& names, const Names& given);

}  // namespace terrane::app
