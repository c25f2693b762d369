// Reads the shapes of a content file ([[shape]] tables, see assets/blocks.toml). Called by block_parser.cpp.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/world/block_model.h"
#include "terrane/world/content_table.h"

namespace terrane::world {

// `tables` may be null. Names must not be among `taken`. Errors go to `error`.
std::vector<ShapePtr> readShapes(const toml::array* tables, std::span<const std::string_view> taken,
                                 std::string_view file, std::optional<std::string>& error);

}  // namespace terrane::world
